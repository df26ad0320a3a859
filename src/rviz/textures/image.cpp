// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/image.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

int wrap(int i) {
  return i & (Noise::PERIOD - 1);
}

float fade(float x) {
  return x * x * (3.f - 2.f * x);
}

float octave(const std::vector<float>& lattice, float x, float y) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int x0 = wrap(static_cast<int>(fx)), y0 = wrap(static_cast<int>(fy));
  const int x1 = wrap(x0 + 1), y1 = wrap(y0 + 1);
  const float u = fade(x - fx), v = fade(y - fy);
  const auto get = [&](int i, int j) {
    return lattice[static_cast<std::size_t>(j * Noise::PERIOD + i)];
  };
  const float a = get(x0, y0) + (get(x1, y0) - get(x0, y0)) * u;
  const float b = get(x0, y1) + (get(x1, y1) - get(x0, y1)) * u;
  return a + (b - a) * v;
}

}  // namespace

Image::Image(int columns_wanted, int rows_wanted, const Rgba& fill)
    : columns(columns_wanted),
      rows(rows_wanted),
      pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

void Image::blend(int column, int row, const Rgba& colour) {
  if (column < 0 || row < 0 || column >= columns || row >= rows || colour[3] <= 0.f) return;
  Rgba& pixel = at(column, row);
  const float alpha = colour[3] + pixel[3] * (1.f - colour[3]);
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = (colour[i] * colour[3] + pixel[i] * pixel[3] * (1.f - colour[3])) / alpha;
  pixel[3] = alpha;
}

std::vector<std::uint8_t> Image::bytes() const {
  std::vector<std::uint8_t> out;
  out.reserve(4 * pixels.size());
  for (const Rgba& pixel : pixels)
    for (const float value : pixel)
      out.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255.f + 0.5f));
  return out;
}

Image halved(const Image& picture) {
  Image out(std::max(1, picture.columns / 2), std::max(1, picture.rows / 2), {});
  for (int r = 0; r < out.rows; ++r) {
    for (int c = 0; c < out.columns; ++c) {
      const int c1 = std::min(2 * c + 1, picture.columns - 1);
      const int r1 = std::min(2 * r + 1, picture.rows - 1);
      const Rgba &p = picture.at(2 * c, 2 * r), &q = picture.at(c1, 2 * r);
      const Rgba &s = picture.at(2 * c, r1), &t = picture.at(c1, r1);
      for (std::size_t i = 0; i < 4; ++i) out.at(c, r)[i] = 0.25f * (p[i] + q[i] + s[i] + t[i]);
    }
  }
  return out;
}

std::vector<Image> mipmaps(Image picture, int smallest) {
  std::vector<Image> out{std::move(picture)};
  while (std::min(out.back().columns, out.back().rows) > smallest)
    out.push_back(halved(out.back()));
  return out;
}

void paste(const Image& part, int column, int row, Image& whole) {
  for (int r = 0; r < part.rows; ++r)
    for (int c = 0; c < part.columns; ++c) whole.at(column + c, row + r) = part.at(c, r);
}

Noise::Noise(std::uint64_t seed) : lattice_(static_cast<std::size_t>(PERIOD) * PERIOD) {
  const Random random(seed);
  for (std::size_t i = 0; i < lattice_.size(); ++i)
    lattice_[i] = static_cast<float>(random.uniform(i));
}

float Noise::smooth(float x, float y) const {
  return octave(lattice_, x, y);
}

float Noise::fractal(float x, float y, int octaves) const {
  float sum = 0.f, total = 0.f, weight = 1.f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * octave(lattice_, x, y);
    total += weight;
    weight *= 0.5f;
    x = 2.f * x + 17.f;  // a shift keeps the lattices from lining up
    y = 2.f * y + 31.f;
  }
  return sum / total;
}

}  // namespace vegetation_sim::view
