// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/terrain/grey_image.h"

#include <filesystem>
#include <fstream>

#include "terrain/image_formats.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::terrain {

GreyImage parseGreyImage(const std::string& bytes, const std::string& name) {
  if (looksLikePng(bytes)) return parsePng(bytes, name);
  if (looksLikePgm(bytes)) return parsePgm(bytes, name);
  throw InvalidInput(name + ": neither a PNG nor a PGM (P2 or P5) image");
}

GreyImage loadGreyImage(const std::string& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InvalidInput(file + ": cannot be read: " + error.message());
  if (size > LARGEST_IMAGE_FILE)
    throw InvalidInput(file + ": " + std::to_string(size) + " bytes, more than the " +
                       std::to_string(LARGEST_IMAGE_FILE) + " allowed");
  std::ifstream in(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) throw InvalidInput(file + ": cannot be read");
  return parseGreyImage(bytes, file);
}

}  // namespace vegetation_sim::terrain
