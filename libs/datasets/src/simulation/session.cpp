// SPDX-License-Identifier: BSD-3-Clause
#include "session.h"

#include <algorithm>

#include "exploration.h"
#include "scene_reader.h"

namespace vmcl {
namespace {

Light readLight(YamlMap& yaml) {
  Light light;
  light.brightness = yaml.within("brightness", 1, 0.05, 3);
  light.daylight_azimuth = yaml.within("daylight_azimuth_deg", 0, -360, 360) * degree;
  light.lamps = yaml.within("lamps", light.lamps, 0, 5);
  light.daylight = yaml.within("daylight", light.daylight, 0, 2);
  light.rgb = readColor(yaml, "rgb", light.rgb);
  return light;
}

SceneChanges readChanges(YamlMap& yaml) {
  SceneChanges changes;
  if (yaml.has("move")) {
    YamlMap moved = yaml.map("move");
    for (const std::string& name : moved.keys()) {
      const auto pose = moved.numbers(name, 3);
      changes.moved[name] = {pose[0], pose[1], pose[2] * degree};
    }
  }
  if (yaml.has("remove"))
    for (const std::string& name : yaml.texts("remove")) changes.removed.insert(name);
  return changes;
}

Person readPerson(YamlMap yaml) {
  Person person;
  for (const auto& place : yaml.rows("path", 2, 2)) person.path.emplace_back(place[0], place[1]);
  if (person.path.empty()) yaml.fail("path", "is empty");
  for (std::size_t i = 1; i < person.path.size(); ++i)
    if ((person.path[i] - person.path[i - 1]).norm() < 0.01) yaml.fail("path", "names a place twice");
  person.yaw = yaml.within("yaw_deg", 0, -360, 360) * degree;
  person.speed = yaml.within("speed", person.speed, 0.05, 3);
  person.start = yaml.within("start", person.start, 0, 1e5);
  person.height = yaml.within("height", person.height, 0.5, 2.3);
  person.sits = yaml.get("sits", person.sits);
  if (person.sits && person.path.size() > 1) yaml.fail("path", "has several places, but who sits stays");
  person.shirt = readColor(yaml, "shirt", person.shirt);
  person.trousers = readColor(yaml, "trousers", person.trousers);
  yaml.finish();
  return person;
}

void readWay(Session& session, YamlMap& yaml) {
  if (yaml.has("start")) {
    const auto start = yaml.numbers("start", 3);
    session.start = {start[0], start[1], start[2] * degree};
  }
  const int ways = yaml.has("waypoints") + yaml.has("explore") + yaml.has("trajectory");
  if (ways != 1) yaml.fail("waypoints", "or explore or trajectory: one of them is wanted");
  if (yaml.has("waypoints")) {
    if (!session.start) yaml.fail("start", "is missing");
    for (const auto& row : yaml.rows("waypoints", 2, 3)) {
      session.waypoints.push_back({{row[0], row[1]}, row.size() > 2 ? row[2] : 0});
      if (row.size() > 2 && !(row[2] >= 0.01)) yaml.fail("waypoints", "has a speed below 0.01 m/s");
    }
  } else if (yaml.has("explore")) {
    YamlMap explore = yaml.map("explore");
    session.exploration.emplace();
    session.exploration->duration = explore.within("duration", session.exploration->duration, 1, 36000);
    if (explore.has("seed")) session.exploration->seed = explore.get<uint64_t>("seed");
    explore.finish();
  } else {
    session.trajectory = yaml.directory() / yaml.get<std::string>("trajectory");
  }
}

/// A recorded trajectory from a new start time on, cut to `duration`.
Trajectory recorded(const std::filesystem::path& file, double start_time, double duration) {
  std::vector<StampedPose> poses = readTumTrajectory(file).poses();
  if (poses.empty()) throw std::runtime_error(file.string() + ": holds no pose");
  const double first = poses.front().time;
  std::erase_if(poses, [&](const StampedPose& pose) { return pose.time - first > duration; });
  for (StampedPose& pose : poses) pose.time += start_time - first;
  const Trajectory path(poses);
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].time - poses[i - 1].time > 0.5)
      throw std::runtime_error(file.string() + ": nothing for over half a second before " +
                               std::to_string(poses[i].time - start_time + first) + " s");
  return path;
}

}  // namespace

Session readSession(YamlMap yaml) {
  Session session;
  readWay(session, yaml);
  session.light = readLight(yaml);
  session.exposure = yaml.within("exposure", session.exposure, 0.05, 20);
  session.changes = readChanges(yaml);
  for (const YamlMap& person : yaml.list("people")) session.people.push_back(readPerson(person));
  yaml.finish();
  return session;
}

Trajectory drive(const Session& session, const RobotModel& robot, const Scene& scene, double start_time,
                 double duration, uint64_t seed) {
  const FloorPlan plan(trianglesOf(scene), robot.height);
  if (session.exploration) {
    Random random(session.exploration->seed.value_or(seed), 5);
    return explore(robot, plan, session.start, start_time, std::min(duration, session.exploration->duration), random);
  }
  const Trajectory path = session.trajectory.empty()
                              ? driveThrough(robot, session.start.value(), session.waypoints, start_time, duration)
                              : recorded(session.trajectory, start_time, duration);
  checkPathIsFree(path, robot, plan, scene.objects);
  return path;
}

}  // namespace vmcl
