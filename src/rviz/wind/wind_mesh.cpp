// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/wind/wind_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double SHORTEST = 1e-3;    // [m] length of an arrow
constexpr double RING_WIDTH = 0.02;  // as a part of the radius
constexpr double LIFT = 0.1;         // [m] over the ground
constexpr int RING_SIDES = 64;
const Vec3 DISC_RED(0.86, 0.22, 0.12);  // of wood that moves, in the colours by state

std::uint32_t addVertex(const Vec3& at, const Vec3& colour, grass::GrassMesh& mesh) {
  const auto out = static_cast<std::uint32_t>(mesh.vertexCount());
  const Vec3 local = at - mesh.origin;
  for (int i = 0; i < 3; ++i) mesh.positions.push_back(static_cast<float>(local[i]));
  mesh.texture.insert(mesh.texture.end(), {0.f, 0.f});
  for (int i = 0; i < 3; ++i)
    mesh.colours.push_back(static_cast<std::uint8_t>(255.0 * std::clamp(colour[i], 0.0, 1.0)));
  mesh.colours.push_back(255);
  return out;
}

void addBlade(const Vec3& from, const Vec3& vector, const Vec3& side, const Vec3& colour,
              grass::GrassMesh& mesh) {
  const double size = length(vector);
  const Vec3 neck = from + (1.0 - std::min(0.4, 0.35 / size)) * vector;
  const Vec3 thin = std::min(0.03, 0.05 * size) * side, broad = std::min(0.12, 0.2 * size) * side;
  const std::uint32_t a = addVertex(from - thin, 0.75 * colour, mesh);
  addVertex(from + thin, 0.75 * colour, mesh);
  addVertex(neck - thin, colour, mesh);
  addVertex(neck + thin, colour, mesh);
  addVertex(neck - broad, colour, mesh);
  addVertex(neck + broad, colour, mesh);
  addVertex(from + vector, colour, mesh);
  mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2, a + 4, a + 5, a + 6});
}

// Adds a band on the ground.
void addRing(const Vec3& centre, double radius, double width, const Vec3& colour,
             const terrain::HeightMap& ground, grass::GrassMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
  for (int i = 0; i <= RING_SIDES; ++i) {
    const SinCos turn = sinCosTurns(static_cast<double>(i) / RING_SIDES);
    for (const double r : {radius - width, radius}) {
      const double x = centre.x() + r * turn.cos, y = centre.y() + r * turn.sin;
      addVertex(Vec3(x, y, ground.height(x, y) + LIFT), colour, mesh);
    }
    if (i == RING_SIDES) break;
    const std::uint32_t a = first + 2 * static_cast<std::uint32_t>(i);
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
  }
}

}  // namespace

Vec3 colourOfSpeed(double share) {
  static constexpr std::array<std::array<double, 3>, 4> STOPS{
      {{0.25, 0.45, 0.85}, {0.20, 0.68, 0.42}, {0.95, 0.80, 0.22}, {0.86, 0.22, 0.16}}};
  const double place = 3.0 * std::clamp(share, 0.0, 1.0);
  const auto low = std::min<std::size_t>(2, static_cast<std::size_t>(place));
  const double part = place - static_cast<double>(low);
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out[i] = (1.0 - part) * STOPS[low][k] + part * STOPS[low + 1][k];
  }
  return out;
}

void appendArrow(const Vec3& from, const Vec3& vector, const Vec3& colour, grass::GrassMesh& mesh) {
  const double size = length(vector);
  if (!(size >= SHORTEST)) return;
  const Vec3 along = vector / size;
  const Vec3 any = std::fabs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 across = cross(along, any);
  const Vec3 flat = across / length(across);
  addBlade(from, vector, flat, colour, mesh);
  addBlade(from, vector, cross(along, flat), 0.8 * colour, mesh);
}

std::size_t appendArrows(const wind::Instant& wind, const terrain::HeightMap& ground,
                         const Vec3& around, const WindStyle& style, grass::GrassMesh& mesh) {
  const double spacing = std::max(style.spacing, style.extent / std::sqrt(MOST_ARROWS - 1.0));
  const int half = static_cast<int>(0.5 * style.extent / spacing);
  const double column = std::round(around.x() / spacing), row = std::round(around.y() / spacing);
  std::size_t count = 0;
  for (int r = -half; r <= half; ++r) {
    for (int c = -half; c <= half; ++c) {
      const double x = spacing * (column + c), y = spacing * (row + r);
      const Vec3 at(x, y, ground.height(x, y) + style.height);
      const Vec3 velocity = wind.velocity(at);
      const std::size_t before = mesh.indices.size();
      appendArrow(at, style.scale * velocity, colourOfSpeed(length(velocity) / style.full_speed),
                  mesh);
      count += mesh.indices.size() > before ? 1 : 0;
    }
  }
  return count;
}

void appendTerm(const wind::Term& term, const terrain::HeightMap& ground, const WindStyle& style,
                grass::GrassMesh& mesh) {
  const bool is_red = style.red_discs && term.kind == wind::Kind::DISK;
  const Vec3 colour = is_red ? DISC_RED : colourOfSpeed(term.peak / style.full_speed);
  const Vec3 base(term.centre.x(), term.centre.y(),
                  ground.height(term.centre.x(), term.centre.y()) + LIFT);
  addRing(base, term.radius, std::max(0.1, RING_WIDTH * term.radius), colour, ground, mesh);
  switch (term.kind) {
    case wind::Kind::TORNADO:
    case wind::Kind::BLAST:
      addRing(base, term.core, std::max(0.1, 2.0 * RING_WIDTH * term.core), colour, ground, mesh);
      appendArrow(base, Vec3(0.0, 0.0, 2.0 * style.scale * term.peak), colour, mesh);
      break;
    case wind::Kind::GUST:
    case wind::Kind::WAKE:
      appendArrow(base, 2.0 * style.scale * term.peak * term.direction, colour, mesh);
      break;
    default:
      appendArrow(base, 2.0 * style.scale * term.amplitude, colour, mesh);
  }
}

}  // namespace vegetation_sim::view
