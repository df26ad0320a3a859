// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vegetation_sim::terrain {

/// Samples as they stand in the file: no colour management, no scaling.
struct GreyImage {
  int columns{0}, rows{0};
  std::uint16_t white{255};              ///< Largest possible sample; black is 0.
  std::vector<std::uint16_t> samples{};  ///< [rows x columns], top row first, left to right.
};

/// Longest side [pixels] and largest file [bytes] that are accepted.
constexpr int LONGEST_SIDE = 8192;
constexpr std::size_t LARGEST_IMAGE_FILE = 160u << 20;

/// Reads a grey PNG (1 to 16 bit) or PGM (P2 or P5, 8 or 16 bit) from its bytes.
/// @param name stands for the image in the error. @throws InvalidInput
GreyImage parseGreyImage(const std::string& bytes, const std::string& name);

/// @throws InvalidInput naming the file if it is missing, too large or no such image.
GreyImage loadGreyImage(const std::string& file);

}  // namespace vegetation_sim::terrain
