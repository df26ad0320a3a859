// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/foliage_texture.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "rviz/textures/leaf_atlas.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr int CUTS = 16;      // places for images in the atlas; its width is a power of two
constexpr int PAINTED = 5;    // of them
constexpr int SMALLEST = 4;   // edge of an image in the last mipmap [pixel]
constexpr float DOTS = 32.f;  // of a puff, along an edge
constexpr float IMAGE_INSET =
    0.02f;  // share of an image that keeps its neighbours out of the filter

float triangleWave(float x) {
  return std::fabs(2.f * (x - std::floor(x)) - 1.f);
}

// Returns half the breadth of a leaf at t from its foot (0) to its tip (1).
float halfWidth(float t) {
  return 0.47f * std::sin(static_cast<float>(PI) * std::pow(std::clamp(t, 0.f, 1.f), 0.72f));
}

// Returns the lightness of a leaf with a midrib, forward veins and a darker edge.
Rgba leafPixel(float x, float t) {
  const float half = halfWidth(t), out = std::fabs(x);
  const float serrated = half * (1.f - 0.06f * triangleWave(14.f * t));
  if (out > serrated && !(t < 0.08f && out < 0.02f)) return {0.8f, 0.8f, 0.8f, 0.f};
  const float vein = triangleWave(7.f * t - 9.f * out * out - 2.2f * out);
  float light = 0.78f + 0.1f * vein - 0.16f * (out / std::max(half, 0.05f));
  if (out < 0.025f * (1.2f - t)) light = 0.98f;
  light += x > 0.f ? 0.05f : -0.02f;  // the halves are folded a little
  return {light, light, 0.96f * light, 1.f};
}

// It is the same along the whole length, since pieces join.
Rgba ribbonPixel(float x, float /*t*/) {
  const float out = std::fabs(x);
  if (out > 0.46f) return {0.8f, 0.8f, 0.8f, 0.f};
  const float line = triangleWave(6.f * x);
  const float light = 0.72f + 0.14f * line + (out < 0.04f ? 0.14f : 0.f) - 0.3f * out * out;
  return {light, light, 0.97f * light, 1.f};
}

template <class Pixel>
Image paint(int edge, const Pixel& pixel) {
  Image out(2 * edge, 2 * edge, {});
  for (int r = 0; r < out.rows; ++r)
    for (int c = 0; c < out.columns; ++c)
      out.at(c, r) = pixel((static_cast<float>(c) + 0.5f) / static_cast<float>(out.columns) - 0.5f,
                           (static_cast<float>(r) + 0.5f) / static_cast<float>(out.rows));
  return halved(out);  // painting at twice the size smooths the edges
}

// Paints five leaves on a twig by sampling the leaf in rotated frames.
Rgba sprigPixel(float x, float t) {
  struct Place {
    float x, t, turn, size;
  };
  static constexpr Place PLACES[] = {{0.f, 0.52f, 0.f, 0.48f},
                                     {0.f, 0.36f, 0.75f, 0.46f},
                                     {0.f, 0.40f, -0.75f, 0.44f},
                                     {0.f, 0.12f, 1.0f, 0.48f},
                                     {0.f, 0.16f, -1.0f, 0.47f}};
  Rgba out{0.8f, 0.8f, 0.8f, 0.f};
  if (t < 0.6f && std::fabs(x) < 0.012f) out = {0.55f, 0.5f, 0.42f, 1.f};
  for (const Place& place : PLACES) {
    const float dx = x - place.x, dt = t - place.t;
    const float c = std::cos(place.turn), s = std::sin(place.turn);
    const float along = (c * dt + s * dx) / place.size, across = (c * dx - s * dt) / place.size;
    if (along < 0.f || along > 1.f || std::fabs(across) > 0.5f) continue;
    const Rgba pixel = leafPixel(across / 0.75f, along);
    if (pixel[3] > 0.f) out = pixel;
  }
  return out;
}

// Dots that the alpha test shows or not: many puffs behind each other make a soft edge.
Rgba puffPixel(float x, float t) {
  const float out = 2.f * std::hypot(x, t - 0.5f);
  const auto dot = mix32(static_cast<std::uint32_t>((x + 0.5f) * DOTS) * 64U +
                         static_cast<std::uint32_t>(t * DOTS));
  const float random = static_cast<float>(dot >> 8) / 16777216.f;
  const float dense = 0.75f * static_cast<float>(smoothStep(1.0 - static_cast<double>(out)));
  return {0.94f, 0.94f, 0.94f, random < dense ? 1.f : 0.f};
}

}  // namespace

std::vector<Image> foliageAtlas(int edge) {
  std::vector<Image> out;
  const Image cuts[] = {paint(edge, leafPixel), paint(edge, sprigPixel), paint(edge, ribbonPixel),
                        Image(edge, edge, {0.8f, 0.8f, 0.8f, 1.f}), paint(edge, puffPixel)};
  static_assert(std::size(cuts) == PAINTED && PAINTED + MOST_PICTURES == CUTS);
  for (int side = edge; side >= SMALLEST; side /= 2)
    out.emplace_back(CUTS * side, side, Rgba{0.8f, 0.8f, 0.8f, 0.f});
  for (int cut = 0; cut < PAINTED; ++cut) addToAtlas(cuts[cut], cut, out);
  return out;
}

int firstPicturePlace() {
  return PAINTED;
}

void addToAtlas(const Image& picture, int place, std::vector<Image>& atlas) {
  const std::vector<Image> levels = coveredMipmaps(picture, SMALLEST);
  for (std::size_t level = 0; level < std::min(levels.size(), atlas.size()); ++level)
    paste(levels[level], levels[level].columns * place, 0, atlas[level]);
}

std::array<float, 2> foliagePlace(LeafCut cut, float u, float v) {
  return foliagePlace(static_cast<int>(cut), u, v);
}

std::array<float, 2> foliagePlace(int place, float u, float v) {
  return {(static_cast<float>(place) + IMAGE_INSET + (1.f - 2.f * IMAGE_INSET) * u) / CUTS,
          IMAGE_INSET + (1.f - 2.f * IMAGE_INSET) * v};
}

}  // namespace vegetation_sim::view
