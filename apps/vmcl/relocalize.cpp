// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <algorithm>
#include <deque>
#include <future>
#include <iomanip>
#include <iostream>
#include <limits>

#include "progress_bar.h"
#include "verbs.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/geometry/atomic_file.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {
namespace {

struct Arguments {
  std::string map, rawlog, groundtruth, out;
  int retrieved = RelocalizerOptions().retrieved;
  uint64_t seed = EstimatorOptions().seed;
  int threads = 1;
};

/// Difference to the ground truth: metres on the ground and degrees, both positive.
struct PoseError {
  double position = 0;
  double heading_deg = 0;
};

/// What became of one image.
struct ImageResult {
  double time = 0;
  std::string label;
  std::size_t matches = 0;
  PoseEstimate estimate;
  RelocalizationTimes times;
  bool has_truth = false;
  std::optional<PoseError> error;  ///< where found and known
  std::string failure;             ///< why it could not be used
};

/// The camera images of a log, one after the other.
class CameraStream {
 public:
  explicit CameraStream(const std::filesystem::path& rawlog) : rawlog_(rawlog), reader_(rawlog) {}

  /// Nothing at the end. What cannot be used is named on stderr and passed over.
  std::optional<CameraObservation> next() {
    while (true) {
      while (!waiting_.empty()) {
        const auto observation = waiting_.front();
        waiting_.pop_front();
        try {
          if (auto camera = cameraObservation(*observation)) return camera;
        } catch (const std::runtime_error& error) {
          complain(error.what());
        }
      }
      if (!readEntry()) return std::nullopt;
    }
  }

  void complain(const std::string& what) {
    std::cerr << "vmcl relocalize: " << rawlog_.string() << ": " << what << '\n';
    ++bad_inputs_;
  }

  int badInputs() const { return bad_inputs_; }
  double progress() const { return reader_.progress(); }

 private:
  bool readEntry() try {
    RawlogEntry entry;
    if (!reader_.next(entry)) return false;
    if (entry.frame) waiting_.assign(entry.frame->begin(), entry.frame->end());
    if (entry.observation) waiting_.push_back(entry.observation);
    return true;
  } catch (const std::runtime_error& error) {  // a log that is cut off is good up to there
    std::cerr << "vmcl relocalize: " << error.what() << '\n';
    ++bad_inputs_;
    return false;
  }

  std::filesystem::path rawlog_;
  RawlogReader reader_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
  int bad_inputs_ = 0;
};

/// A camera with the label of a map camera is that camera, mounted and calibrated as the map has it.
QueryImage queryImage(const CameraObservation& observation, const KeyframeMap& map) {
  for (const MapCamera& camera : map.cameras)
    if (camera.label == observation.label)
      return {observation.image.view(), camera.calibration, camera.robot_from_camera, camera.mask_rows_from_top};
  return {observation.image.view(), observation.calibration, observation.robot_from_camera, 0};
}

ImageResult relocalizeImage(const Relocalizer& relocalizer, const CameraObservation& observation,
                            const Trajectory& groundtruth) {
  ImageResult image{.time = observation.time, .label = observation.label};
  try {
    const QueryImage query = queryImage(observation, relocalizer.map());
    RelocalizationResult result = relocalizer.relocalize({&query, 1});
    image.matches = result.problem.matches.size();
    image.times = result.times;
    image.estimate = std::move(result.estimate);
  } catch (const std::exception& error) {
    image.failure = error.what();
    return image;
  }
  const std::optional<Rigid3> truth = groundtruth.at(observation.time);
  image.has_truth = truth.has_value();
  if (truth && image.estimate.found()) {
    const PlanarPose error = inverse(planarPart(*truth)) * image.estimate.modes.front().robot_in_map;
    image.error = {std::hypot(error.x, error.y), std::abs(error.phi) * 180 / std::numbers::pi};
  }
  return image;
}

/// Relocalizes all images, `threads` at a time, in the order of the log.
std::vector<ImageResult> relocalizeAll(CameraStream& stream, const Relocalizer& relocalizer,
                                       const Trajectory& groundtruth, int threads) {
  ProgressBar bar;
  std::vector<ImageResult> results;
  std::deque<std::future<ImageResult>> running;
  const auto finishOldest = [&] {
    ImageResult image = running.front().get();
    running.pop_front();
    if (image.failure.empty())
      results.push_back(std::move(image));
    else
      stream.complain("camera '" + image.label + "': " + image.failure);
    bar.update("relocalizing", stream.progress());
  };
  while (auto observation = stream.next()) {
    if (running.size() == static_cast<std::size_t>(threads)) finishOldest();
    running.push_back(std::async(std::launch::async, [&, camera = std::move(*observation)] {
      return relocalizeImage(relocalizer, camera, groundtruth);
    }));
  }
  while (!running.empty()) finishOldest();
  return results;
}

/// Value below which the share of the sample lies; 0 for an empty sample.
double quantile(std::vector<double> sample, double share) {
  if (sample.empty()) return 0;
  const auto rank = sample.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1) + 0.5);
  std::nth_element(sample.begin(), rank, sample.end());
  return *rank;
}

