// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_file.h"

#include <fstream>
#include <stdexcept>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {

void saveMap(const std::filesystem::path& file, const KeyframeMap& map) {
  const std::string bytes = encodeMap(map);
  AtomicFile out(file);
  out.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.commit();
}

KeyframeMap loadMap(const std::filesystem::path& file) {
  try {
    if (!std::filesystem::exists(file)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("not a regular file");
    std::string bytes(std::filesystem::file_size(file), '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) throw std::runtime_error("cannot be read");
    KeyframeMap map = decodeMap(bytes);
    for (std::string* network : {&map.feature_options.model.file, &map.place_network.file}) {
      const std::filesystem::path beside = file.parent_path() / std::filesystem::path(*network).filename();
      if (!network->empty() && std::filesystem::exists(beside)) *network = beside.string();
    }
    return map;
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace vmcl
