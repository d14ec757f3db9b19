// SPDX-License-Identifier: BSD-3-Clause
#include "match_store.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/Clock.h>
#include <zlib.h>

#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <vector>

#include "vmcl/geometry/atomic_file.h"

// Layout: magic[8], CRC-32 of the numbers u32, numbers f64[] in the machine's byte order:
//   counts of query cameras, reference cameras and matches
//   cameras   each: width height fx fy cx cy, pose by columns [16]
//   matches   each: query camera, pixel [2], reference camera, pixel [2], inlier odds, point known (0 or 1), point [3],
//             covariance [9]

namespace vmcl {
namespace {

constexpr std::string_view magic = "VMCLMAT2";  // another when relocalization matches otherwise with the same options
constexpr std::size_t max_count = 1'000'000;

uint32_t checksumOf(const std::vector<double>& numbers) {
  return static_cast<uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(numbers.data()), numbers.size() * sizeof(double)));
}

/// Of what decides on the matches, wherever the files lie: not of how particles are weighed by them.
uint32_t checksumOf(VisualMapOptions options) {
  const VisualMapOptions usual;
  options.map_file = options.image_directory = options.match_directory = "";
  options.particle_sigma_px = usual.particle_sigma_px;
  options.match_correlation = usual.match_correlation;
  options.max_matches = usual.max_matches;
  mrpt::config::CConfigFileMemory ini;
  options.write(ini, "map");
  const std::string text = ini.getContent();
  return static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

/// Takes the numbers of a problem out of it, or puts them in, in one order.
template <typename Number, typename Problem>
void visitNumbers(Problem& problem, Number&& number) {
  const auto all = [&](auto& values) {
    for (auto& value : std::span(values.data(), static_cast<std::size_t>(values.size()))) number(value);
  };
  const auto camera = [&](auto& pinhole, auto& pose) {
    number(pinhole.width);
    number(pinhole.height);
    for (auto* value : {&pinhole.fx, &pinhole.fy, &pinhole.cx, &pinhole.cy}) number(*value);
    all(pose.matrix());
  };
  for (auto& one : problem.query_cameras) camera(one.camera, one.robot_from_camera);
  for (auto& one : problem.reference_cameras) camera(one.camera, one.map_from_camera);
  for (auto& match : problem.matches) {
    number(match.query_camera);
    all(match.query_pixel);
    number(match.reference_camera);
    all(match.reference_pixel);
    number(match.inlier_odds);
    auto point = match.point.value_or(MapPoint{});
    bool known = match.point.has_value();
    number(known);
    all(point.point_in_map);
    all(point.covariance);
    if constexpr (!std::is_const_v<Problem>) {
      if (known) match.point = point;
    }
  }
}

std::vector<double> numbersOf(const PoseProblem& problem) {
  std::vector<double> numbers{static_cast<double>(problem.query_cameras.size()),
                              static_cast<double>(problem.reference_cameras.size()),
                              static_cast<double>(problem.matches.size())};
  visitNumbers(problem, [&](const auto& value) { numbers.push_back(static_cast<double>(value)); });
  return numbers;
}

/// Throws std::runtime_error or std::invalid_argument for numbers that make no problem.
PoseProblem problemOf(const std::vector<double>& numbers) {
  std::size_t next = 0;
  const auto take = [&] {
    if (next == numbers.size()) throw std::runtime_error("cut off");
    return numbers[next++];
  };
  const auto count = [&] {
    const double value = take();
    if (!(value >= 0 && value <= max_count)) throw std::runtime_error("no count");
    return static_cast<std::size_t>(value);
  };
  PoseProblem problem;
  problem.query_cameras.resize(count());
  problem.reference_cameras.resize(count());
  problem.matches.resize(count());
  visitNumbers(problem, [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(take()); });
  problem.check();
  return problem;
}

std::vector<double> readNumbers(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  constexpr std::size_t head = magic.size() + sizeof(uint32_t);
  if (bytes.size() < head || !bytes.starts_with(magic)) throw std::runtime_error("none of ours");
  std::vector<double> numbers((bytes.size() - head) / sizeof(double));
  std::memcpy(numbers.data(), bytes.data() + head, numbers.size() * sizeof(double));
  uint32_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + magic.size(), sizeof checksum);
  if (checksum != checksumOf(numbers)) throw std::runtime_error("not whole");
  return numbers;
}

}  // namespace

MatchStore::MatchStore(const VisualMapOptions& options)
    : directory_(options.match_directory), options_checksum_(checksumOf(options)) {}

std::filesystem::path MatchStore::fileOf(const mrpt::obs::CObservation& image) const {
  std::string name;
  for (const unsigned char c : image.sensorLabel) name += std::isalnum(c) ? std::string(1, c) : '%' + std::to_string(c);
  return directory_ / (name + '-' + std::to_string(image.timestamp.time_since_epoch().count()) + '-' +
                       std::to_string(options_checksum_));
}

std::optional<PoseProblem> MatchStore::find(const mrpt::obs::CObservation& image) const try {
  if (directory_.empty()) return std::nullopt;
  return problemOf(readNumbers(fileOf(image)));
} catch (const std::exception&) {
  return std::nullopt;
}

void MatchStore::keep(const mrpt::obs::CObservation& image, const PoseProblem& problem) const try {
  if (directory_.empty()) return;
  std::filesystem::create_directories(directory_);
  const std::vector<double> numbers = numbersOf(problem);
  const uint32_t checksum = checksumOf(numbers);
  AtomicFile file(fileOf(image));
  file.stream() << magic;
  file.stream().write(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  file.stream().write(reinterpret_cast<const char*>(numbers.data()),
                      static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  file.commit();
} catch (const std::exception&) {
}

}  // namespace vmcl
