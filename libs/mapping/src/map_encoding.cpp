// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_file.h"

#include <zlib.h>

#include <fstream>

#include "byte_stream.h"

// Layout, little endian; a count is u32, a pose the upper three rows of its matrix by columns:
//   magic[8]  version u32  content size u64  CRC-32 of the content u32  content
// content:
//   features    kind u8, max_features i32, mask_rows_from_top i32
//   cameras     count; each: label (count, bytes), width i32, height i32, fx fy cx cy f64, distortion f64[5],
//               pose f64[12], mask_rows_from_top i32, mask bytes (count: 0 or (width * height + 7) / 8),
//               mask u8[mask bytes] (a bit a pixel, by rows, the lowest bit first), source of depth u8
//   keyframes   count; each: time f64, camera i32, session i32, pose f64[12], feature count, descriptor bytes (count),
//               pixels f32[n][2], sizes f32[n], responses f32[n], descriptors u8[n][bytes], landmarks i32[n]
//   landmarks   count; each: point f64[3], lower triangle of the covariance f64[6], observation count i32
//   poses       lower triangle of their covariance f64[6]
//   vocabulary  rows, columns (counts), f32 by columns
//   places      rows, columns (counts), f32 by columns
//   network     file (count, bytes), its CRC-32 u32; no bytes and 0 where features are not those of a network
//   dense       each keyframe: image (count, bytes), depths (count, u16[]); counts 0 in a map that is not dense
//   solutions   u8 a keyframe: 0 both, 1 1P1DP, 2 2DP
//   network     that describes places: file (count, bytes), its CRC-32 u32; no bytes and 0 where the vocabulary does
// Version 4 had no network of places; version 3 no solutions either; version 2 neither them nor masks nor sources of
// depth nor sessions nor networks nor dense data.

