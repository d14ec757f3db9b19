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

/// Contents of the files and the job's maps, what is changed of the ini, and what is disturbed.
std::string JobDescriber::textOfInputs(const Job& job, const std::vector<std::filesystem::path>& files) {
  std::string all;
  const auto add = [&](const std::string& part) { all += '\n' + part; };
  for (const auto& file : files) add(hexadecimal(checksum(file)));
  for (const auto& map : experiment_.sessions[job.session].maps)
    add(map.extension().string() + hexadecimal(checksum(map)));
  for (const std::string& change : experiment_.configurations[job.method.configuration].changes) add(change);
  for (const std::string& option : optionsOf(experiment_.sessions[job.session].disturbance)) add(option);
  return all;
}

std::string JobDescriber::hashOf(const Job& job) {
  const ExperimentSession& session = experiment_.sessions[job.session];
  const Configuration& configuration = experiment_.configurations[job.method.configuration];
  return hexadecimal(crcOf(job.id +  // sensors, start and seed are in it
                           textOfInputs(job, {session.rawlog, session.ground_truth, configuration.ini})));
}

std::string JobDescriber::matchHashOf(const Job& job) {
  return hexadecimal(crcOf(textOfInputs(
      job, {experiment_.sessions[job.session].rawlog, experiment_.configurations[job.method.configuration].ini})));
}

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
