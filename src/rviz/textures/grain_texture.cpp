// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/grain_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr std::uint64_t GRAIN_SEED = 0x6a56;
constexpr std::array<Rgba, 7> LEAVES{{{0.42f, 0.31f, 0.20f, 1.f},
                                      {0.55f, 0.42f, 0.24f, 1.f},
                                      {0.38f, 0.34f, 0.28f, 1.f},
                                      {0.56f, 0.49f, 0.36f, 1.f},
                                      {0.24f, 0.18f, 0.13f, 1.f},
                                      {0.48f, 0.40f, 0.29f, 1.f},
                                      {0.33f, 0.35f, 0.19f, 1.f}}};
constexpr Rgba EARTH{0.20f, 0.16f, 0.12f, 1.f}, FALLEN_TWIG{0.47f, 0.40f, 0.32f, 1.f};
constexpr float CONTRAST = 0.8f, COLOUR = 0.5f;                              // of the litter
constexpr int AREA_PER_LEAF = 75, AREA_PER_TWIG = 3000, AREA_PER_BLADE = 9;  // [pixel]

// Noise that repeats without a seam for any edge: each place is mixed with its neighbours one edge
// away.
float repeatingNoise(const Noise& noise, float x, float y, float edge) {
  const auto row = [&](float at_y) {
    const float part = x / edge;
    return (1.f - part) * noise.smooth(x, at_y) + part * noise.smooth(x - edge, at_y);
  };
  const float part = y / edge;
  return (1.f - part) * row(y) + part * row(y - edge);
}

// The picture repeats, so places beyond an edge are those at the other edge.
class Painter {
 public:
  explicit Painter(Image& picture) : picture_(picture), edge_(picture.columns) {}

  int edge() const { return edge_; }
  Rgba& at(double x, double y) {
    return picture_.at(static_cast<int>(std::floor(x)) & (edge_ - 1),
                       static_cast<int>(std::floor(y)) & (edge_ - 1));
  }
  void colour(double x, double y, const Rgba& to, float weight) {
    Rgba& pixel = at(x, y);
    for (std::size_t i = 0; i < 3; ++i) pixel[i] += (to[i] - pixel[i]) * weight;
  }

 private:
  Image& picture_;
  int edge_;
};

Rgba brighter(const Rgba& c, float factor) {
  return {c[0] * factor, c[1] * factor, c[2] * factor, c[3]};
}

// Paints a leaf with a shadow, a midrib and two halves in different light.
void paintLeaf(const Random& own, Painter& out) {
  const double x = own.uniform(0, 0.0, out.edge()), y = own.uniform(1, 0.0, out.edge());
  const double turn = own.uniform(2, 0.0, 2.0 * PI), c = std::cos(turn), s = std::sin(turn);
  const double length = own.uniform(3, 0.004, 0.013) * out.edge();
  const double width = own.uniform(4, 0.35, 0.7) * length;
  const auto kind = static_cast<std::size_t>(own.uniform(5, 0.0, LEAVES.size() - 1e-9));
  const auto light = static_cast<float>(own.uniform(6, 0.8, 1.2));
  const int reach = static_cast<int>(length) + 3;
  const auto insideOf = [&](double dx, double dy) {
    const double along = (c * dx + s * dy) / length, across = (c * dy - s * dx) / width;
    const double narrow = 1.0 - 0.55 * along;  // towards the tip
    return 1.0 - along * along - across * across / std::max(0.2, narrow * narrow);
  };
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double inside = insideOf(dx, dy);
      if (inside <= 0.0) {
        if (insideOf(dx - 2, dy + 2) > 0.0) out.colour(x + dx, y + dy, EARTH, 0.6f);
        continue;
      }
      const double across = (c * dy - s * dx) / width;
      const float half = across > 0.0 ? 1.12f : 0.90f, rib = std::fabs(across) < 0.12 ? 0.75f : 1.f;
      out.colour(x + dx, y + dy, brighter(LEAVES[kind], light * half * rib),
                 static_cast<float>(smoothStep(inside / 0.25)));
    }
  }
}

void paintTwig(const Random& own, Painter& out) {
  const double length = own.uniform(2, 0.02, 0.08) * out.edge(), bend = own.uniform(5, -0.6, 0.6);
  const auto light = static_cast<float>(own.uniform(4, 0.6, 1.2));
  double x = own.uniform(0, 0.0, out.edge()), y = own.uniform(1, 0.0, out.edge());
  const double turn = own.uniform(3, 0.0, 2.0 * PI);
  for (double way = 0.0; way < length; way += 0.5) {
    const double angle = turn + bend * way / length;
    x += 0.5 * std::cos(angle);
    y += 0.5 * std::sin(angle);
    out.colour(x + 2.0, y - 2.0, EARTH, 0.3f);
    out.colour(x, y, brighter(FALLEN_TWIG, light), 0.8f);
    out.colour(x + 1.0, y, brighter(FALLEN_TWIG, 0.7f * light), 0.6f);
  }
}