namespace vmcl {
namespace {

constexpr std::string_view magic = "VMCLMAP\n";
constexpr std::size_t pose_bytes = 12 * sizeof(double);
constexpr std::size_t camera_bytes = 16 + 9 * sizeof(double) + pose_bytes;  // at least
constexpr std::size_t keyframe_bytes = 20 + pose_bytes;                     // at least
constexpr std::size_t feature_bytes = 20;                                   // without the descriptor
constexpr std::size_t landmark_bytes = 9 * sizeof(double) + 4;

uint32_t checksum(std::string_view bytes) {
  return static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void putPose(ByteWriter& out, const Rigid3& pose) {
  const Eigen::Matrix<double, 3, 4> rows = pose.matrix().topRows<3>();
  out.putAll(std::span<const double>(rows.data(), 12));
}

Rigid3 getPose(ByteReader& in) {
  Eigen::Matrix<double, 3, 4> rows;
  in.getAll(std::span<double>(rows.data(), 12));
  Rigid3 pose = Rigid3::Identity();
  pose.matrix().topRows<3>() = rows;
  return pose;
}

template <class Values>
void putCounted(ByteWriter& out, const Values& values) {
  out.putCount(values.size());
  out.putAll(std::span(values.data(), values.size()));
}

template <class Values>
void getCounted(ByteReader& in, Values& values) {
  values.resize(in.getCount(sizeof(values[0])));
  in.getAll(std::span(values.data(), values.size()));
}

void putMatrix(ByteWriter& out, const Eigen::MatrixXf& matrix) {
  out.putCount(static_cast<std::size_t>(matrix.rows()));
  out.putCount(static_cast<std::size_t>(matrix.cols()));
  out.putAll(std::span<const float>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

Eigen::MatrixXf getMatrix(ByteReader& in) {
  const uint64_t rows = in.get<uint32_t>(), columns = in.get<uint32_t>();
  if (columns > 0 && rows > in.remaining().size() / sizeof(float) / columns) throw std::runtime_error("cut off");
  Eigen::MatrixXf matrix(rows, columns);
  in.getAll(std::span<float>(matrix.data(), rows * columns));
  return matrix;
}

void putMask(ByteWriter& out, const Image& mask) {
  std::vector<uint8_t> bits((mask.pixels.size() + 7) / 8);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    if (mask.pixels[i] >= 128) bits[i / 8] |= static_cast<uint8_t>(1 << i % 8);
  out.putCount(bits.size());
  out.putAll(std::span<const uint8_t>(bits));
}

Image getMask(ByteReader& in, const PinholeCamera& camera) {
  std::vector<uint8_t> bits(in.getCount(1));
  in.getAll(std::span<uint8_t>(bits));
  if (bits.empty()) return {};
  camera.check();
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  if (bits.size() != (pixels + 7) / 8) throw std::runtime_error("a mask of another size than its images");
  Image mask{camera.width, camera.height, std::vector<uint8_t>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) mask.pixels[i] = (bits[i / 8] >> i % 8 & 1) ? 255 : 0;
  return mask;
}

void putCamera(ByteWriter& out, const MapCamera& camera) {
  putCounted(out, camera.label);
  const PinholeCamera& pinhole = camera.calibration.pinhole;
  for (int size : {pinhole.width, pinhole.height}) out.put<int32_t>(size);
  for (double value : {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy}) out.put(value);
  out.putAll(std::span<const double>(camera.calibration.distortion));
  putPose(out, camera.robot_from_camera);
  out.put<int32_t>(camera.mask_rows_from_top);
  putMask(out, camera.mask);
  out.put(static_cast<uint8_t>(camera.depth));
}

MapCamera getCamera(ByteReader& in, uint32_t version) {
  MapCamera camera;
  getCounted(in, camera.label);
  PinholeCamera& pinhole = camera.calibration.pinhole;
  for (int* size : {&pinhole.width, &pinhole.height}) *size = in.get<int32_t>();
  for (double* value : {&pinhole.fx, &pinhole.fy, &pinhole.cx, &pinhole.cy}) *value = in.get<double>();
  in.getAll(std::span<double>(camera.calibration.distortion));
  camera.robot_from_camera = getPose(in);
  camera.mask_rows_from_top = in.get<int32_t>();
  if (version == 2) return camera;
  camera.mask = getMask(in, pinhole);
  camera.depth = static_cast<DepthSource>(in.get<uint8_t>());
  return camera;
}

void putKeyframe(ByteWriter& out, const Keyframe& keyframe) {
  out.put(keyframe.time);
  out.put<int32_t>(keyframe.camera);
  out.put<int32_t>(keyframe.session);
  putPose(out, keyframe.map_from_robot);
  const FeatureSet& features = keyframe.features;
  out.putCount(features.pixels.size());
  out.putCount(static_cast<std::size_t>(features.descriptors.cols()));
  for (const Eigen::Vector2f& pixel : features.pixels) out.putAll(std::span<const float>(pixel.data(), 2));
  out.putAll(std::span<const float>(features.sizes));
  out.putAll(std::span<const float>(features.responses));
  out.putAll(
      std::span<const uint8_t>(features.descriptors.data(), static_cast<std::size_t>(features.descriptors.size())));
  out.putAll(std::span<const int32_t>(keyframe.landmark_of_feature));
}

Keyframe getKeyframe(ByteReader& in, FeatureKind kind, uint32_t version) {
  Keyframe keyframe;
  keyframe.time = in.get<double>();
  keyframe.camera = in.get<int32_t>();
  if (version > 2) keyframe.session = in.get<int32_t>();
  keyframe.map_from_robot = getPose(in);
  const std::size_t count = in.getCount(feature_bytes);
  const std::size_t descriptor_bytes = in.get<uint32_t>();
  in.require(count * (feature_bytes + descriptor_bytes));
  FeatureSet& features = keyframe.features;
  features.kind = kind;
  features.pixels.resize(count);
  features.sizes.resize(count);
  features.responses.resize(count);
  features.descriptors.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(descriptor_bytes));
  keyframe.landmark_of_feature.resize(count);
  for (Eigen::Vector2f& pixel : features.pixels) in.getAll(std::span<float>(pixel.data(), 2));
  in.getAll(std::span<float>(features.sizes));
  in.getAll(std::span<float>(features.responses));
  in.getAll(std::span<uint8_t>(features.descriptors.data(), count * descriptor_bytes));
  in.getAll(std::span<int32_t>(keyframe.landmark_of_feature));
  return keyframe;
}

void putCovariance(ByteWriter& out, const Eigen::Matrix3d& covariance) {
  for (int column = 0; column < 3; ++column)
    for (int row = column; row < 3; ++row) out.put(covariance(row, column));
}

Eigen::Matrix3d getCovariance(ByteReader& in) {
  Eigen::Matrix3d covariance;
  for (int column = 0; column < 3; ++column)
    for (int row = column; row < 3; ++row) covariance(row, column) = covariance(column, row) = in.get<double>();
  return covariance;
}

void putLandmark(ByteWriter& out, const Landmark& landmark) {
  out.putAll(std::span<const double>(landmark.point_in_map.data(), 3));
  putCovariance(out, landmark.covariance);
  out.put<int32_t>(landmark.observation_count);
}

Landmark getLandmark(ByteReader& in) {
  Landmark landmark;
  in.getAll(std::span<double>(landmark.point_in_map.data(), 3));
  landmark.covariance = getCovariance(in);
  landmark.observation_count = in.get<int32_t>();
  return landmark;
}

void putNetwork(ByteWriter& out, const FeatureModel& network) {
  putCounted(out, network.file);
  out.put(network.crc32);
}

FeatureModel getNetwork(ByteReader& in) {
  FeatureModel network;
  getCounted(in, network.file);
  network.crc32 = in.get<uint32_t>();
  return network;
}

std::string encodeContent(const KeyframeMap& map) {
  ByteWriter out;
  out.put(static_cast<uint8_t>(map.feature_options.kind));
  out.put<int32_t>(map.feature_options.max_features);
  out.put<int32_t>(map.feature_options.mask_rows_from_top);
  out.putCount(map.cameras.size());
  for (const MapCamera& camera : map.cameras) putCamera(out, camera);
  out.putCount(map.keyframes.size());
  for (const Keyframe& keyframe : map.keyframes) putKeyframe(out, keyframe);
  out.putCount(map.landmarks.size());
  for (const Landmark& landmark : map.landmarks) putLandmark(out, landmark);
  putCovariance(out, map.pose_covariance);
  putMatrix(out, map.vocabulary.words());
  putMatrix(out, map.place_descriptors);
  putNetwork(out, map.feature_options.model);
  for (const Keyframe& keyframe : map.keyframes) {
    putCounted(out, keyframe.dense.image);
    putCounted(out, keyframe.dense.depth);
  }
  for (const Keyframe& keyframe : map.keyframes) out.put(static_cast<uint8_t>(keyframe.solution));
  putNetwork(out, map.place_network);
  return out.take();
}

KeyframeMap decodeContent(std::string_view content, uint32_t version) {
  ByteReader in(content);
  KeyframeMap map;
  map.feature_options.kind = static_cast<FeatureKind>(in.get<uint8_t>());
  nameOf(map.feature_options.kind);  // throws for an unknown one
  map.feature_options.max_features = in.get<int32_t>();
  map.feature_options.mask_rows_from_top = in.get<int32_t>();
  map.cameras.resize(in.getCount(camera_bytes));
  for (MapCamera& camera : map.cameras) camera = getCamera(in, version);
  map.keyframes.resize(in.getCount(keyframe_bytes));
  for (Keyframe& keyframe : map.keyframes) keyframe = getKeyframe(in, map.feature_options.kind, version);
  map.landmarks.resize(in.getCount(landmark_bytes));
  for (Landmark& landmark : map.landmarks) landmark = getLandmark(in);
  map.pose_covariance = getCovariance(in);
  if (Eigen::MatrixXf words = getMatrix(in); words.size() > 0)
    map.vocabulary = VladVocabulary(map.feature_options.kind, std::move(words));
  map.place_descriptors = getMatrix(in);
  if (version > 2) {
    map.feature_options.model = getNetwork(in);
    for (Keyframe& keyframe : map.keyframes) {
      getCounted(in, keyframe.dense.image);
      getCounted(in, keyframe.dense.depth);
    }
  }
  if (version > 3)
    for (Keyframe& keyframe : map.keyframes) keyframe.solution = static_cast<Solver>(in.get<uint8_t>());
  if (version > 4) map.place_network = getNetwork(in);
  if (!in.remaining().empty()) throw std::runtime_error("content is followed by bytes that do not belong to it");
  map.check();
  return map;
}

}  // namespace

std::string encodeMap(const KeyframeMap& map) {
  map.check();
  const std::string content = encodeContent(map);
  ByteWriter out;
  out.putAll(std::span<const char>(magic));
  out.put(map_file_version);
  out.put<uint64_t>(content.size());
  out.put(checksum(content));
  return out.take() + content;
}

KeyframeMap decodeMap(const std::string& bytes) {
  if (!bytes.starts_with(magic)) throw std::runtime_error("not a .vmap file");
  ByteReader in(std::string_view(bytes).substr(magic.size()));
  const auto version = in.get<uint32_t>();
  if (version > map_file_version)
    throw std::runtime_error("format version " + std::to_string(version) + " of a newer vmcl: this one reads up to " +
                             std::to_string(map_file_version));
  if (version < oldest_map_file_version)
    throw std::runtime_error("format version " + std::to_string(version) +
                             " of an older vmcl, no longer read: " + "make the map again from its log with `vmcl map`");
  const auto size = in.get<uint64_t>();
  const auto stored_checksum = in.get<uint32_t>();
  if (in.remaining().size() < size) throw std::runtime_error("cut off");
  if (in.remaining().size() > size) throw std::runtime_error("longer than its header says");
  if (checksum(in.remaining()) != stored_checksum) throw std::runtime_error("damaged: wrong checksum");
  try {
    return decodeContent(in.remaining(), version);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("broken content: ") + error.what());
  }
}

}  // namespace vmcl
