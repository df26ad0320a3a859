// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/geometry.h"

#include <algorithm>
#include <cmath>

#include "grass/mesh_writer.h"
#include "vegetation_sim/common/math.h"
#include "vegetation_sim/common/random.h"

namespace vegetation_sim::grass {
namespace {

const Vec3 SOIL(0.30, 0.24, 0.15);

// Points of the six that a ribbon of so many segments keeps.
std::array<int, POINTS> keptPoints(int segments) {
  switch (segments) {
    case 1:
      return {0, LINKS};
    case 2:
      return {0, 3, LINKS};
    case 3:
      return {0, 2, 4, LINKS};
    default:
      return {0, 1, 2, 3, 4, 5};
  }
}

// Way of a root to the nearest edge of its tile.
Vec3 wayToEdge(const Tile& tile, const BladeLook& look) {
  const double u = double{look.u}, v = double{look.v};
  const double west = u, east = 1.0 - u, south = v, north = 1.0 - v;
  const double least = std::min({west, east, south, north}), size = double{tile.size};
  if (west == least) return {-size * west, 0.0, 0.0};
  if (east == least) return {size * east, 0.0, 0.0};
  return south == least ? Vec3(0.0, -size * south, 0.0) : Vec3(0.0, size * north, 0.0);
}

void appendFlower(const Vec3& tip, const Vec3& side, const Species& species, GrassMesh& mesh) {
  const double r = species.flower_radius;
  const Vec3 up(0.0, 0.0, r);
  const auto first = addVertex(mesh, tip - side * r, 0.0, 0.0, species.flower_colour, 1.0);
  addVertex(mesh, tip + side * r, 1.0, 0.0, species.flower_colour, 1.0);
  addVertex(mesh, tip + up, 0.5, 1.0, species.flower_colour, 1.0);
  addTriangle(mesh, first, first + 1, first + 2);
}

Vec3 sideOf(const Vec3& along, const Vec3& view) {
  const Vec3 side = along.cross(view);
  const double size = length(side);
  return size > 1e-12 ? Vec3(side / size) : Vec3(Vec3::UnitX());
}

}  // namespace

void GrassMesh::clear() {
  positions.clear();
  texture.clear();
  colours.clear();
  indices.clear();
}

Vec3 bladeColour(const Species& species, double colour) {
  return species.colour + (species.dry_colour - species.colour) * saturate(colour);
}

void appendRibbons(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks, int count,
                   const RibbonStyle& style, GrassMesh& mesh) {
  const Vec3 corner = Vec3(tile.x, tile.y, tile.z) - mesh.origin, eye = style.eye - mesh.origin;
  const auto kept = keptPoints(style.segments);
  for (int blade = 0; blade < count; ++blade) {
    const BladeLook look = bladeLook(tile, blade);
    const Species& species = map.species()[static_cast<std::size_t>(look.species)].species;
    const BladeBlock& block = blocks[blade / BLOCK];
    const int lane = blade % BLOCK;
    const Vec3 shift = corner + wayToEdge(tile, look) * style.slide;
    const auto point_at = [&](int i) {
      return Vec3(Vec3(block.x[i][lane], block.y[i][lane], block.z[i][lane]) + shift);
    };
    const Vec3 root = point_at(0), tip = point_at(LINKS);
    const Vec3 side = sideOf(tip - root, eye - root);
    const Vec3 colour = bladeColour(species, double{look.colour});
    const double half = 0.5 * species.width * style.width;
    const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
    for (int k = 0; k < style.segments; ++k) {
      const double way = static_cast<double>(kept[static_cast<std::size_t>(k)]) / LINKS;
      const Vec3 point = point_at(kept[static_cast<std::size_t>(k)]);
      // Dark at the root, where neighbours keep the light away.
      const Vec3 shade = colour * (0.45 + 0.55 * way);
      addVertex(mesh, point - side * (half * (1.0 - way)), 0.0, way, shade, 1.0);
      addVertex(mesh, point + side * (half * (1.0 - way)), 1.0, way, shade, 1.0);
    }
    addVertex(mesh, tip, 0.5, 1.0, colour, 1.0);
    for (std::uint32_t t = 0; t + 1 < 2 * static_cast<std::uint32_t>(style.segments); ++t)
      addTriangle(mesh, first + t, first + t + 1, first + t + 2);
    if (species.flower_radius > 0.0) appendFlower(tip, side, species, mesh);
  }
}

StripPicture makeStripPicture(int columns, int rows, int blades, std::uint64_t seed) {
  StripPicture out{columns, rows, {}};
  out.pixels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 4, 0);
  const Random random(seed);
  // From faint to strong, so that a blade that is kept is never cut by one that is not.
  for (int blade = 0; blade < blades; ++blade) {
    const auto k = static_cast<std::uint64_t>(blade) * 4;
    const double x = random.uniform(k, 0.0, columns), top = rows * random.uniform(k + 1, 0.55, 1.0);
    const double lean = random.uniform(k + 2, -0.15, 0.15) * rows;
    const double width = std::max(1.0, 0.012 * columns),
                 light = random.uniform(k + 3, 150.0, 255.0);
    const int alpha = 1 + 254 * (blade + 1) / blades;
    for (int y = 0; y < static_cast<int>(top); ++y) {
      const double way = y / top, middle = x + lean * way * way;
      const int half = static_cast<int>(std::lround(0.5 * width * (1.0 - way)));
      for (int dx = -half; dx <= half; ++dx) {
        const int column = ((static_cast<int>(middle) + dx) % columns + columns) % columns;
        const std::size_t i =
            (static_cast<std::size_t>(rows - 1 - y) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column)) *
            4;
        const auto shade = static_cast<std::uint8_t>(light * (0.5 + 0.5 * way));
        out.pixels[i] = out.pixels[i + 1] = out.pixels[i + 2] = shade;
        out.pixels[i + 3] = static_cast<std::uint8_t>(alpha);
      }
    }
  }
  return out;
}

Vec3 meanColour(const FeatureMap& map, const Features& f) {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (std::size_t s = 0; s < map.species().size(); ++s) {
    sum += bladeColour(map.species()[s].species, f.colour) * f.mix[s];
    weight += f.mix[s];
  }
  return weight > 0.0 ? Vec3(sum / weight) : bladeColour(map.species()[0].species, f.colour);
}

std::vector<std::uint8_t> groundColours(const FeatureMap& map, double full_density) {
  std::vector<std::uint8_t> out;
  out.reserve(static_cast<std::size_t>(map.law().columns) *
              static_cast<std::size_t>(map.law().rows) * 3);
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column) {
      const Features f = map.node(column, row);
      const double cover = saturate(f.density / full_density);
      const Vec3 colour = SOIL + (meanColour(map, f) * 0.8 - SOIL) * cover;
      for (int i = 0; i < 3; ++i) out.push_back(byteOf(colour[i]));
    }
  return out;
}

}  // namespace vegetation_sim::grass
