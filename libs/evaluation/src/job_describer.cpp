// SPDX-License-Identifier: BSD-3-Clause
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "vmcl/evaluation/experiment_plan.h"

namespace vmcl {
namespace {

uint32_t crcOf(const std::string& text) {
  return static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

uint32_t crcOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<char> buffer(1 << 16);
  uLong crc = crc32_z(0, nullptr, 0);
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(buffer.data()), static_cast<z_size_t>(in.gcount()));
  }
  if (!in.eof()) throw std::runtime_error(file.string() + ": cannot be read");
  return static_cast<uint32_t>(crc);
}

std::string hexadecimal(uint32_t number) {
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", number);
  return digits.data();
}

}  // namespace

uint32_t JobDescriber::checksum(const std::filesystem::path& file) {
  const auto known =
      std::find_if(checksums_.begin(), checksums_.end(), [&](const auto& entry) { return entry.first == file; });
  if (known != checksums_.end()) return known->second;
  return checksums_.emplace_back(file, crcOf(file)).second;
}

/// Contents of the job's log and maps, and what is disturbed.
std::string JobDescriber::textOfSession(const Job& job) {
  const ExperimentSession& session = experiment_.sessions[job.session];
  std::string all = hexadecimal(checksum(session.rawlog));
  for (const auto& map : session.maps) all += '\n' + map.extension().string() + hexadecimal(checksum(map));
  for (const std::string& option : optionsOf(session.disturbance)) all += '\n' + option;
  return all;
}

std::string JobDescriber::hashOf(const Job& job) {
  const Configuration& configuration = experiment_.configurations[job.method.configuration];
  std::string all = job.id + '\n' + textOfSession(job);  // sensors, start and seed are in the first
  for (const auto& file : {experiment_.sessions[job.session].ground_truth, configuration.ini})
    all += '\n' + hexadecimal(checksum(file));
  for (const std::string& change : configuration.changes) all += '\n' + change;
  return hexadecimal(crcOf(all));
}

std::string JobDescriber::matchHashOf(const Job& job) { return hexadecimal(crcOf(textOfSession(job))); }

std::string JobDescriber::describe(const Job& job) {
  const nlohmann::ordered_json json = {{"id", job.id},
                                       {"rawlog", experiment_.sessions[job.session].name},
                                       {"sensors", nameOf(job.method.sensors)},
                                       {"configuration", experiment_.configurations[job.method.configuration].name},
                                       {"start", experiment_.starts[job.start].name},
                                       {"seed", job.seed},
                                       {"hash", hashOf(job)},
                                       {"command", commandOf(experiment_, job)}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace vmcl
