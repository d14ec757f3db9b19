// SPDX-License-Identifier: BSD-3-Clause
#include "grey_image.h"

#include <stdexcept>

namespace vmcl {

Image greyImage(const mrpt::img::CImage& image) {
  if (image.isExternallyStored()) return readImage(image.getExternalStorageFileAbsolutePath());
  if (image.isEmpty()) throw std::runtime_error("no image");
  if (image.getPixelDepth() != mrpt::img::PixelDepth::D8U) throw std::runtime_error("an image that is not 8 bit");
  const mrpt::img::CImage grey = image.grayscale();
  Image out{static_cast<int>(grey.getWidth()), static_cast<int>(grey.getHeight()), {}};
  out.pixels.reserve(grey.getWidth() * grey.getHeight());
  for (int row = 0; row < out.height; ++row) {
    const auto* pixels = grey.ptrLine<uint8_t>(row);
    out.pixels.insert(out.pixels.end(), pixels, pixels + out.width);
  }
  return out;
}

}  // namespace vmcl