// Paints a blade of grass from its dark root to its light tip.
void paintBlade(const Random& own, Painter& out) {
  const double angle = own.uniform(2, 0.0, 2.0 * PI), bend = own.uniform(5, -0.8, 0.8);
  const double length = own.uniform(3, 0.008, 0.026) * out.edge();
  const auto light = static_cast<float>(own.uniform(4, 0.24, 0.66));
  double x = own.uniform(0, 0.0, out.edge()), y = own.uniform(1, 0.0, out.edge());
  for (double way = 0.0; way < length; way += 0.7) {
    const double part = way / length;
    x += 0.7 * std::cos(angle + bend * part);
    y += 0.7 * std::sin(angle + bend * part);
    const float to = light * static_cast<float>(0.45 + 0.65 * part);
    float &pixel = out.at(x, y)[3], &beside = out.at(x + 1.0, y)[3];
    pixel += (to - pixel) * 0.75f;
    beside += (0.8f * to - beside) * 0.4f;
  }
}

void paintBase(Image& out) {
  const Noise noise(GRAIN_SEED);
  const float unit = static_cast<float>(Noise::PERIOD) / static_cast<float>(out.columns);
  constexpr float PERIOD = static_cast<float>(Noise::PERIOD);
  for (int r = 0; r < out.rows; ++r) {
    for (int c = 0; c < out.columns; ++c) {
      const float x = static_cast<float>(c) * unit, y = static_cast<float>(r) * unit;
      const float fine = noise.smooth(x, y);
      const float tufts = repeatingNoise(noise, 0.25f * x, 0.25f * y, 0.25f * PERIOD);
      const Rgba earth = brighter(EARTH, 0.6f + 0.8f * fine);
      out.at(c, r) = {earth[0], earth[1], earth[2], 0.10f + 0.15f * fine + 0.15f * tufts};
    }
  }
}

// Adds broad variation to the turf.
void varyBroadly(Image& out) {
  const Noise noise(GRAIN_SEED + 1);
  const float unit = static_cast<float>(Noise::PERIOD) / static_cast<float>(out.columns);
  constexpr float BROAD = 0.125f * static_cast<float>(Noise::PERIOD);
  for (int r = 0; r < out.rows; ++r)
    for (int c = 0; c < out.columns; ++c) {
      const float x = 0.125f * static_cast<float>(c) * unit;
      const float y = 0.125f * static_cast<float>(r) * unit;
      out.at(c, r)[3] *= 0.72f + 0.56f * repeatingNoise(noise, x, y, BROAD);
    }
}

// Gives each channel its mean, and litter less contrast and colour.
void centre(Image& out) {
  std::array<double, 4> mean{};
  for (const Rgba& pixel : out.pixels)
    for (std::size_t i = 0; i < 4; ++i)
      mean[i] += static_cast<double>(pixel[i]) / static_cast<double>(out.pixels.size());
  for (Rgba& pixel : out.pixels) {
    for (std::size_t i = 0; i < 4; ++i) pixel[i] *= static_cast<float>(0.5 / mean[i]);
    const float grey = (pixel[0] + pixel[1] + pixel[2]) / 3.f;
    for (std::size_t i = 0; i < 3; ++i)
      pixel[i] = 0.5f + CONTRAST * (grey - 0.5f + COLOUR * (pixel[i] - grey));
  }
}

}  // namespace

Image grainPicture(int edge) {
  Image out(edge, edge, {});
  paintBase(out);
  Painter painter(out);
  const Random random(GRAIN_SEED);
  const auto paint = [&](int area, std::uint64_t kind, void (*one)(const Random&, Painter&)) {
    const Random own = random.child(kind);
    for (int i = 0; i < edge * edge / area; ++i)
      one(own.child(static_cast<std::uint64_t>(i)), painter);
  };
  paint(AREA_PER_LEAF, 0, paintLeaf);
  paint(AREA_PER_TWIG, 1, paintTwig);
  paint(AREA_PER_BLADE, 2, paintBlade);
  varyBroadly(out);
  centre(out);
  return out;
}

}  // namespace vegetation_sim::view
