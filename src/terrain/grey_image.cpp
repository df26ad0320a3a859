// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/terrain/grey_image.h"

#include "core/config/files.h"
#include "terrain/image_formats.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::terrain {

GreyImage parseGreyImage(const std::string& bytes, const std::string& name) {
  if (looksLikePng(bytes)) return parsePng(bytes, name);
  if (looksLikePgm(bytes)) return parsePgm(bytes, name);
  throw InvalidInput(name + ": neither a PNG nor a PGM (P2 or P5) image");
}

GreyImage loadGreyImage(const std::string& file) {
  return parseGreyImage(readFile(file, LARGEST_IMAGE_FILE), file);
}

}  // namespace vegetation_sim::terrain
