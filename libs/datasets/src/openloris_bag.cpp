// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "frame_tree.h"
#include "openloris.h"
#include "recording.h"
#include "ros_message.h"
#include "vmcl/geometry/camera.h"

namespace vmcl {
namespace {

constexpr char colour_topic[] = "/d400/color/image_raw", camera_topic[] = "/d400/color/camera_info",
               depth_topic[] = "/d400/aligned_depth_to_color/image_raw", odometry_topic[] = "/odom",
               scan_topic[] = "/scan", truth_topic[] = "/gt", transform_topic[] = "/tf_static";
constexpr int bag_jpeg_quality = 95;
constexpr uint32_t max_side_px = 1 << 14;
constexpr std::size_t max_problems = 20;

std::vector<uint8_t> bytesOf(const rosbag::MessageInstance& message) {
  std::vector<uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
  message.write(stream);
  return bytes;
}

/// The pixels of a message, still in its memory.
cv::Mat pixelsOf(RosImage& image, int type) {
  const std::size_t bytes_per_pixel = CV_ELEM_SIZE(type);
  if (image.width == 0 || image.height == 0 || std::max(image.width, image.height) > max_side_px ||
      image.step < image.width * bytes_per_pixel)
    throw std::runtime_error("an image of impossible size");
  return {static_cast<int>(image.height), static_cast<int>(image.width), type, image.data.data(), image.step};
}

std::string encodedColour(RosImage& image) {
  cv::Mat bgr;
  if (image.encoding == "rgb8")
    cv::cvtColor(pixelsOf(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  else if (image.encoding == "bgr8")
    bgr = pixelsOf(image, CV_8UC3);
  else if (image.encoding == "mono8")
    bgr = pixelsOf(image, CV_8UC1);
  else
    throw std::runtime_error("an image encoded as " + image.encoding.substr(0, 20));
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, bag_jpeg_quality});
  return {bytes.begin(), bytes.end()};
}

mrpt::img::TCamera cameraOf(const RosCameraInfo& info) {
  const auto& k = info.matrix;
  CameraCalibration calibration{{static_cast<int>(info.width), static_cast<int>(info.height), k[0], k[4], k[2], k[5]},
                                {}};
  std::copy_n(info.distortion.begin(), std::min<std::size_t>(5, info.distortion.size()),
              calibration.distortion.begin());
  if (calibration.isDistorted() && info.distortion_model != "plumb_bob")
    throw std::runtime_error("a lens model other than plumb_bob");
  calibration.check();
  mrpt::img::TCamera camera;
  camera.ncols = info.width;
  camera.nrows = info.height;
  camera.setIntrinsicParamsFromValues(k[0], k[4], k[2], k[5]);
  const auto& d = calibration.distortion;
  if (calibration.isDistorted()) camera.setDistortionPlumbBob(d[0], d[1], d[2], d[3], d[4]);
  return camera;
}

mrpt::poses::CPose3D toPose(const Rigid3& rigid) {
  mrpt::math::CMatrixDouble44 matrix;
  matrix.asEigen() = rigid.matrix();
  return mrpt::poses::CPose3D(matrix);
}

mrpt::obs::CObservation2DRangeScan observationOf(const RosScan& scan, const Rigid3& robot_from_laser) {
  const auto last = static_cast<double>(scan.ranges.size() - 1);
  const double middle = scan.angle_min + last * scan.angle_increment / 2;  // MRPT's fans are about the x axis
  mrpt::obs::CObservation2DRangeScan observation;
  observation.sensorLabel = "laser";
  observation.sensorPose = toPose(robot_from_laser) + mrpt::poses::CPose3D(0, 0, 0, middle, 0, 0);
  observation.aperture = static_cast<float>(last * std::abs(scan.angle_increment));
  observation.rightToLeft = scan.angle_increment > 0;
  observation.maxRange = scan.range_max;
  observation.resizeScan(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = scan.ranges[i];
    const bool is_valid = range >= scan.range_min && range <= scan.range_max;  // false for what is not finite
    observation.setScanRange(i, is_valid ? range : scan.range_max);
    observation.setScanRangeValidity(i, is_valid);
  }
  return observation;
}

/// Calibration first: camera and frames may come after the first images.
struct Preamble {
  std::optional<RosCameraInfo> camera;
  std::string camera_frame;
  FrameTree frames;
};

class BagImport {
 public:
  BagImport(const std::filesystem::path& file, rosbag::Bag& bag) : file_(file.string()), bag_(bag) {}

