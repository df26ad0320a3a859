// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/mesh/grass_geometry.h"

#include <algorithm>
#include <cmath>

#include "grass/mesh/mesh_writer.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

const Vec3 SOIL(0.30, 0.24, 0.15);

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

StripPicture makeStripPicture(int columns, int rows, int blades, std::uint64_t seed) {
  StripPicture out{columns, rows, {}};
  out.pixels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 4, 0);
  const Random random(seed);
  // Blades are painted from faint to strong, so that no blade hides a stronger one.
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

Vec3 farColour(const FeatureMap& map, const Features& f) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (std::size_t s = 0; s < map.species().size(); ++s) {
    const Species& species = map.species()[s].species;
    const double blade = f.mix[s] * 0.5 * species.width * f.height;  // it tapers
    const double flower = f.mix[s] * PI * species.flower_radius * species.flower_radius;
    sum += blade * bladeColour(species, f.colour) + flower * species.flower_colour;
    area += blade + flower;
  }
  return area > 0.0 ? Vec3(sum / area) : meanColour(map, f);
}

std::vector<std::uint8_t> groundColours(const FeatureMap& map, double full_density) {
  std::vector<std::uint8_t> out;
  out.reserve(static_cast<std::size_t>(map.law().columns) *
              static_cast<std::size_t>(map.law().rows) * 3);
  for (int row = 0; row < map.law().rows; ++row)
    for (int column = 0; column < map.law().columns; ++column) {
      const Features f = map.node(column, row);
      const double cover = saturate(f.density / full_density);
      const Vec3 colour = SOIL + (farColour(map, f) * 0.8 - SOIL) * cover;
      for (int i = 0; i < 3; ++i) out.push_back(byteOf(colour[i]));
    }
  return out;
}

}  // namespace vegetation_sim::grass
