// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/strip_cover.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr int EDGES = 4;
// Strips are shifted inwards from their edge by between these distances, in sides of the tile.
constexpr double OUTERMOST = -0.12, INNERMOST = 0.46;
constexpr double END = 0.16;      // largest distance of an end from the corner, in sides
constexpr double STAGGER = 0.05;  // of other points along the edge, in sides
constexpr double LOWEST = 0.75, HIGHEST = 1.15;    // factor of the height
constexpr double DARKEST = 0.84, LIGHTEST = 1.14;  // factor of the colour
constexpr double LEAN = 0.32;                      // of a top to either side, per height
constexpr double SOFT = 0.35;                      // of the ends of tufts
constexpr double ROOTS = 0.5;  // share of the blades that reach the ground, for a ragged foot

// Random numbers of a part of a tile.
class StripDice {
 public:
  StripDice(std::uint64_t key, int part)
      : seed_(mix32(static_cast<std::uint32_t>(key >> 32) + 0x9e3779b9U * std::uint32_t(part)) ^
              static_cast<std::uint32_t>(key)) {}
  // Returns a uniform number in [low, high) for an index.
  double between(int index, double low, double high) const {
    const std::uint32_t word = mix32(seed_ + static_cast<std::uint32_t>(index));
    return low + (high - low) * word * (1.0 / 4294967296.0);
  }

 private:
  std::uint32_t seed_;
};

// A point of a strip, in sides of the tile.
struct StripPoint {
  double along, inward;
};

StripPoint pointOf(const StripDice& dice, int k) {
  constexpr int LAST = grass::STRIP_CELLS;
  const auto inward = [&](int i) { return dice.between(i, OUTERMOST, INNERMOST); };
  StripPoint out{static_cast<double>(k) / LAST, inward(k)};
  // Every other point is near the middle of its neighbours, so that strips are curved, not jagged.
  if (k % 2) out.inward = 0.25 * out.inward + 0.375 * (inward(k - 1) + inward(k + 1));
  const double range = k == 0 || k == LAST ? END : STAGGER;
  out.along += dice.between(LAST + 1 + k, -range, range);
  return out;
}

// Returns the place of a point of an edge, in sides of the tile from its south-west corner.
grass::Point placeOf(int edge, const StripPoint& p) {
  if (edge == 0) return {p.along, p.inward};
  if (edge == 1) return {1.0 - p.inward, p.along};
  if (edge == 2) return {1.0 - p.along, 1.0 - p.inward};
  return {p.inward, 1.0 - p.along};
}

// Returns the vector from root to top of grass that leans by `offset` without tread, where the
// ground has been trodden or cut. `cover` is multiplied by the share that is left of cut grass.
Vec3 treadOn(const grass::CrushPatch& patch, const grass::Point& place, double grown, Vec3 offset,
             double& cover) {
  const std::size_t i =
      patch.nearest(static_cast<float>(saturate(place.x)), static_cast<float>(saturate(place.y)));
  const double flat = std::hypot(offset.x(), offset.y());
  double height = length(offset);
  const double share = 1.0 - double{patch.tilt[i]} / grass::BEND_LIMIT;
  const double bend = flat > 0.0 ? share * std::atan2(flat, offset.z()) / flat : 0.0;
  const double x = double{patch.tx[i]} + bend * offset.x();
  const double y = double{patch.ty[i]} + bend * offset.y();
  if (!patch.cut.empty() && grown * double{patch.cut[i]} < height) {
    cover *= grown * double{patch.cut[i]} / height;
    height = grown * double{patch.cut[i]};
  }
  const double lean = std::hypot(x, y), angle = std::min(lean, grass::BEND_LIMIT);
  const double reach = lean > 0.0 ? height * std::sin(angle) / lean : 0.0;
  return {reach * x, reach * y, height * std::cos(angle)};
}

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
  const StripDice dice(tile.key, EDGES);
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
  const StripDice dice(tile.key, EDGES + 1);
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

void appendShiftedStrips(const grass::FeatureMap& map, const terrain::HeightMap& terrain,
                         const grass::Tile& tile, const grass::TileMotion& motion, double grown,
                         double full_density, const grass::GrassLight& light,
                         grass::GrassMesh& mesh) {
  std::size_t vertex = mesh.vertexCount();
  grass::TileMotion untrodden = motion;
  untrodden.crush = nullptr;
  appendStrips(map, tile, untrodden, grown, full_density, mesh, &light);
  const double size = double{tile.size};
  const Vec3 corner = Vec3(tile.x, tile.y, tile.z) - mesh.origin;
  for (int edge = 0; edge < EDGES; ++edge) {
    const StripDice dice(tile.key, edge);
    const auto shift = static_cast<float>(dice.between(100, 0.0, 1.0));
    for (int k = 0; k <= grass::STRIP_CELLS; ++k, vertex += 2) {
      const grass::Point place = placeOf(edge, pointOf(dice, k));
      Vec3 root = corner + size * Vec3(place.x, place.y, 0.0);
      if (tile.sloped)
        root.z() =
            terrain.height(tile.x + size * place.x, tile.y + size * place.y) - mesh.origin.z();
      Vec3 offset = pointAt(vertex + 1, mesh) - pointAt(vertex, mesh);
      double cover = 1.0;
      if (motion.crush) offset = treadOn(*motion.crush, place, grown, offset, cover);
      put(root, vertex, mesh);
      put(root + offset, vertex + 1, mesh);
      for (const std::size_t i : {vertex, vertex + 1}) {
        fade(cover, i, mesh);
        mesh.texture[2 * i] += shift;
      }
    }
  }
}

}  // namespace vegetation_sim::view
