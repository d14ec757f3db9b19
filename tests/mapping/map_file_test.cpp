// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_file.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cstring>
#include <fstream>

#include "small_map.h"

namespace vmcl {
namespace {

using testing::smallMap;

constexpr std::size_t header_bytes = 24;
constexpr uint32_t structured_bytes = 1800;  // of the content; only the floats of vocabulary and places follow

/// A folder of its own for a test, removed with it.
class MapFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("vmcl_map_file_test_" + std::to_string(::getpid()));
};

void setChecksum(std::string& bytes) {
  const auto crc = static_cast<uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + header_bytes), uInt(bytes.size() - header_bytes)));
  std::memcpy(bytes.data() + 20, &crc, sizeof crc);
}

std::string readAll(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(MapFile, LoadsAndSavesTheSameBytes) {
  saveMap(folder_ / "a.vmap", smallMap());
  saveMap(folder_ / "b.vmap", loadMap(folder_ / "a.vmap"));
  EXPECT_EQ(readAll(folder_ / "a.vmap"), readAll(folder_ / "b.vmap"));
  EXPECT_EQ(readAll(folder_ / "a.vmap"), encodeMap(smallMap()));
  EXPECT_EQ(encodeMap(decodeMap(encodeMap(KeyframeMap{}))), encodeMap(KeyframeMap{}));
}

TEST_F(MapFile, KeepsEveryValue) {
  const KeyframeMap map = smallMap(), loaded = decodeMap(encodeMap(map));
  EXPECT_EQ(loaded.feature_options.mask_rows_from_top, 2);
  EXPECT_EQ(loaded.cameras[0].label, "front");
  EXPECT_EQ(loaded.cameras[0].calibration.distortion, map.cameras[0].calibration.distortion);
  EXPECT_EQ(loaded.cameras[0].robot_from_camera.matrix(), map.cameras[0].robot_from_camera.matrix());
  EXPECT_TRUE(loaded.cameras[0].mask.view().empty());
  EXPECT_EQ(loaded.cameras[1].mask.width, 20);
  EXPECT_EQ(loaded.cameras[1].mask.pixels, map.cameras[1].mask.pixels);
  EXPECT_EQ(loaded.cameras[1].depth, DepthSource::range);
  EXPECT_EQ(loaded.keyframes[2].session, 1);
  EXPECT_EQ(loaded.keyframes[2].map_from_robot.matrix(), map.keyframes[2].map_from_robot.matrix());
  EXPECT_EQ(loaded.keyframes[2].features.pixels, map.keyframes[2].features.pixels);
  EXPECT_EQ(loaded.keyframes[2].features.descriptors, map.keyframes[2].features.descriptors);
  EXPECT_EQ(loaded.keyframes[2].landmark_of_feature, map.keyframes[2].landmark_of_feature);
  EXPECT_EQ(loaded.keyframes[2].dense.image, map.keyframes[2].dense.image);
  EXPECT_EQ(loaded.keyframes[1].dense.depth, map.keyframes[1].dense.depth);
  EXPECT_TRUE(loaded.keyframes[2].dense.depth.empty());
  EXPECT_EQ(loaded.keyframes[1].solution, Solver::two_depth);
  EXPECT_TRUE(loaded.isDense());
  EXPECT_EQ(loaded.landmarks[3].point_in_map, map.landmarks[3].point_in_map);
  EXPECT_EQ(loaded.landmarks[3].covariance, map.landmarks[3].covariance);
  EXPECT_EQ(loaded.vocabulary.words(), map.vocabulary.words());
  EXPECT_EQ(loaded.place_descriptors, map.place_descriptors);
}

// The files were written by the programs that wrote those versions.
TEST_F(MapFile, OpensTheVersionsBefore) {
  KeyframeMap expected = smallMap();
  EXPECT_EQ(encodeMap(loadMap(std::filesystem::path(VMCL_TEST_DATA_DIR) / "version4.vmap")), encodeMap(expected));
  for (Keyframe& keyframe : expected.keyframes) keyframe.solution = Solver::automatic;
  EXPECT_EQ(encodeMap(loadMap(std::filesystem::path(VMCL_TEST_DATA_DIR) / "version3.vmap")), encodeMap(expected));
  expected.cameras[1].mask = {};
  expected.cameras[1].depth = DepthSource::none;
  expected.keyframes[2].session = 0;
  for (Keyframe& keyframe : expected.keyframes) keyframe.dense = {};
  const KeyframeMap loaded = loadMap(std::filesystem::path(VMCL_TEST_DATA_DIR) / "version2.vmap");
  EXPECT_EQ(encodeMap(loaded), encodeMap(expected));
}

TEST_F(MapFile, TakesTheNetworksBesideTheMap) {
  KeyframeMap map;
  map.feature_options.choose("elsewhere/net.onnx");
  map.feature_options.model.crc32 = 7;
  map.place_network = {"elsewhere/places.onnx", 8};
  saveMap(folder_ / "a.vmap", map);
  EXPECT_EQ(loadMap(folder_ / "a.vmap").feature_options.model, (FeatureModel{"elsewhere/net.onnx", 7}));
  EXPECT_EQ(loadMap(folder_ / "a.vmap").place_network, (FeatureModel{"elsewhere/places.onnx", 8}));
  for (const char* name : {"net.onnx", "places.onnx"}) std::ofstream(folder_ / name) << "a network";
  EXPECT_EQ(loadMap(folder_ / "a.vmap").place_network, (FeatureModel{(folder_ / "places.onnx").string(), 8}));
  EXPECT_EQ(loadMap(folder_ / "a.vmap").feature_options.model, (FeatureModel{(folder_ / "net.onnx").string(), 7}));
}

TEST_F(MapFile, RefusesEveryCutOffLength) {
  const std::string bytes = encodeMap(smallMap());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_THROW(decodeMap(bytes.substr(0, length)), std::runtime_error) << length << " of " << bytes.size();
  EXPECT_THROW(decodeMap(bytes + '\0'), std::runtime_error);
}

// CRC-32 finds every error of one bit, so there is no chance of a false alarm.
TEST_F(MapFile, RefusesFlippedBits) {
  const std::string bytes = encodeMap(smallMap());
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string damaged = bytes;
    const std::size_t place = trial < 192 ? static_cast<std::size_t>(trial / 8) : random.below(uint32_t(bytes.size()));
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << (trial % 8)));
    EXPECT_THROW(decodeMap(damaged), std::runtime_error) << "byte " << place << " bit " << trial % 8;
  }
}