  ImportReport read(const std::filesystem::path& log, const std::function<void(double share)>& progress) {
    readPreamble();
    mrpt::obs::CObservationImage camera;
    camera.sensorLabel = "camera";
    camera.cameraParams = cameraOf(*preamble_.camera);
    camera.cameraPose = toPose(preamble_.frames.between(openloris_robot_frame, preamble_.camera_frame));
    recording_.emplace(log, camera);
    rosbag::View view(bag_, rosbag::TopicQuery(std::vector<std::string>{colour_topic, depth_topic, odometry_topic,
                                                                        scan_topic, truth_topic}));
    std::size_t done = 0, problems = 0;
    for (const rosbag::MessageInstance& message : view) {
      try {
        take(message);
      } catch (const std::exception& error) {
        if (++problems <= max_problems) recording_->addProblem(place(message) + ": " + firstLine(error.what()));
      }
      if (progress) progress(static_cast<double>(++done) / view.size());
    }
    return recording_->finish(file_);
  }

  static std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

 private:
  std::string place(const rosbag::MessageInstance& message) const {
    return file_ + ": " + message.getTopic() + " at " + std::to_string(message.getTime().toSec()) + " s";
  }

  void readPreamble() {
    for (const char* topic : {camera_topic, transform_topic, colour_topic}) {
      rosbag::View view(bag_, rosbag::TopicQuery(std::string(topic)));
      for (const rosbag::MessageInstance& message : view) {
        const auto bytes = bytesOf(message);
        if (topic == transform_topic) {
          for (const RosTransform& transform : readRosTransforms(bytes))
            preamble_.frames.add(transform.header.frame, transform.child, transform.parent_from_child);
          continue;
        }
        if (topic == camera_topic)
          preamble_.camera = readRosCameraInfo(bytes);
        else
          preamble_.camera_frame = readRosImage(bytes).header.frame;
        break;  // the first says it for all
      }
    }
    if (!preamble_.camera) throw std::runtime_error(std::string(camera_topic) + " is missing");
    if (preamble_.camera_frame.empty()) throw std::runtime_error(std::string(colour_topic) + " is missing");
  }

  void take(const rosbag::MessageInstance& message) {
    const auto bytes = bytesOf(message);
    const std::string& topic = message.getTopic();
    if (topic == colour_topic || topic == depth_topic) {
      RosImage image = readRosImage(bytes);
      if (image.width != preamble_.camera->width || image.height != preamble_.camera->height)
        throw std::runtime_error("its size differs from " + std::string(camera_topic));
      if (topic == colour_topic) {
        recording_->addImage(image.header.time, encodedColour(image), ".jpg", place(message));
      } else {
        if (image.encoding != "16UC1" && image.encoding != "mono16")
          throw std::runtime_error("a depth image encoded as " + image.encoding.substr(0, 20));
        recording_->addDepth(image.header.time, pixelsOf(image, CV_16UC1).clone(), place(message));
      }
    } else if (topic == odometry_topic) {
      const RosOdometry odometry = readRosOdometry(bytes);
      recording_->addOdometry(odometry.header.time, odometry.odom_from_robot, place(message));
    } else if (topic == scan_topic) {
      const RosScan scan = readRosScan(bytes);
      const Rigid3 robot_from_laser = preamble_.frames.between(openloris_robot_frame, scan.header.frame);
      recording_->addScan(scan.header.time, observationOf(scan, robot_from_laser), place(message));
    } else {
      for (const RosTransform& truth : readRosTransforms(bytes))
        if (truth.child == openloris_robot_frame)
          recording_->addTruth(truth.header.time, truth.parent_from_child, place(message));
    }
  }

  std::string file_;
  rosbag::Bag& bag_;
  Preamble preamble_;
  std::optional<DriveRecording> recording_;
};

}  // namespace

ImportReport importOpenLorisBag(const std::filesystem::path& file, const std::filesystem::path& log,
                                const std::function<void(double share)>& progress) try {
  rosbag::Bag bag;
  bag.open(file.string(), rosbag::bagmode::Read);
  return BagImport(file, bag).read(log, progress);
} catch (const rosbag::BagUnindexedException&) {
  throw std::runtime_error(file.string() + ": is cut off: its index is missing (`rosbag reindex` finds what is left)");
} catch (const ros::Exception& error) {
  throw std::runtime_error(file.string() + ": " + BagImport::firstLine(error.what()));
} catch (const std::exception& error) {
  const std::string reason = BagImport::firstLine(error.what());
  throw std::runtime_error(reason.starts_with(file.string()) || reason.starts_with(log.parent_path().string() + "/")
                               ? reason
                               : file.string() + ": " + reason);
}

}  // namespace vmcl
