// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "vmcl/mapping/keyframe_map.h"

namespace vmcl {

/// The .vmap file: magic "VMCLMAP\n", format version, size and CRC-32 of the content, content (little endian; layout
/// in map_encoding.cpp). The same map always gives the same bytes.
inline constexpr uint32_t map_file_version = 5;
inline constexpr uint32_t oldest_map_file_version = 2;  ///< that is still read

/// Written aside, synced and renamed. Throws std::runtime_error naming the file.
void saveMap(const std::filesystem::path& file, const KeyframeMap& map);

/// Throws std::runtime_error naming file and reason: missing, not a .vmap, cut off, checksum, version, broken content.
/// Sizes are checked against the file before memory is taken. A network that lies beside the map under the name that
/// the map has is taken in place of the one at the path that the map has.
KeyframeMap loadMap(const std::filesystem::path& file);

/// The same bytes as the file, for embedding in another stream.
std::string encodeMap(const KeyframeMap& map);
KeyframeMap decodeMap(const std::string& bytes);

}  // namespace vmcl
