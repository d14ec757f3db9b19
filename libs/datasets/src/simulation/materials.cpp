// SPDX-License-Identifier: BSD-3-Clause
#include "materials.h"

#include <map>

namespace vmcl {
namespace {

using MaterialPainter = void (*)(const Canvas&, const cv::Scalar&);

const std::map<std::string, MaterialPainter>& materialPainters() {
  static const std::map<std::string, MaterialPainter> materialPainters{{"plain", paintPlain},
                                                                       {"plaster", paintPlaster},
                                                                       {"bricks", paintBricks},
                                                                       {"wallpaper", paintWallpaper},
                                                                       {"planks", paintPlanks},
                                                                       {"tiles", paintTiles},
                                                                       {"carpet", paintCarpet},
                                                                       {"ceiling", paintCeiling},
                                                                       {"wood", paintWood},
                                                                       {"drawers", paintDrawers},
                                                                       {"books", paintBooks},
                                                                       {"fabric", paintFabric},
                                                                       {"fridge", paintFridge},
                                                                       {"cardboard", paintCardboard},
                                                                       {"cloth", paintCloth},
                                                                       {"rug", paintRug},
                                                                       {"curtain", paintCurtain},
                                                                       {"leaves", paintLeaves},
                                                                       {"marble", paintMarble},
                                                                       {"metal", paintMetal},
                                                                       {"screen", paintScreen},
                                                                       {"paper", paintPaper},
                                                                       {"ceiling_panels", paintCeilingPanels},
                                                                       {"blank_wall", paintBlankWall},
                                                                       {"office_carpet", paintOfficeCarpet},
                                                                       {"lockers", paintLockers},
                                                                       {"whiteboard", paintWhiteboard},
                                                                       {"city", paintCity},
                                                                       {"garden", paintGarden}};
  return materialPainters;
}

}  // namespace

bool isMaterial(const std::string& name) { return materialPainters().contains(name); }

std::string materialNames() {
  std::string names;
  for (const auto& [name, painter] : materialPainters()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void paintMaterial(const std::string& name, const Canvas& canvas, const cv::Scalar& color) {
  materialPainters().at(name)(canvas, color);
}

}  // namespace vmcl
