// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <png.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vegetation_sim::terrain {

/// PNG by libpng's own writer, which also names a gamma in it; `format` is one of its PNG_FORMATs.
template <class Sample>
std::string pngOf(const std::vector<Sample>& samples, int columns, png_uint_32 format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(samples.size() * sizeof(Sample) /
                                          PNG_IMAGE_PIXEL_SIZE(format) / image.width);
  image.format = format;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string out(size, '\0');
  png_image_write_to_memory(&image, out.data(), &size, 0, samples.data(), 0, nullptr);
  out.resize(size);
  return out;
}

inline std::string grey8(const std::vector<std::uint8_t>& samples, int columns) {
  return pngOf(samples, columns, PNG_FORMAT_GRAY);
}

inline std::string grey16(const std::vector<std::uint16_t>& samples, int columns) {
  return pngOf(samples, columns, PNG_FORMAT_LINEAR_Y);
}

}  // namespace vegetation_sim::terrain
