// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vmcl/geometry/camera.h"
#include "vmcl/vision/image_mask.h"

namespace vmcl {

enum class FeatureKind : uint8_t { orb = 1, sift = 2, akaze = 3, network = 4 };

/// "orb", "sift", "akaze" or "network".
std::string_view nameOf(FeatureKind kind);

/// Whether descriptors are bits, compared by Hamming distance (ORB, AKAZE), or else entries of a vector, compared by
/// Euclidean distance.
bool isBinary(FeatureKind kind);

inline constexpr int max_descriptor_bytes = 256;

/// Whether descriptors of this kind may have this length: 32 for ORB, 128 for SIFT, 64 for AKAZE, any up to
/// max_descriptor_bytes for a network.
bool isDescriptorLength(FeatureKind kind, Eigen::Index bytes);

/// One descriptor a row: bits of ORB or AKAZE (61 bytes and 3 of zeros), RootSIFT in steps of 1/512, or a network's
/// unit vector in steps of 1/256 above -1/2.
using Descriptors = Eigen::Matrix<uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Local features of one image, the strongest first where FeatureExtractor found them.
struct FeatureSet {
  FeatureKind kind = FeatureKind::orb;
  std::vector<Eigen::Vector2f> pixels;  ///< ideal (undistorted) pixels
  std::vector<float> sizes;             ///< diameter of the detected structure, pixels
  std::vector<float> responses;         ///< detector strength, larger is stronger
  Descriptors descriptors;              ///< pixels.size() rows

  int size() const { return static_cast<int>(pixels.size()); }
};

/// A network that finds and describes features, or describes whole images: an ONNX file as doc/features.md has it.
struct FeatureModel {
  std::string file;
  uint32_t crc32 = 0;  ///< of the file; 0: not known yet

  bool operator==(const FeatureModel&) const = default;
};

struct FeatureOptions {
  static constexpr int most_features = 100'000;  ///< that an image may have

  FeatureKind kind = FeatureKind::sift;
  int max_features = 1000;     ///< strongest kept, at most most_features
  int mask_rows_from_top = 0;  ///< rows of the image that show the robot itself
  FeatureModel model{};        ///< of kind network alone

  /// Sets kind and model by "orb", "sift", "akaze" or the path of a .onnx file. Throws std::invalid_argument naming
  /// any other word.
  void choose(std::string_view kind_or_model);

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Finds and describes local features. Deterministic and thread safe; a network looks at one image at a time.
class FeatureExtractor {
 public:
  /// Throws std::invalid_argument for bad options, std::runtime_error naming the model's file when it cannot be read,
  /// is no network of features, or is not the one of the options' checksum.
  explicit FeatureExtractor(const FeatureOptions& options);
  ~FeatureExtractor();
  FeatureExtractor(FeatureExtractor&&) noexcept;
  FeatureExtractor& operator=(FeatureExtractor&&) noexcept;

  /// With the checksum of the model.
  const FeatureOptions& options() const;

  /// Features of an image taken with this camera, strongest first, none of which reaches into what the mask hides.
  /// Throws std::invalid_argument when a size differs from the calibration's or the mask does not fit. A blank image
  /// has none.
  FeatureSet extract(const ImageView& image, const CameraCalibration& calibration, const ImageMask& mask) const;

  /// The same with the masked rows of the options.
  FeatureSet extract(const ImageView& image, const CameraCalibration& calibration) const;

 private:
  FeatureOptions options_;
  std::unique_ptr<class FeatureDetector> detector_;
};

}  // namespace vmcl
