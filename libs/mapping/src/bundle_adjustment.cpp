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
  std::vector<Eigen::Vector3d> poses;
  for (const PlanarPose& pose : scene.map_from_robot) poses.emplace_back(pose.x, pose.y, pose.phi);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const PlanarPose given = planarPart(scene.keyframes[k].map_from_robot);
    const double nearest_phi = poses[k].z() + wrapAngle(given.phi - poses[k].z());
    addPrior(problem, {given.x, given.y, nearest_phi}, noise.poseWeights(), poses[k].data());
    ordering->AddElementToGroup(poses[k].data(), 1);
  }
  const auto addCorrection = [&](Eigen::Vector3d& correction, const Eigen::Vector3d& correction_weights) {
    addPrior(problem, Eigen::Vector3d::Zero(), correction_weights, correction.data());
    ordering->AddElementToGroup(correction.data(), 2);  // within a group Ceres orders by address
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
      problem.AddResidualBlock(cost, &loss, poses[k].data(), correction.rotation.data(), correction.shift.data(),
                               correction.lens.data(), correction.radial.data(), point.point_in_map.data());
      if (const double depth = scene.depth(seen); depth > 0)
        problem.AddResidualBlock(new DepthCost(new DepthResidual{from, depth, noise.measurement.inverse_depth}), &loss,
                                 poses[k].data(), correction.rotation.data(), correction.shift.data(),
                                 point.point_in_map.data());
    }
    ordering->AddElementToGroup(point.point_in_map.data(), 0);
  }
  ceres::Solver::Options options = solverOptions();
  options.linear_solver_ordering = std::move(ordering);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("the map cannot be adjusted: " + summary.message);
  for (std::size_t k = 0; k < poses.size(); ++k)
    scene.map_from_robot[k] = {poses[k].x(), poses[k].y(), wrapAngle(poses[k].z())};
}

}  // namespace vmcl
