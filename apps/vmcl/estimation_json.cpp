// SPDX-License-Identifier: BSD-3-Clause
#include "estimation_json.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace vmcl {
namespace {

using Json = nlohmann::ordered_json;

const Json& member(const Json& object, const char* key) {
  if (!object.is_object()) throw std::invalid_argument(std::string("no object to hold \"") + key + "\"");
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument(std::string("\"") + key + "\" is missing");
  return *found;
}

/// Adds the keys of an object that mean nothing.
void addUnknownKeys(const Json& object, std::initializer_list<std::string_view> known, std::set<std::string>& unknown) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end()) unknown.insert(key);
}

double number(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_number()) throw std::invalid_argument(std::string("\"") + key + "\" is not a number");
  return value.get<double>();
}

int integer(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_number_integer()) throw std::invalid_argument(std::string("\"") + key + "\" is not an integer");
  const auto wide = value.get<int64_t>();
  if (wide < INT32_MIN || wide > INT32_MAX) throw std::invalid_argument(std::string("\"") + key + "\" is out of range");
  return static_cast<int>(wide);
}

template <int Size>
Eigen::Matrix<double, Size, 1> vector(const Json& object, const char* key) {
  const Json& value = member(object, key);
  Eigen::Matrix<double, Size, 1> result;
  bool good = value.is_array() && value.size() == Size;
  for (int i = 0; good && i < Size; ++i) {
    const Json& entry = value[static_cast<std::size_t>(i)];
    good = entry.is_number();
    if (good) result[i] = entry.get<double>();
  }
  if (!good)
    throw std::invalid_argument(std::string("\"") + key + "\" is not an array of " + std::to_string(Size) + " numbers");
  return result;
}

const Json& array(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_array()) throw std::invalid_argument(std::string("\"") + key + "\" is not an array");
  return value;
}

PinholeCamera parseCamera(const Json& json) {
  return {integer(json, "width"), integer(json, "height"), number(json, "fx"),
          number(json, "fy"),     number(json, "cx"),      number(json, "cy")};
}

/// A 3x4 row-major matrix [R | t].
Rigid3 parsePose(const Json& json, const char* key) {
  const Eigen::Matrix<double, 12, 1> rows = vector<12>(json, key);
  Rigid3 pose = Rigid3::Identity();
  for (int r = 0; r < 3; ++r) pose.matrix().row(r) = rows.segment<4>(4 * r).transpose();
  return pose;
}

Match parseMatch(const Json& json, const std::vector<ReferenceCamera>& references) {
  Match match;
  match.query_camera = integer(json, "q");
  match.query_pixel = vector<2>(json, "uv");
  match.reference_camera = integer(json, "r");
  match.reference_pixel = vector<2>(json, "ref_uv");
  if (json.contains("inlier_odds")) match.inlier_odds = number(json, "inlier_odds");
  if (!json.contains("point")) return match;
  MapPoint& point = match.point.emplace();
  point.point_in_map = vector<3>(json, "point");
  const double sigma = number(json, "sigma_depth");
  if (!(sigma >= 0)) throw std::invalid_argument("\"sigma_depth\" is negative");
  if (match.reference_camera < 0 || match.reference_camera >= static_cast<int>(references.size()))
    throw std::invalid_argument("no reference camera " + std::to_string(match.reference_camera));
  const Eigen::Vector3d optical_axis =
      references[static_cast<std::size_t>(match.reference_camera)].map_from_camera.linear().col(2);
  point.covariance = sigma * sigma * optical_axis * optical_axis.transpose();
  return match;
}

Json pose(const PlanarPose& p) { return Json::array({p.x, p.y, p.phi}); }

/// Roll, pitch, height.
Json offPlane(const PoseMode& mode) { return Json::array({mode.roll, mode.pitch, mode.height}); }

Json covariance(const Eigen::Matrix3d& matrix) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rows.push_back(matrix(r, c));
  return rows;
}

}  // namespace

IdentifiedProblem parseProblem(const std::string& line, std::string& id) {
  const Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded()) throw std::invalid_argument("not JSON");
  const Json& name = member(json, "id");
  id = name.is_string() ? name.get<std::string>() : name.dump();
  IdentifiedProblem result{id, {}, {}};
  addUnknownKeys(json, {"id", "query_cameras", "reference_cameras", "matches"}, result.unknown_keys);
  const auto parseCameras = [&](const char* key, const char* pose_key, auto& cameras) {
    for (const Json& camera : array(json, key)) {
      cameras.push_back({parseCamera(camera), parsePose(camera, pose_key)});
      addUnknownKeys(camera, {"width", "height", "fx", "fy", "cx", "cy", pose_key}, result.unknown_keys);
    }
  };
  parseCameras("query_cameras", "robot_from_camera", result.problem.query_cameras);
  parseCameras("reference_cameras", "map_from_camera", result.problem.reference_cameras);
  const Json& matches = array(json, "matches");
  for (std::size_t i = 0; i < matches.size(); ++i) {
    try {
      result.problem.matches.push_back(parseMatch(matches[i], result.problem.reference_cameras));
      addUnknownKeys(matches[i], {"q", "uv", "r", "ref_uv", "inlier_odds", "point", "sigma_depth"},
                     result.unknown_keys);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("match " + std::to_string(i) + ": " + error.what());
    }
  }
  return result;
}

std::string formatEstimate(const std::string& id, const PoseEstimate& estimate, std::optional<double> time_us) {
  Json json{{"id", id}, {"status", estimate.found() ? "ok" : "no_pose"}, {"message", estimate.reason}};
  if (!estimate.found()) json["reason"] = nameOf(estimate.failure);
  if (estimate.found()) {
    const PoseMode& first = estimate.modes.front();
    json["robot_in_map"] = pose(first.robot_in_map);
    json["off_plane"] = offPlane(first);
    json["cov"] = covariance(first.covariance);
    Json& modes = json["modes"] = Json::array();
    for (const PoseMode& mode : estimate.modes)
      modes.push_back({{"robot_in_map", pose(mode.robot_in_map)},
                       {"off_plane", offPlane(mode)},
                       {"cov", covariance(mode.covariance)},
                       {"log_weight", mode.log_weight},
                       {"inliers", mode.inliers.size()}});
    json["inliers"] = first.inliers;
    json["solver"] = nameOf(first.solver);
    json["inlier_rate"] = estimate.inlier_rate;
    json["sigma_px"] = estimate.sigma_px;
    json["off_plane_log_odds"] = estimate.off_plane_log_odds;
    Json& degenerate = json["degenerate"] = Json::array();
    for (const Degeneracy degeneracy : estimate.degeneracies) degenerate.push_back(nameOf(degeneracy));
  }
  if (time_us) json["time_us"] = *time_us;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string formatError(const std::string& id, const std::string& message) {
  return Json{{"id", id}, {"status", "error"}, {"message", message}}.dump(-1, ' ', false,
                                                                          Json::error_handler_t::replace);
}

}  // namespace vmcl
