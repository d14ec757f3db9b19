// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "vmcl/geometry/camera.h"
#include "vmcl/vision/image.h"

namespace vmcl {

enum class FeatureKind : uint8_t { orb = 1, sift = 2 };

/// "orb" or "sift". Throws std::invalid_argument naming any other word.
FeatureKind featureKindFromName(std::string_view name);
std::string_view nameOf(FeatureKind kind);

/// Length of a descriptor: 32 for ORB, 128 for SIFT.
int descriptorBytes(FeatureKind kind);

/// One descriptor a row: 32 bytes of bits for ORB (Hamming distance), 128 bytes for SIFT (RootSIFT, Euclidean).
using Descriptors = Eigen::Matrix<uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Local features of one image.
struct FeatureSet {
  FeatureKind kind = FeatureKind::orb;
  std::vector<Eigen::Vector2f> pixels;  ///< ideal (undistorted) pixels
  std::vector<float> sizes;             ///< diameter of the detected structure, pixels
  std::vector<float> responses;         ///< detector strength, larger is stronger
  Descriptors descriptors;              ///< pixels.size() rows

  int size() const { return static_cast<int>(pixels.size()); }
};

struct FeatureOptions {
  static constexpr int most_features = 100'000;  ///< that an image may have

  FeatureKind kind = FeatureKind::sift;
  int max_features = 1000;     ///< strongest kept, at most most_features
  int mask_rows_from_top = 0;  ///< rows of the image that show the robot itself

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Finds and describes local features. Deterministic; one extractor serves one thread at a time.
class FeatureExtractor {
 public:
  explicit FeatureExtractor(const FeatureOptions& options);
  ~FeatureExtractor();
  FeatureExtractor(FeatureExtractor&&) noexcept;
  FeatureExtractor& operator=(FeatureExtractor&&) noexcept;

  const FeatureOptions& options() const;

  /// Features of an image taken with this camera, strongest first, none of which reaches into the white of `mask`: a
  /// grey image of the same size that is white (128 or more) where the robot itself is seen; empty: nowhere. Throws
  /// std::invalid_argument when a size differs from the calibration's or the masked rows leave nothing of the image. A
  /// blank image has none.
  FeatureSet extract(const ImageView& image, const CameraCalibration& calibration, const ImageView& mask = {}) const;

 private:
  struct Detector;
  std::unique_ptr<Detector> detector_;
};

}  // namespace vmcl
