// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <utility>

namespace vmcl {

/// What a robot localizes with, besides its odometry.
enum class Sensors {
  camera,    ///< the visual maps of an ini
  laser,     ///< its other maps
  both,      ///< all of them; there must be some of each
  odometry,  ///< nothing: the maps only say when to update
};

inline const std::array<std::pair<std::string, Sensors>, 4> sensors_by_name{
    {{"camera", Sensors::camera}, {"laser", Sensors::laser}, {"both", Sensors::both}, {"odometry", Sensors::odometry}}};

inline const std::string& nameOf(Sensors sensors) { return sensors_by_name[static_cast<std::size_t>(sensors)].first; }

}  // namespace vmcl
