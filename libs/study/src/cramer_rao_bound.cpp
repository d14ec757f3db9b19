// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/cramer_rao_bound.h"

#include <Eigen/Dense>

#include "vmcl/estimation/match_information.h"

namespace vmcl {
Eigen::Matrix3d fisherInformation(const SimulatedProblem& simulated, double sigma_px) {
  const PoseProblem& problem = simulated.problem;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < problem.matches.size(); ++i) {
    if (!simulated.truth[i].inlier) continue;
    const Match& match = problem.matches[i];
    const Eigen::Vector3d& point = simulated.truth[i].point_in_map;
    const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
    information +=
        match.point ? informationWithDepth(query, simulated.map_from_robot, {point, match.point->covariance}, sigma_px)
                    : informationWithoutDepth(
                          query, problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)],
                          simulated.map_from_robot, point, sigma_px);
  }
  return information;
}

std::optional<Eigen::Matrix3d> cramerRaoBound(const SimulatedProblem& simulated, double sigma_px) {
  const Eigen::Matrix3d information = fisherInformation(simulated, sigma_px);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  if (!(eigen.eigenvalues()[0] > 1e-12 * eigen.eigenvalues()[2])) return std::nullopt;
  return information.inverse();
}

}  // namespace vmcl
