// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_with_covariance.h"

#include <Eigen/Eigenvalues>
#include <iomanip>
#include <limits>
#include <stdexcept>

#include "vmcl/geometry/atomic_file.h"
#include "vmcl/geometry/yaml_map.h"
#include "vmcl/mrpt/pose_region.h"

namespace vmcl {
namespace {

using EigenSolver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

}  // namespace

void PoseWithCovariance::check() const {
  PoseBox{robot_in_map.x, robot_in_map.x, robot_in_map.y, robot_in_map.y, robot_in_map.phi, robot_in_map.phi}.check();
  constexpr double max_covariance = 1e14;  // m^2: of the farthest pose
  const double scale = covariance.cwiseAbs().maxCoeff();
  if (!covariance.allFinite() || !covariance.isApprox(covariance.transpose(), 1e-6) ||
      EigenSolver(covariance).eigenvalues().minCoeff() < -1e-6 * scale)
    throw std::invalid_argument("the covariance is not symmetric positive semidefinite");
  if (scale > max_covariance) throw std::invalid_argument("the covariance goes beyond 1e14");
}

std::function<PlanarPose()> PoseWithCovariance::sampler(Random& random) const {
  const EigenSolver solver(covariance);
  const Eigen::Matrix3d root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal().toDenseMatrix();
  return [mean = robot_in_map, root, &random] {
    Eigen::Vector3d normal;
    for (double& value : normal) value = random.normal();
    const Eigen::Vector3d offset = root * normal;
    return PlanarPose{mean.x + offset.x(), mean.y + offset.y(), wrapAngle(mean.phi + offset.z())};
  };
}

void savePose(const std::filesystem::path& file, const PoseWithCovariance& pose) {
  pose.check();
  AtomicFile out(file);
  out.stream() << std::setprecision(std::numeric_limits<double>::max_digits10) << "# x, y in m, phi in rad\n"
               << "robot_in_map: [" << pose.robot_in_map.x << ", " << pose.robot_in_map.y << ", "
               << pose.robot_in_map.phi << "]\ncovariance: [";
  for (int i = 0; i < 9; ++i) out.stream() << (i ? ", " : "") << pose.covariance(i / 3, i % 3);
  out.stream() << "]\n";
  out.commit();
}

PoseWithCovariance loadPose(const std::filesystem::path& file) {
  YamlMap yaml = YamlMap::read(file);
  const std::vector<double> pose = yaml.numbers("robot_in_map", 3), covariance = yaml.numbers("covariance", 9);
  yaml.finish();
  PoseWithCovariance result{{pose[0], pose[1], pose[2]},
                            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data())};
  try {
    result.check();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return result;
}

}  // namespace vmcl
