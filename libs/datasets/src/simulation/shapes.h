// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "scene.h"

namespace vmcl {

/// An upright box.
struct Solid {
  PlanarPose map_from_solid;  ///< at the centre of the footprint
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();
  double bottom = 0;
  double top = 0;
};

enum class Side { front, back, left, right, top, bottom };  ///< +x, -x, +y, -y, +z, -z of a solid

/// The face of a side, without a surface and object yet.
Face sideOf(const Solid& solid, Side side);

/// The outward normal of a flat face.
Eigen::Vector3d normalOf(const Face& face);

std::size_t addSurface(Scene& scene, double width, double height, const Material& material,
                       const Eigen::Vector3d& normal);

/// A face of one side with a surface of its own.
void addSide(Scene& scene, std::size_t object, const Solid& solid, Side side, const Material& material);

/// All sides that can be seen; `front` covers the side towards +x.
void addBox(Scene& scene, std::size_t object, const Solid& solid, const Material& material,
            const std::optional<Material>& front);

/// A round limb, pot, lamp shade or table leg between two points, as thick as given at either end (radii, m);
/// `flatness` scales its thickness along the limb's own second axis.
struct Limb {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::UnitZ();
  double from_radius = 0.1;
  double to_radius = 0.1;
  Eigen::Vector3d wide_axis = Eigen::Vector3d::UnitX();  ///< across the limb, along which it is not flattened
  double flatness = 1;
  bool from_end = true;  ///< whether the ends are closed
  bool to_end = true;
};

/// Faces of a limb or ball, all showing the surface of this number, which should be about as large as the body's skin.
void addLimb(std::vector<Face>& faces, const Limb& limb, std::size_t surface, double width, double height);
void addBall(std::vector<Face>& faces, const Eigen::Vector3d& center, const Eigen::Vector3d& radii, std::size_t surface,
             double width, double height);

}  // namespace vmcl