// A forger can make the checksum right: what is loaded must then still be a valid map, whatever the bytes.
TEST_F(MapFile, ForgedContentIsRefusedOrValid) {
  const std::string bytes = encodeMap(smallMap());
  Random random(6);
  int refused = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::string forged = bytes;
    for (int i = 0; i < 4; ++i) forged[header_bytes + random.below(structured_bytes)] ^= static_cast<char>(0xff);
    setChecksum(forged);
    try {
      const KeyframeMap map = decodeMap(forged);
      EXPECT_NO_THROW(map.check());
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(MapFile, HugeCountsTakeNoMemory) {
  const std::string bytes = encodeMap(smallMap());
  for (std::size_t place = header_bytes; place < header_bytes + structured_bytes; ++place) {
    std::string huge = bytes;
    std::memset(huge.data() + place, 0x7f, 8);
    setChecksum(huge);
    try {
      decodeMap(huge);
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find("alloc"), std::string::npos) << "at " << place << ": " << error.what();
    }
  }
}

TEST_F(MapFile, NamesFileAndReason) {
  std::string bytes = encodeMap(smallMap());
  bytes[8] = map_file_version + 1;
  std::ofstream(folder_ / "newer.vmap", std::ios::binary) << bytes;
  bytes[8] = oldest_map_file_version - 1;
  std::ofstream(folder_ / "older.vmap", std::ios::binary) << bytes;
  std::ofstream(folder_ / "other.vmap") << "an image, perhaps";
  std::ofstream(folder_ / "empty.vmap");
  const std::pair<const char*, const char*> cases[] = {
      {"newer.vmap", "of a newer vmcl"}, {"older.vmap", "make the map again"}, {"other.vmap", "not a .vmap"},
      {"empty.vmap", "not a .vmap"},     {"missing.vmap", "no such file"},     {"", "not a regular file"}};
  for (const auto& [name, reason] : cases) {
    try {
      loadMap(folder_ / name);
      ADD_FAILURE() << "loaded " << name;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find((folder_ / name).string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(MapFile, BrokenMapsAreNotSaved) {
  KeyframeMap map = smallMap();
  map.keyframes[2].landmark_of_feature[0] = 99;
  EXPECT_THROW(saveMap(folder_ / "broken.vmap", map), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "broken.vmap"));
}

}  // namespace
}  // namespace vmcl