void printAccuracy(const std::vector<ImageResult>& results) {
  std::vector<double> positions, headings;
  for (const ImageResult& image : results)
    if (image.error) {
      positions.push_back(image.error->position);
      headings.push_back(image.error->heading_deg);
    }
  const auto with_truth =
      std::count_if(results.begin(), results.end(), [](const auto& image) { return image.has_truth; });
  std::cout << "with ground truth  " << with_truth << '\n';
  if (with_truth == 0) return;
  for (const auto& [metres, degrees] : {std::pair(0.25, 5.0), {0.5, 5.0}, {1.0, 5.0}}) {
    const auto within = std::count_if(results.begin(), results.end(), [&](const ImageResult& image) {
      return image.error && image.error->position <= metres && image.error->heading_deg <= degrees;
    });
    std::cout << "within " << std::setprecision(2) << metres << " m, " << std::setprecision(0) << degrees << " deg "
              << std::setprecision(1) << 100.0 * static_cast<double>(within) / static_cast<double>(with_truth)
              << " %\n";
  }
  std::cout << std::setprecision(3) << "median error       " << quantile(positions, 0.5) << " m, "
            << quantile(headings, 0.5) << " deg\n";
}

void printLatency(const std::vector<ImageResult>& results) {
  std::cout << "\nlatency (ms)       median       p95\n";
  const auto line = [&](const char* name, auto secondsOf) {
    std::vector<double> sample;
    for (const ImageResult& image : results) sample.push_back(1e3 * secondsOf(image.times));
    std::cout << std::left << std::setw(15) << name << std::right << std::setprecision(1) << std::setw(10)
              << quantile(sample, 0.5) << std::setw(10) << quantile(sample, 0.95) << '\n';
  };
  using Times = RelocalizationTimes;
  line("features", [](const Times& t) { return t.features; });
  line("retrieval", [](const Times& t) { return t.retrieval; });
  line("matching", [](const Times& t) { return t.matching; });
  line("estimation", [](const Times& t) { return t.estimation; });
  line("all", [](const Times& t) { return t.features + t.retrieval + t.matching + t.estimation; });
}

void printTable(const std::vector<ImageResult>& results, bool has_groundtruth) {
  const auto found = std::count_if(results.begin(), results.end(), [](const auto& r) { return r.estimate.found(); });
  std::cout << std::fixed << "images             " << results.size() << "\nfound              " << found << '\n';
  if (has_groundtruth) printAccuracy(results);
  printLatency(results);
}

