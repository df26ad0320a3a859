// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rviz/ground/meadow_texture.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr std::uint64_t SEED = 0x57219;

// Replaces the alphas of the pixels first to last by those of `from` at the same ranks, so that any
// alpha test passes the same share of pixels.
void keepShares(std::vector<Rgba>& pixels, std::size_t first, std::size_t last,
                std::vector<float> from) {
  std::sort(from.begin(), from.end());
  std::vector<std::size_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pixels[a][3] < pixels[b][3]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    pixels[order[i]][3] = from[(2 * i + 1) * from.size() / (2 * order.size())];
}

// Averages colours and keeps the distribution of alpha row by row.
Image smaller(const Image& picture) {
  Image out(std::max(1, picture.columns / 2), std::max(1, picture.rows / 2), {});
  for (int r = 0; r < out.rows; ++r) {
    const int r0 = std::min(2 * r, picture.rows - 1), r1 = std::min(2 * r + 1, picture.rows - 1);
    std::vector<float> alphas;
    for (int c = 0; c < out.columns; ++c) {
      const int c0 = std::min(2 * c, picture.columns - 1);
      const int c1 = std::min(2 * c + 1, picture.columns - 1);
      Rgba sum{};
      float weight = 0.f;
      for (const Rgba* p :
           {&picture.at(c0, r0), &picture.at(c1, r0), &picture.at(c0, r1), &picture.at(c1, r1)}) {
        alphas.push_back((*p)[3]);
        weight += (*p)[3];
        for (std::size_t i = 0; i < 3; ++i) sum[i] += (*p)[i] * (*p)[3];
        sum[3] += 0.25f * (*p)[3];
      }
      for (std::size_t i = 0; i < 3; ++i) sum[i] = weight > 0.f ? sum[i] / weight : 0.75f;
      out.at(c, r) = sum;
    }
    const auto columns = static_cast<std::size_t>(out.columns);
    keepShares(out.pixels, static_cast<std::size_t>(r) * columns,
               (static_cast<std::size_t>(r) + 1) * columns, std::move(alphas));
  }
  return out;
}

std::vector<Image> allSizes(Image picture) {
  std::vector<Image> out{std::move(picture)};
  while (std::max(out.back().columns, out.back().rows) > 1) out.push_back(smaller(out.back()));
  return out;
}

// Returns the factor on the colour of the blade that has this alpha: some are straw, some bluer.
Rgba tintOf(std::uint8_t alpha) {
  constexpr double STRAW = 0.75, COOL = 0.3;  // random numbers above and below
  constexpr double DARKEST = 0.8;
  const std::uint32_t word = mix32(0x57a1U + alpha);
  const double hue = (word & 0xffffU) / 65535.0;
  const auto light = static_cast<float>(DARKEST + (word >> 16) / 65535.0 * 2.0 * (1.0 - DARKEST));
  if (hue > STRAW) return {1.15f * light, 1.03f * light, 0.82f * light, 1.f};
  if (hue < COOL) return {0.88f * light, 0.98f * light, 0.95f * light, 1.f};
  return {light, light, light, 1.f};
}

}  // namespace

std::vector<Image> stripPictures(int columns, int rows, int blades) {
  const grass::StripPicture from = grass::makeStripPicture(columns, rows, blades, SEED);
  Image out(columns, rows, {});
  // Roots are in the first row; a clear last row keeps them from showing above the tips.
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const std::uint8_t* pixel =
          &from.pixels[4 * static_cast<std::size_t>((rows - 1 - r) * columns + c)];
      const Rgba tint = tintOf(pixel[3]);
      for (std::size_t k = 0; k < 4; ++k)
        out.at(c, r)[k] = std::min(1.f, tint[k] * static_cast<float>(pixel[k]) / 255.f);
    }
  return allSizes(std::move(out));
}

std::vector<Image> layerPictures(int edge) {
  Image out(edge, edge, {0.8f, 0.8f, 0.8f, 0.f});
  const Random random(SEED);
  const int dots = edge * edge / 10;
  for (int i = 0; i < dots; ++i) {
    const Random own = random.child(static_cast<std::uint64_t>(i));
    const auto light = static_cast<float>(own.uniform(2, 0.65, 1.0));
    const double angle = own.uniform(3, 0.0, 2.0 * PI);
    const auto alpha = static_cast<float>(i + 1) / static_cast<float>(dots);
    for (int s = 0; s < 3; ++s) {
      const int c = static_cast<int>(own.uniform(0) * edge + s * std::cos(angle)) & (edge - 1);
      const int r = static_cast<int>(own.uniform(1) * edge + s * std::sin(angle)) & (edge - 1);
      out.at(c, r) = {light, light, light, alpha};
    }
  }
  return allSizes(std::move(out));
}

}  // namespace vegetation_sim::view
