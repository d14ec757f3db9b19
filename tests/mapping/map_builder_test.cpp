// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/map_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scratch_directory.h"
#include "synthetic_room.h"
#include "tiny_network.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/vision/place_network.h"

namespace vmcl {
namespace {

using testing::Recording;

TEST(MapBuilder, SameInputGivesTheSameBytes) {
  const Recording recording;
  const std::string first = encodeMap(recording.build(recording.builderOptions(), 5).first);
  EXPECT_EQ(first, encodeMap(recording.build(recording.builderOptions(), 5).first));
  EXPECT_EQ(first, encodeMap(decodeMap(first)));
}

TEST(MapBuilder, KeyframesAreTakenByMotionOfEachCamera) {
  MapBuilderOptions options;
  options.features.kind = FeatureKind::orb;
  options.keyframe_distance = 0.1;
  options.keyframe_rotation = 0.2;
  MapBuilder builder({testing::forwardCamera(), testing::forwardCamera()}, options);
  FeatureSet features;
  features.descriptors.resize(0, 32);
  EXPECT_TRUE(builder.add(0, 0, toRigid3({0, 0, 0}), features));
  EXPECT_TRUE(builder.add(0, 1, toRigid3({0, 0, 0}), features));
  EXPECT_FALSE(builder.add(1, 0, toRigid3({0.09, 0, 0.19}), features));
  EXPECT_FALSE(builder.isNewKeyframe(1, 0, toRigid3({0.09, 0, 0.19})));
  EXPECT_TRUE(builder.isNewKeyframe(2, 0, toRigid3({0.11, 0, 0})));
  EXPECT_TRUE(builder.add(2, 0, toRigid3({0.11, 0, 0}), features));
  EXPECT_TRUE(builder.add(3, 0, toRigid3({0.11, 0, -0.21}), features));
  EXPECT_TRUE(builder.add(4, 0, toRigid3({0.11, 0, std::numbers::pi - 0.01}), features));
  EXPECT_FALSE(builder.add(5, 0, toRigid3({0.11, 0, -std::numbers::pi + 0.01}), features));
  EXPECT_EQ(builder.keyframeCount(), 5);
}

TEST(MapBuilder, RefusesBadInput) {
  MapBuilderOptions options;
  options.features.kind = FeatureKind::orb;
  MapCamera broken = testing::forwardCamera();
  broken.calibration.pinhole.fx = 0;
  EXPECT_THROW(MapBuilder({broken}, options), std::invalid_argument);

  MapBuilder builder({testing::forwardCamera()}, options);
  EXPECT_THROW(builder.build(), std::runtime_error);  // no keyframes
  FeatureSet features;
  features.descriptors.resize(0, 32);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(builder.add(nan, 0, Rigid3::Identity(), features), std::invalid_argument);
  EXPECT_THROW(builder.add(0, 1, Rigid3::Identity(), features), std::invalid_argument);
  EXPECT_THROW(builder.add(0, -1, Rigid3::Identity(), features), std::invalid_argument);
  EXPECT_THROW(builder.add(0, 0, Rigid3(Eigen::Translation3d(0, nan, 0)), features), std::invalid_argument);
  const Image small{320, 240, std::vector<uint8_t>(320 * 240)};
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), small.view()), std::invalid_argument);
  features.kind = FeatureKind::sift;
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), features), std::invalid_argument);
  features.kind = FeatureKind::orb;
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), features, {1.0f}), std::invalid_argument);
  const Image fitting{640, 480, std::vector<uint8_t>(640 * 480)};
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), fitting.view(), {2, 2, {1, 1, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), fitting.view(), {640, 480, {1, 1}}), std::invalid_argument);
  features.pixels.emplace_back(1, 1);  // a pixel without the rest
  EXPECT_THROW(builder.add(0, 0, Rigid3::Identity(), features), std::invalid_argument);
  EXPECT_EQ(builder.keyframeCount(), 0);
}

TEST(MapBuilder, ImagesWithoutFeaturesAreNoMap) {
  MapBuilderOptions options;
  options.features.kind = FeatureKind::orb;
  MapBuilder builder({testing::forwardCamera()}, options);
  const Image blank{640, 480, std::vector<uint8_t>(640 * 480, 128)};
  EXPECT_TRUE(builder.add(0, 0, Rigid3::Identity(), blank.view()));
  EXPECT_THROW(builder.build(), std::runtime_error);
}

