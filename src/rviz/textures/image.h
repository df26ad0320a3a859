// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {

/// Red, green, blue, alpha in 0 to 1.
using Rgba = std::array<float, 4>;

inline Rgba mix(const Rgba& a, const Rgba& b, float weight_of_b) {
  Rgba out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = a[i] + (b[i] - a[i]) * weight_of_b;
  return out;
}

/// Image of floats, top row first.
struct Image {
  Image() = default;
  Image(int columns_wanted, int rows_wanted, const Rgba& fill);

  int columns{0}, rows{0};
  std::vector<Rgba> pixels;  ///< [rows x columns]

  Rgba& at(int column, int row) { return pixels[place(column, row)]; }
  const Rgba& at(int column, int row) const { return pixels[place(column, row)]; }
  /// Blends `colour` over the pixel by its alpha.
  void blend(int column, int row, const Rgba& colour);
  /// Returns bytes [rows x columns x 4] for a texture.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Returns the image at half the size; each pixel is the mean of four.
Image halved(const Image& picture);
/// Returns the image and its mipmaps down to `smallest` pixels.
std::vector<Image> mipmaps(Image picture, int smallest = 1);
/// Copies `part` into `whole` with its top left corner at (column, row).
void paste(const Image& part, int column, int row, Image& whole);

/// Smooth noise over a plane, in [0, 1] with a mean of about 0.5; it repeats after PERIOD units.
class Noise {
 public:
  static constexpr int PERIOD = 64;
  explicit Noise(std::uint64_t seed);

  /// Returns one octave, with features of one unit.
  float smooth(float x, float y) const;
  /// Sums `octaves`, each twice as fine and half as strong as the one before.
  float fractal(float x, float y, int octaves) const;

 private:
  std::vector<float> lattice_;  // [PERIOD x PERIOD]
};

}  // namespace vegetation_sim::view
