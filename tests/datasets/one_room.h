// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vmcl {

/// A scene file: a room of 4 m x 3 m with a door in the north, a box, and a short drive.
inline constexpr char one_room_scene[] = R"(
wall_height: 2.5
floors: [{from: [0, 0], to: [4, 3], cover: {material: planks, rgb: [170, 120, 80]}}]
walls:
  - {from: [0, 0], to: [4, 0], thickness: 0.1, left: {material: bricks}, right: {material: plain},
     on_left: [{kind: painting, center: [2, 1.2], size: [1, 0.6]}]}
  - {from: [4, 0], to: [4, 3], thickness: 0.1, left: {material: plaster}, right: {material: plain}}
  - {from: [4, 3], to: [0, 3], thickness: 0.1, left: {material: wallpaper}, right: {material: plain},
     doors: [{at: 2, width: 0.9, height: 2}]}
  - {from: [0, 3], to: [0, 0], thickness: 0.1, left: {material: plaster}, right: {material: plain}}
boxes:
  - {name: crate, center: [3, 2], size: [0.4, 0.4, 0.5], yaw_deg: 30, sides: {material: cardboard}}
robot: {radius: 0.2}
camera: {rate: 4, width: 160, height: 120, fov_deg: 90, robot_from_camera: {x: 0.1, z: 0.4}}
laser: {rate: 5, rays: 91, aperture_deg: 90, sigma: 0, robot_from_laser: {x: 0.1, z: 0.25}}
odometry: {rate: 20, alpha1: 0.01}
sessions:
  map:
    start: [1, 1, 90]
    waypoints: [[1, 2.0], [2, 1]]
    brightness: 0.9
  through_the_wall:
    start: [1, 1, 180]
    waypoints: [[-2, 1]]
)";

}  // namespace vmcl
