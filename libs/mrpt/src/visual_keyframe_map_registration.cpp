// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/initializer.h>
#include <mrpt/img/CImage.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {

using mrpt::maps::CMetricMap;

namespace {

constexpr const char* section_prefix = "visualKeyframes";

std::string toIni(const VisualMapOptions& options) {
  mrpt::config::CConfigFileMemory ini;
  options.write(ini, section_prefix);
  std::string text;
  ini.getContent(text);
  return text;
}

}  // namespace

MAP_DEFINITION_REGISTER("vmcl::VisualKeyframeMap,visualKeyframes", vmcl::VisualKeyframeMap)
IMPLEMENTS_SERIALIZABLE(VisualKeyframeMap, CMetricMap, vmcl)

MRPT_INITIALIZER(registerVmclClasses) { mrpt::rtti::registerClass(CLASS_ID(VisualKeyframeMap)); }

VisualKeyframeMap::TMapDefinition::TMapDefinition() = default;

void VisualKeyframeMap::TMapDefinition::loadFromConfigFile_map_specific(const mrpt::config::CConfigFileBase& source,
                                                                        const std::string& prefix) {
  options.read(source, prefix);
}

void VisualKeyframeMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
  out << toIni(options);
}

CMetricMap* VisualKeyframeMap::internal_CreateFromMapDefinition(const mrpt::maps::TMetricMapInitializer& definition) {
  const VisualMapOptions& options = dynamic_cast<const TMapDefinition&>(definition).options;
  if (!options.image_directory.empty()) mrpt::img::CImage::setImagesPathBase(options.image_directory);
  return new VisualKeyframeMap(options);
}

uint8_t VisualKeyframeMap::serializeGetVersion() const { return 0; }

void VisualKeyframeMap::serializeTo(mrpt::serialization::CArchive& out) const {
  const auto map = content();
  out << genericMapParams << toIni(options_) << (map ? encodeMap(*map) : std::string());
}

void VisualKeyframeMap::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0)
    throw std::runtime_error("a visual map of version " + std::to_string(version) + ", which is not known");
  mrpt::maps::TMapGenericParams params;
  std::string options_text, bytes;
  in >> params >> options_text >> bytes;
  VisualMapOptions options;
  options.read(mrpt::config::CConfigFileMemory(options_text), section_prefix);
  *this = VisualKeyframeMap(options, bytes.empty() ? nullptr : std::make_shared<const KeyframeMap>(decodeMap(bytes)));
  genericMapParams = params;
}

}  // namespace vmcl
