// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/strip_cover.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr double LOWEST = 0.75, HIGHEST = 1.15;    // factor of the height
constexpr double DARKEST = 0.84, LIGHTEST = 1.14;  // factor of the colour
constexpr double LEAN = 0.32;                      // of a top to either side, per height
constexpr double SOFT = 0.35;                      // of the ends of tufts
constexpr double ROOTS = 0.5;  // share of the blades that reach the ground, for a ragged foot

// What random numbers of a tile are for.
enum Purpose { VARIETY = 4, THINNING = 5 };

class StripDice {
 public:
  StripDice(std::uint64_t key, Purpose purpose)
      : seed_(mix32(static_cast<std::uint32_t>(key >> 32) + 0x9e3779b9U * std::uint32_t(purpose)) ^
              static_cast<std::uint32_t>(key)) {}
  // Returns a uniform number in [low, high) for an index.
  double between(int index, double low, double high) const {
    const std::uint32_t word = mix32(seed_ + static_cast<std::uint32_t>(index));
    return low + (high - low) * word * (1.0 / 4294967296.0);
  }

 private:
  std::uint32_t seed_;
};

void put(const Vec3& at, std::size_t vertex, grass::GrassMesh& mesh) {
  for (int i = 0; i < 3; ++i)
    mesh.positions[3 * vertex + static_cast<std::size_t>(i)] = static_cast<float>(at[i]);
}

Vec3 pointAt(std::size_t vertex, const grass::GrassMesh& mesh) {
  const float* p = &mesh.positions[3 * vertex];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

void tone(double factor, std::uint8_t* colour) {
  for (int i = 0; i < 3; ++i)
    colour[i] = static_cast<std::uint8_t>(std::clamp(factor * colour[i], 0.0, 255.0));
}

// Multiplies the density at a vertex.
void fade(double factor, std::size_t vertex, grass::GrassMesh& mesh) {
  std::uint8_t& density = mesh.colours[4 * vertex + 3];
  density = static_cast<std::uint8_t>(factor * density);
}

}  // namespace

void varyStrips(const grass::Tile& tile, const StripsBegin& begin, grass::GrassMesh& mesh) {
  const StripDice dice(tile.key, VARIETY);
  for (std::size_t i = begin.vertex; i + 1 < mesh.vertexCount(); i += 2) {
    const int index = 2 * static_cast<int>(i - begin.vertex);
    const Vec3 root = pointAt(i, mesh);
    Vec3 offset = (pointAt(i + 1, mesh) - root) * dice.between(index, LOWEST, HIGHEST);
    const double reach = LEAN * offset.z();
    offset.x() += dice.between(index + 1, -reach, reach);
    offset.y() += dice.between(index + 2, -reach, reach);
    put(root + offset, i + 1, mesh);
    fade(ROOTS, i, mesh);
    const double light = dice.between(index + 3, DARKEST, LIGHTEST);
    for (const std::size_t vertex : {i, i + 1}) tone(light, &mesh.colours[4 * vertex]);
  }
}

void thinStrips(const grass::Tile& tile, const StripsBegin& begin, double share,
                grass::GrassMesh& mesh) {
  if (!(share < 1.0)) return;
  const StripDice dice(tile.key, THINNING);
  for (std::size_t i = begin.vertex; i + 1 < mesh.vertexCount(); i += 2) {
    const double rank = dice.between(static_cast<int>(i - begin.vertex), 0.0, 1.0);
    const double left = saturate((share * (1.0 + SOFT) - rank) / SOFT);
    for (const std::size_t vertex : {i, i + 1}) fade(left, vertex, mesh);
  }
  const auto shows = [&](std::size_t i) { return mesh.colours[4 * mesh.indices[i] + 3] > 0; };
  std::size_t end = begin.index;
  for (std::size_t i = begin.index; i + 2 < mesh.indices.size(); i += 3) {
    if (!shows(i) && !shows(i + 1) && !shows(i + 2)) continue;
    for (std::size_t k = 0; k < 3; ++k) mesh.indices[end + k] = mesh.indices[i + k];
    end += 3;
  }
  mesh.indices.resize(end);
}

}  // namespace vegetation_sim::view
