// SPDX-License-Identifier: BSD-3-Clause
#include "bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <stdexcept>

#include "measurement_residuals.h"

namespace vmcl {
namespace {

constexpr double smallest_sigma = 1e-6;  // keeps a value that counts as exact in the equations

Eigen::Vector3d weights(const Eigen::Vector3d& sigmas) { return sigmas.cwiseMax(smallest_sigma).cwiseInverse(); }

/// Deviation of three parameters from given values, weighted.
struct PriorResidual {
  Eigen::Vector3d given;
  Eigen::Vector3d weights;

  template <typename T>
  bool operator()(const T* value, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = weights[i] * (value[i] - given[i]);
    return true;
  }
};

/// Where and how the robot stands, side by side: within a group Ceres orders by address.
struct Stand {
  Eigen::Vector3d pose;  ///< x, y, phi
  Eigen::Vector3d stance;
};

void addPrior(ceres::Problem& problem, const Eigen::Vector3d& given, const Eigen::Vector3d& weights, double* value) {
  using Cost = ceres::AutoDiffCostFunction<PriorResidual, 3, 3>;
  problem.AddResidualBlock(new Cost(new PriorResidual{given, weights}), nullptr, value);
}

ceres::Solver::Options solverOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // SuiteSparse's BLAS rounds differently each run
  options.num_threads = 1;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-7;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Eigen::Vector3d AdjustmentNoise::poseWeights() const { return weights({position, position, heading}); }

Eigen::Vector3d AdjustmentNoise::stanceWeights() const { return weights({tilt, tilt, height}); }

Eigen::Vector3d AdjustmentNoise::mountRotationWeights() const {
  return weights(Eigen::Vector3d::Constant(mount_rotation));
}

Eigen::Vector3d AdjustmentNoise::mountShiftWeights() const { return weights({mount_shift, mount_shift, 0}); }

Eigen::Vector3d AdjustmentNoise::lensWeights() const { return weights({focal, 0, 0}); }

Eigen::Vector3d AdjustmentNoise::radialWeights() const { return weights({radial, radial, 0}); }

void adjust(Reconstruction& scene, const AdjustmentNoise& noise) {
  ceres::HuberLoss loss(huber_threshold);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<Stand> stands;
  stands.reserve(scene.keyframes.size());  // Ceres keeps the addresses
  for (std::size_t k = 0; k < scene.keyframes.size(); ++k) {
    const PlanarPose now = scene.map_from_robot[k], given = planarPart(scene.keyframes[k].map_from_robot);
    auto& [pose, stance] = stands.emplace_back(Stand{{now.x, now.y, now.phi}, scene.stance[k]});
    const double nearest_phi = now.phi + wrapAngle(given.phi - now.phi);
    addPrior(problem, {given.x, given.y, nearest_phi}, noise.poseWeights(), pose.data());
    addPrior(problem, Eigen::Vector3d::Zero(), noise.stanceWeights(), stance.data());
    for (double* moved : {pose.data(), stance.data()}) ordering->AddElementToGroup(moved, 1);
  }
  const auto addCorrection = [&](Eigen::Vector3d& correction, const Eigen::Vector3d& correction_weights) {
    addPrior(problem, Eigen::Vector3d::Zero(), correction_weights, correction.data());
    ordering->AddElementToGroup(correction.data(), 2);
  };
  for (CameraCorrection& correction : scene.corrections) {
    addCorrection(correction.rotation, noise.mountRotationWeights());
    addCorrection(correction.shift, noise.mountShiftWeights());
    addCorrection(correction.lens, noise.lensWeights());
    addCorrection(correction.radial, noise.radialWeights());
  }
  for (ScenePoint& point : scene.points) {
    for (const Observation& seen : point.track) {
      const auto k = static_cast<std::size_t>(seen.keyframe);
      const auto camera = static_cast<std::size_t>(scene.keyframes[k].camera);
      CameraCorrection& correction = scene.corrections[camera];
      const MeasuringCamera from{&scene.cameras[camera], &scene.level_from_robot[k]};
      auto* cost = new ReprojectionCost(  // owned by the problem
          new ReprojectionResidual{from, scene.distortedPixel(seen), noise.measurement.pixel});
      double* const pose = stands[k].pose.data();
      double* const stance = stands[k].stance.data();
      problem.AddResidualBlock(cost, &loss, pose, stance, correction.rotation.data(), correction.shift.data(),
                               correction.lens.data(), correction.radial.data(), point.point_in_map.data());
      if (const double depth = scene.depth(seen); depth > 0)
        problem.AddResidualBlock(new DepthCost(new DepthResidual{from, depth, noise.measurement.inverse_depth}), &loss,
                                 pose, stance, correction.rotation.data(), correction.shift.data(),
                                 point.point_in_map.data());
    }
    ordering->AddElementToGroup(point.point_in_map.data(), 0);
  }
  ceres::Solver::Options options = solverOptions();
  options.linear_solver_ordering = std::move(ordering);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("the map cannot be adjusted: " + summary.message);
  for (std::size_t k = 0; k < stands.size(); ++k) {
    const auto& [pose, stance] = stands[k];
    scene.map_from_robot[k] = {pose.x(), pose.y(), wrapAngle(pose.z())};
    scene.stance[k] = stance;
  }
}

}  // namespace vmcl
