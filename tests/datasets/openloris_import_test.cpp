// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/openloris_import.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "ros_bag.h"
#include "scratch_directory.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {
namespace {

constexpr int image_width = 32, image_height = 24;
constexpr double start = 1560000000;  // s, as in the data set

/// The camera looks along x of base_link, 0.9 m above it: rows of base_link_from_camera.
const std::vector<double> mount{0, 0, 1, 0.2, -1, 0, 0, 0, 0, -1, 0, 0.9, 0, 0, 0, 1};

/// What both forms of a sequence must give.
class OpenLorisTest : public testing::Test {
 protected:
  std::filesystem::path log() const { return scratch_.path() / "log.rawlog"; }

  struct Contents {
    int images = 0, depths = 0, scans = 0, odometry = 0;
    double last_time = 0;
  };

  Contents read() const {
    Contents contents;
    RawlogReader reader(log());
    RawlogEntry entry;
    while (reader.next(entry)) {
      const double time = mrpt::Clock::toDouble(entry.observation->timestamp);
      EXPECT_GE(time, contents.last_time);
      contents.last_time = time;
      if (const auto camera = cameraObservation(*entry.observation)) {
        ++contents.images;
        EXPECT_NEAR(camera->calibration.pinhole.fx, 30, 1e-6);
        EXPECT_NEAR(camera->calibration.pinhole.cy, 11, 1e-6);
        EXPECT_NEAR(camera->calibration.distortion[0], 0.01, 1e-9);
        EXPECT_NEAR((camera->robot_from_camera * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1.2, 0, 0.9)).norm(), 0,
                    1e-6);
      }
      if (const auto depth = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(entry.observation)) {
        ++contents.depths;
        EXPECT_TRUE(depth->rangeImage_isExternallyStored());
        EXPECT_NEAR(depth->maxRange, 1.5, 1e-6);
      }
      if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(entry.observation)) {
        ++contents.scans;
        EXPECT_NEAR(scan->sensorPose.x(), 0.3, 1e-9);
        EXPECT_NEAR(scan->aperture, 2, 1e-6);
        EXPECT_FALSE(scan->getScanRangeValidity(0));
        EXPECT_NEAR(scan->getScanRange(1), 2.5, 1e-6);
      }
      if (const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry.observation)) {
        EXPECT_NEAR(odometry->odometry.x(), 0.1 * contents.odometry, 1e-9);
        ++contents.odometry;
      }
    }
    return contents;
  }

  std::string failure(const std::filesystem::path& source) const {
    try {
      importOpenLoris(source, log());
    } catch (const std::runtime_error& error) {
      EXPECT_FALSE(std::filesystem::exists(log()));
      return error.what();
    }
    return "no failure";
  }

  ScratchDirectory scratch_;
};

class OpenLorisFolderTest : public OpenLorisTest {
 protected:
  OpenLorisFolderTest() {
    std::filesystem::create_directories(folder() / "color");
    std::filesystem::create_directories(folder() / "aligned_depth");
    write("sensors.yaml",
          "%YAML:1.0\n---\nd400_color_optical_frame:\n   sensor_type: camera\n   width: 32\n   height: 24\n"
          "   model: pinhole\n   intrinsics: !!opencv-matrix\n      rows: 1\n      cols: 4\n      dt: d\n"
          "      data: [ 30., 15., 31., 11. ]\n   distortion_model: radial-tangential\n"
          "   distortion_coefficients: !!opencv-matrix\n      rows: 1\n      cols: 5\n      dt: d\n"
          "      data: [ 0.01, 0., 0., 0., 0. ]\n");
    std::string data;
    for (const double value : mount) data += (data.empty() ? " " : ", ") + std::to_string(value);
    write("trans_matrix.yaml",
          "%YAML:1.0\n---\ntrans_matrix:\n   -\n      parent_frame: base_link\n      child_frame: "
          "d400_color_optical_frame\n      matrix: !!opencv-matrix\n         rows: 4\n         cols: 4\n"
          "         dt: d\n         data: [" +
              data + " ]\n");
    std::string colour = "#Time color\n", depth, odometry = "#Time px py pz ox oy oz ow vx vy vz wx wy wz\n", truth;
    for (int i = 0; i < 4; ++i) {
      const std::string time = std::to_string(start + 0.1 * i), name = time + ".png";
      colour += time + " color/" + name + "\n";
      depth += std::to_string(start + 0.1 * i + 0.004) + " aligned_depth/" + name + "\n";
      odometry += time + " " + std::to_string(0.1 * i) + " 0 0 0 0 0 1 0.5 0 0 0 0 0\n";
      truth += time + " 1 2 0 0 0 0 1\n";
      cv::imwrite(folder() / "color" / name, cv::Mat(image_height, image_width, CV_8UC3, cv::Scalar(10 * i, 80, 90)));
      cv::imwrite(folder() / "aligned_depth" / name, cv::Mat(image_height, image_width, CV_16U, cv::Scalar(1500)));
    }
    write("color.txt", colour);
    write("aligned_depth.txt", depth);
    write("odom.txt", odometry);
    write("groundtruth.txt", truth);
  }