TEST(MapBuilder, SurvivesABlankImageAmongOthers) {
  Recording recording = testing::shortRecording();
  recording.drive.push_back({30, 0, 0});  // where nothing is to be seen
  const auto [map, report] = recording.build(recording.builderOptions(), 1);
  EXPECT_EQ(report.keyframes, std::ssize(recording.drive));
  EXPECT_EQ(map.keyframes.back().features.size(), 0);
  EXPECT_GT(report.landmarks, 10);
}

TEST(MapBuilder, ANetworkDescribesPlaces) {
  const ScratchDirectory scratch;
  MapBuilderOptions options;
  options.features.kind = FeatureKind::orb;
  options.place_network.file = TinyNetwork(1, 48, 64, 16).writtenTo(scratch.path() / "places.onnx");
  MapBuilder builder({testing::forwardCamera()}, options);
  Random random(3);
  Image image{640, 480, std::vector<uint8_t>(640 * 480)};
  std::vector<Image> images;
  for (int i = 0; i < 3; ++i) {
    for (uint8_t& pixel : image.pixels) pixel = static_cast<uint8_t>(random.below(256));
    images.push_back(image);
    EXPECT_TRUE(builder.add(i, 0, toRigid3({0.2 * i, 0, 0}), image.view()));
    EXPECT_FALSE(builder.add(i, 0, toRigid3({0.2 * i, 0, 0}), image.view())) << "no keyframe, no place";
  }
  FeatureSet features;
  features.descriptors.resize(0, 32);
  EXPECT_THROW(builder.add(9, 0, toRigid3({9, 0, 0}), features), std::invalid_argument) << "no image";
  const KeyframeMap map = builder.build().first;
  FeatureModel model = map.place_network;
  EXPECT_NE(model.crc32, 0u);
  EXPECT_TRUE(map.vocabulary.empty());
  ASSERT_EQ(map.place_descriptors.cols(), 3);
  const PlaceNetwork network(model);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(map.place_descriptors.col(i), network.describe(images[static_cast<std::size_t>(i)].view(), {}));
  options.place_network.file = (scratch.path() / "absent.onnx").string();
  EXPECT_THROW(MapBuilder({testing::forwardCamera()}, options), std::runtime_error);
}

TEST(MapBuilder, SessionsAreMergedByWhatTheySee) {
  const Recording recording = testing::shortRecording();
  MapBuilder builder({testing::forwardCamera()}, recording.builderOptions());
  Random random(2);
  for (int session = 0; session < 2; ++session) {
    builder.startSession();
    for (const PlanarPose& pose : recording.drive) {
      const ReferenceCamera view{testing::forwardCamera().calibration.pinhole,
                                 toRigid3(pose) * testing::forwardCamera().robot_from_camera};
      builder.add(session, 0, toRigid3(pose), see(recording.room, view, 0.5, 0, random).features);
    }
  }
  const auto [map, report] = builder.build();
  EXPECT_EQ(map.keyframes.front().session, 0);
  EXPECT_EQ(map.keyframes.back().session, 1);
  EXPECT_GT(report.mean_observations, static_cast<double>(recording.drive.size()));  // more than one session has
}

TEST(MapBuilderOptions, NameTheBadKey) {
  const std::pair<const char*, double MapBuilderOptions::*> keys[] = {
      {"keyframe_distance", &MapBuilderOptions::keyframe_distance},
      {"keyframe_rotation", &MapBuilderOptions::keyframe_rotation},
      {"sigma_px", &MapBuilderOptions::sigma_px},
      {"sigma_position", &MapBuilderOptions::sigma_position},
      {"sigma_heading", &MapBuilderOptions::sigma_heading},
      {"sigma_mount_tilt", &MapBuilderOptions::sigma_mount_tilt},
      {"sigma_mount_shift", &MapBuilderOptions::sigma_mount_shift},
      {"sigma_focal", &MapBuilderOptions::sigma_focal},
      {"sigma_radial", &MapBuilderOptions::sigma_radial}};
  for (const auto& [name, member] : keys) {
    for (double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
      MapBuilderOptions options;
      options.*member = bad;
      try {
        options.check();
        ADD_FAILURE() << name << " = " << bad << " accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace vmcl