void writeResults(const std::filesystem::path& directory, const std::vector<ImageResult>& results) {
  AtomicFile file(directory / "relocalize.csv");
  std::ostream& out = file.stream();
  out << "time,camera,status,x,y,phi,cov_xx,cov_xy,cov_xphi,cov_yy,cov_yphi,cov_phiphi,modes,inliers,matches,"
         "position_error,heading_error_deg\n"
      << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const ImageResult& image : results) {
    out << image.time << ',' << image.label << ',' << (image.estimate.found() ? "found" : "no_pose");
    if (image.estimate.found()) {
      const PoseMode& mode = image.estimate.modes.front();
      const PlanarPose& pose = mode.robot_in_map;
      const Eigen::Matrix3d& cov = mode.covariance;
      out << ',' << pose.x << ',' << pose.y << ',' << pose.phi << ',' << cov(0, 0) << ',' << cov(0, 1) << ','
          << cov(0, 2) << ',' << cov(1, 1) << ',' << cov(1, 2) << ',' << cov(2, 2) << ',' << image.estimate.modes.size()
          << ',' << mode.inliers << ',' << image.matches << ',';
    } else {
      out << ",,,,,,,,,,0,0," << image.matches << ',';
    }
    if (image.error)
      out << image.error->position << ',' << image.error->heading_deg << '\n';
    else
      out << ",\n";
  }
  file.commit();
}

void writeTiming(const std::filesystem::path& directory, const std::vector<ImageResult>& results) {
  AtomicFile file(directory / "timing.csv");
  file.stream() << "time,camera,features,retrieval,matching,estimation\n" << std::setprecision(17);
  for (const ImageResult& image : results)
    file.stream() << image.time << ',' << image.label << ',' << image.times.features << ',' << image.times.retrieval
                  << ',' << image.times.matching << ',' << image.times.estimation << '\n';
  file.commit();
}

ExitCode run(const Arguments& arguments) {
  RelocalizerOptions options;
  options.retrieved = arguments.retrieved;
  options.estimator.seed = arguments.seed;
  const Relocalizer relocalizer(std::make_shared<const KeyframeMap>(loadMap(arguments.map)), options);
  Trajectory groundtruth;
  if (!arguments.groundtruth.empty()) groundtruth = readTumTrajectory(arguments.groundtruth);
  CameraStream stream(arguments.rawlog);
  const std::vector<ImageResult> results = relocalizeAll(stream, relocalizer, groundtruth, arguments.threads);
  if (results.empty()) throw std::runtime_error(arguments.rawlog + ": no camera image that can be used");
  if (!arguments.out.empty()) {
    std::filesystem::create_directories(arguments.out);
    writeResults(arguments.out, results);
    writeTiming(arguments.out, results);
  }
  printTable(results, !arguments.groundtruth.empty());
  return stream.badInputs() > 0 ? exit_some_input_bad : exit_done;
}

}  // namespace

void addRelocalizeVerb(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("relocalize", "Find the robot from each camera image of a log by itself");
  verb->add_option("--map", arguments->map, "Map to find the robot in (.vmap)")->required();
  verb->add_option("--rawlog", arguments->rawlog, "Log with the camera images")->required();
  verb->add_option("--groundtruth", arguments->groundtruth, "True poses (TUM format) to compare with");
  verb->add_option("--out", arguments->out, "Directory for relocalize.csv and timing.csv");
  verb->add_option("--retrieved", arguments->retrieved, "Keyframes that each image is matched with")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  verb->add_option("--seed", arguments->seed, "Same seed, same answers")->capture_default_str();
  verb->add_option("--threads", arguments->threads, "Images worked on at a time; more than 1 lengthens the latencies")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  verb->footer(
      "A camera labelled as a camera of the map is taken to be mounted and calibrated as the map has it.\n"
      "relocalize.csv holds poses in m and rad; the same seed gives the same bytes. timing.csv (s) does not.\n\n"
      "Example:\n  vmcl relocalize --map lab.vmap --rawlog query.rawlog --groundtruth groundtruth.txt --out results");
  verb->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace vmcl