  std::filesystem::path folder() const { return scratch_.path() / "home1-1"; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder() / name) << text; }
  void append(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::app) << text;
  }
};

TEST_F(OpenLorisFolderTest, becomesARawlog) {
  const ImportReport report = importOpenLoris(folder(), log());
  EXPECT_TRUE(report.problems.empty());
  const Contents contents = read();
  EXPECT_EQ(contents.images, 4);
  EXPECT_EQ(contents.depths, 4);
  EXPECT_EQ(contents.odometry, 4);
  EXPECT_EQ(readTumTrajectory(scratch_.path() / "log.groundtruth.tum").poses().size(), 4u);
}

TEST_F(OpenLorisFolderTest, leavesOutWhatIsWrongAndNamesIt) {
  append("color.txt", "color/no_stamp.png\n" + std::to_string(start) + " color/" + std::to_string(start) + ".png\n" +
                          std::to_string(start + 1) + " color/missing.png\n");
  append("odom.txt", std::to_string(start + 1.5) + " 1 nan 0 0 0 0 1\n");
  const ImportReport report = importOpenLoris(folder(), log());
  EXPECT_EQ(read().images, 4);
  ASSERT_EQ(report.problems.size(), 4u);
  EXPECT_NE(report.problems[0].find("color.txt:6: no time stamp"), std::string::npos) << report.problems[0];
  EXPECT_NE(report.problems[1].find("color.txt:7: the clock runs backwards"), std::string::npos) << report.problems[1];
  EXPECT_NE(report.problems[2].find("missing.png"), std::string::npos) << report.problems[2];
  EXPECT_NE(report.problems[3].find("odom.txt:6: is not a pose"), std::string::npos) << report.problems[3];
}

TEST_F(OpenLorisFolderTest, namesTheCalibrationThatIsMissing) {
  write("trans_matrix.yaml", "%YAML:1.0\n---\ntrans_matrix:\n");
  EXPECT_NE(failure(folder()).find("no transform between base_link and d400_color_optical_frame"), std::string::npos);
  write("sensors.yaml", "garbage");
  EXPECT_NE(failure(folder()).find("sensors.yaml: "), std::string::npos);
  std::filesystem::remove(folder() / "sensors.yaml");
  EXPECT_NE(failure(folder()).find("sensors.yaml: cannot be opened"), std::string::npos);
}

