// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/pose_method.h"

#include "peers.h"
#include "vmcl/estimation/estimator.h"

namespace vmcl {
namespace {

std::vector<PlanarPose> estimateByLikelihood(const PoseProblem& problem, const MethodSettings& settings,
                                             const SoftPlane& plane) {
  EstimatorOptions options;
  options.plane = plane;
  options.iterations = settings.iterations;
  options.seed = settings.seed;
  options.likelihood.sigma_px = settings.sigma_px;
  std::vector<PlanarPose> poses;
  for (const PoseMode& mode : estimatePose(problem, options).modes) poses.push_back(mode.robot_in_map);
  return poses;
}

}  // namespace

std::vector<PoseMethod> poseMethods() {
  std::vector<PoseMethod> methods{
      {"vmcl", "estimatePose: 1P1DP and 2DP samples, scored and refined by the likelihood; uses all matches", true,
       [](const PoseProblem& problem, const MethodSettings& settings) {
         return estimateByLikelihood(problem, settings, {});
       }}};
  for (auto& peers : {inlierCountingMethods(), openCvMethods(), openGvMethods()})
    methods.insert(methods.end(), peers.begin(), peers.end());
  return methods;
}

PoseMethod softPlaneMethod() {
  return {"vmcl soft", "vmcl with roll and pitch free, their standard deviation 0.5 deg", true,
          [](const PoseProblem& problem, const MethodSettings& settings) {
            return estimateByLikelihood(problem, settings, {.sigma_tilt = 0.5 * degree});
          }};
}

}  // namespace vmcl
