// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "canvas.h"

namespace vmcl {

bool isMaterial(const std::string& name);

/// All names, for messages.
std::string materialNames();

/// Covers the canvas. Throws std::out_of_range for a name that is not a material.
void paintMaterial(const std::string& name, const Canvas& canvas, const cv::Scalar& color);

// Walls: wall_materials.cpp
void paintPlain(const Canvas& canvas, const cv::Scalar& color);
void paintPlaster(const Canvas& canvas, const cv::Scalar& color);
void paintBricks(const Canvas& canvas, const cv::Scalar& color);
void paintWallpaper(const Canvas& canvas, const cv::Scalar& color);

// Floors and ceilings: floor_materials.cpp
void paintPlanks(const Canvas& canvas, const cv::Scalar& color);
void paintTiles(const Canvas& canvas, const cv::Scalar& color);
void paintCarpet(const Canvas& canvas, const cv::Scalar& color);
void paintCeiling(const Canvas& canvas, const cv::Scalar& color);

// Furniture: furniture_materials.cpp
void paintWood(const Canvas& canvas, const cv::Scalar& color);
void paintDrawers(const Canvas& canvas, const cv::Scalar& color);
void paintBooks(const Canvas& canvas, const cv::Scalar& color);
void paintFabric(const Canvas& canvas, const cv::Scalar& color);
void paintFridge(const Canvas& canvas, const cv::Scalar& color);
void paintCardboard(const Canvas& canvas, const cv::Scalar& color);

// Textiles, plants and surfaces of small things: soft_materials.cpp
void paintCloth(const Canvas& canvas, const cv::Scalar& color);
void paintRug(const Canvas& canvas, const cv::Scalar& color);
void paintCurtain(const Canvas& canvas, const cv::Scalar& color);
void paintLeaves(const Canvas& canvas, const cv::Scalar& color);
void paintMarble(const Canvas& canvas, const cv::Scalar& color);
void paintMetal(const Canvas& canvas, const cv::Scalar& color);
void paintScreen(const Canvas& canvas, const cv::Scalar& color);
void paintPaper(const Canvas& canvas, const cv::Scalar& color);

// Offices: office_materials.cpp
void paintCeilingPanels(const Canvas& canvas, const cv::Scalar& color);
void paintBlankWall(const Canvas& canvas, const cv::Scalar& color);
void paintOfficeCarpet(const Canvas& canvas, const cv::Scalar& color);
void paintLockers(const Canvas& canvas, const cv::Scalar& color);
void paintWhiteboard(const Canvas& canvas, const cv::Scalar& color);

// Views from windows: backdrop_materials.cpp
void paintCity(const Canvas& canvas, const cv::Scalar& color);
void paintGarden(const Canvas& canvas, const cv::Scalar& color);

}  // namespace vmcl