class OpenLorisBagTest : public OpenLorisTest {
 protected:
  OpenLorisBagTest() {
    rosbag::Bag bag(bagFile().string(), rosbag::bagmode::Write);
    RosMessage frames{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", {}};
    frames.put(uint32_t{2});
    frames.header(start, "base_link").text("d400_color").numbers({0.2, 0, 0.9, -0.5, 0.5, -0.5, 0.5});
    frames.header(start, "/base_link").text("laser").numbers({0.3, 0, 0.2, 0, 0, 0, 1});
    bag.write("/tf_static", ros::Time(start), frames);
    RosMessage camera{"sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214", {}};
    camera.header(start, "d400_color").put(uint32_t{image_height}).put(uint32_t{image_width}).text("plumb_bob");
    camera.array(std::vector<double>{0.01, 0, 0, 0, 0}).numbers({30, 0, 15, 0, 31, 11, 0, 0, 1});
    camera.numbers(std::vector<double>(9 + 12)).put(uint32_t{0}).put(uint32_t{0});
    for (int i = 0; i < 4; ++i) camera.put(uint32_t{0});
    camera.put(uint8_t{0});
    bag.write("/d400/color/camera_info", ros::Time(start), camera);
    for (int i = 0; i < 4; ++i) add(bag, start + 0.1 * i, i, start + 0.1 * i);
    bag.close();
  }

  static RosMessage image(double time, const std::string& encoding, const std::vector<uint8_t>& data) {
    RosMessage message{"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743", {}};
    message.header(time, "d400_color")
        .put(uint32_t{image_height})
        .put(uint32_t{image_width})
        .text(encoding)
        .put(uint8_t{0});
    return message.put(static_cast<uint32_t>(data.size() / image_height)).array(data);
  }

  static void add(rosbag::Bag& bag, double time, int number, double recorded) {
    const ros::Time stamp(recorded);
    bag.write("/d400/color/image_raw", stamp,
              image(time, "rgb8", std::vector<uint8_t>(image_width * image_height * 3, 90)));
    std::vector<uint8_t> depth;
    for (int i = 0; i < image_width * image_height; ++i) depth.insert(depth.end(), {1500 % 256, 1500 / 256});
    bag.write("/d400/aligned_depth_to_color/image_raw", stamp, image(time + 0.003, "16UC1", depth));
    RosMessage odometry{"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7", {}};
    odometry.header(time, "odom").text("base_link").numbers({0.1 * number, 0, 0, 0, 0, 0, 1});
    odometry.numbers(std::vector<double>(36 + 6 + 36));
    bag.write("/odom", stamp, odometry);
    RosMessage scan{"sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369", {}};
    scan.header(time, "laser");
    for (const float value : {-1.0f, 1.0f, 1.0f, 0.0f, 0.1f, 0.1f, 10.0f}) scan.put(value);
    scan.array(std::vector<float>{std::numeric_limits<float>::infinity(), 2.5f, 3}).array(std::vector<float>{});
    bag.write("/scan", stamp, scan);
    RosMessage truth{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", {}};
    truth.put(uint32_t{1}).header(time, "world").text("base_link").numbers({1, 2, 0, 0, 0, 0, 1});
    bag.write("/gt", stamp, truth);
  }

  std::filesystem::path bagFile() const { return scratch_.path() / "corridor1-1.bag"; }
};

TEST_F(OpenLorisBagTest, becomesARawlog) {
  const ImportReport report = importOpenLoris(bagFile(), log());
  EXPECT_TRUE(report.problems.empty()) << report.problems.front();
  const Contents contents = read();
  EXPECT_EQ(contents.images, 4);
  EXPECT_EQ(contents.depths, 4);
  EXPECT_EQ(contents.scans, 4);
  EXPECT_EQ(contents.odometry, 4);
  EXPECT_EQ(report.ground_truth_poses, 4);
}

TEST_F(OpenLorisBagTest, saysWhereItsClockRunsBackwards) {
  rosbag::Bag bag(bagFile().string(), rosbag::bagmode::Append);
  add(bag, start + 0.15, 9, start + 0.5);
  bag.close();
  const ImportReport report = importOpenLoris(bagFile(), log());
  EXPECT_EQ(read().images, 4);
  ASSERT_EQ(report.problems.size(), 5u);
  for (const std::string& problem : report.problems)
    EXPECT_NE(problem.find("the clock runs backwards"), std::string::npos) << problem;
}

TEST_F(OpenLorisBagTest, refusesABagThatIsCutOffOrNone) {
  std::filesystem::resize_file(bagFile(), std::filesystem::file_size(bagFile()) / 2);
  EXPECT_NE(failure(bagFile()).find("corridor1-1.bag: "), std::string::npos) << failure(bagFile());
  EXPECT_EQ(failure(bagFile()).find('\n'), std::string::npos);
  std::ofstream(bagFile()) << "#ROSBAG V2.0\ngarbage";
  EXPECT_NE(failure(bagFile()).find("corridor1-1.bag: "), std::string::npos) << failure(bagFile());
  std::filesystem::remove(bagFile());
  EXPECT_NE(failure(bagFile()).find("corridor1-1.bag: "), std::string::npos) << failure(bagFile());
}

}  // namespace
}  // namespace vmcl
