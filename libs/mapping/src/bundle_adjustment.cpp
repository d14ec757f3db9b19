// SPDX-License-Identifier: BSD-3-Clause
#include "bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <stdexcept>

namespace vmcl {
namespace {

constexpr double smallest_sigma = 1e-6;  // keeps a value that counts as exact in the equations

template <typename Vector>
Vector weightsOf(const Vector& sigmas) {
  return sigmas.cwiseMax(smallest_sigma).cwiseInverse();
}

/// A PixelMeasurement or a DepthMeasurement.
template <typename Measurement>
class MeasurementCost final : public ceres::SizedCostFunction<Measurement::rows, 6, 9, 3> {
 public:
  explicit MeasurementCost(const Measurement& measurement) : measurement_(measurement) {}

  bool Evaluate(double const* const* values, double* error, double** jacobians) const override {
    const auto at = measurement_.linearize(Stand(values[0]), CorrectionVector(values[1]), Eigen::Vector3d(values[2]));
    std::ranges::copy(at.error, error);
    if (jacobians == nullptr) return true;
    copyTo(jacobians[0], at.by_stand);
    copyTo(jacobians[1], at.by_correction);
    copyTo(jacobians[2], at.by_point);
    return true;
  }

 private:
  template <typename Matrix>
  static void copyTo(double* jacobian, const Matrix& by) {
    if (jacobian != nullptr) std::copy_n(by.data(), by.size(), jacobian);
  }

  Measurement measurement_;
};

/// Deviation from given values, weighted.
template <int size>
class PriorCost final : public ceres::SizedCostFunction<size, size> {
 public:
  using Vector = Eigen::Vector<double, size>;

  PriorCost(const Vector& given, const Vector& weights) : given_(given), weights_(weights) {}

  bool Evaluate(double const* const* values, double* error, double** jacobians) const override {
    Eigen::Map<Vector> deviation(error);
    deviation = weights_.cwiseProduct(Eigen::Map<const Vector>(values[0]) - given_);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, size, size, Eigen::RowMajor>> by_values(jacobians[0]);
    by_values = weights_.asDiagonal();
    return true;
  }

 private:
  Vector given_, weights_;
};

Stand givenStand(const Reconstruction& scene, std::size_t keyframe) {
  const PlanarPose given = planarPart(scene.keyframes[keyframe].map_from_robot);
  const double now = scene.map_from_robot[keyframe].phi;
  return {0, 0, now + wrapAngle(given.phi - now), given.x, given.y, 0};
}

/// What is adjusted beside the points. Ceres keeps the addresses, and orders by them within a group.
struct Unknowns {
  std::vector<Stand> stands;
  std::vector<CorrectionVector> corrections;

  explicit Unknowns(const Reconstruction& scene) {
    for (std::size_t k = 0; k < scene.keyframes.size(); ++k) stands.push_back(standOf(scene, k));
    for (const CameraCorrection& correction : scene.corrections) corrections.push_back(correctionVector(correction));
  }

  void putInto(Reconstruction& scene) const {
    for (std::size_t k = 0; k < stands.size(); ++k) {
      scene.map_from_robot[k] = {stands[k][3], stands[k][4], wrapAngle(stands[k][2])};
      scene.stance[k] = {stands[k][0], stands[k][1], stands[k][5]};
    }
    for (std::size_t i = 0; i < corrections.size(); ++i)
      scene.corrections[i] = {corrections[i].head<3>(), corrections[i].segment<3>(3), corrections[i].tail<3>()};
  }
};

void addPriors(ceres::Problem& problem, Unknowns& unknowns, const Reconstruction& scene, const AdjustmentNoise& noise) {
  for (std::size_t k = 0; k < unknowns.stands.size(); ++k)
    problem.AddResidualBlock(new PriorCost<6>(givenStand(scene, k), noise.standWeights()), nullptr,
                             unknowns.stands[k].data());
  for (CorrectionVector& correction : unknowns.corrections)
    problem.AddResidualBlock(new PriorCost<9>(CorrectionVector::Zero(), noise.correctionWeights()), nullptr,
                             correction.data());
}

void addMeasurements(ceres::Problem& problem, ceres::LossFunction& loss, Unknowns& unknowns, Reconstruction& scene,
                     const MeasurementNoise& noise) {
  for (ScenePoint& point : scene.points)
    for (const Observation& seen : point.track) {
      const auto k = static_cast<std::size_t>(seen.keyframe);
      const auto camera = static_cast<std::size_t>(scene.keyframes[k].camera);
      const auto add = [&](const auto& measurement) {
        problem.AddResidualBlock(new MeasurementCost(measurement), &loss, unknowns.stands[k].data(),
                                 unknowns.corrections[camera].data(), point.point_in_map.data());  // owns the cost
      };
      const MeasuringCamera from{&scene.cameras[camera], &scene.level_from_robot[k]};
      add(PixelMeasurement{from, scene.distortedPixel(seen), noise.pixel});
      if (const double depth = scene.depth(seen); depth > 0) add(DepthMeasurement{from, depth, noise.inverse_depth});
    }
}

/// Points first, whose elimination leaves few equations; cameras last, which every point depends on.
std::shared_ptr<ceres::ParameterBlockOrdering> eliminationOrder(Unknowns& unknowns, Reconstruction& scene) {
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  for (ScenePoint& point : scene.points) order->AddElementToGroup(point.point_in_map.data(), 0);
  for (Stand& stand : unknowns.stands) order->AddElementToGroup(stand.data(), 1);
  for (CorrectionVector& correction : unknowns.corrections) order->AddElementToGroup(correction.data(), 2);
  return order;
}

ceres::Solver::Options solverOptions(double tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // SuiteSparse's BLAS rounds differently each run
  options.num_threads = 1;
  options.max_num_iterations = 50;
  options.function_tolerance = tolerance;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Stand AdjustmentNoise::standWeights() const {
  return weightsOf(Stand(tilt, tilt, heading, position, position, height));
}

CorrectionVector AdjustmentNoise::correctionWeights() const {
  CorrectionVector sigmas;
  sigmas << Eigen::Vector3d::Constant(mount_rotation), mount_shift, mount_shift, 0, focal, radial, radial;
  return weightsOf(sigmas);
}

void adjust(Reconstruction& scene, const AdjustmentNoise& noise, double tolerance) {
  ceres::HuberLoss loss(huber_threshold);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  Unknowns unknowns(scene);
  addPriors(problem, unknowns, scene, noise);
  addMeasurements(problem, loss, unknowns, scene, noise.measurement);
  ceres::Solver::Options options = solverOptions(tolerance);
  options.linear_solver_ordering = eliminationOrder(unknowns, scene);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("the map cannot be adjusted: " + summary.message);
  unknowns.putInto(scene);
}

}  // namespace vmcl
