// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/ground_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rviz/textures/grain_texture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr int GRAIN_EDGE = 1024;     // [pixel]
constexpr int TILES = 4;             // batches along an edge, culled one by one
constexpr int MOST_TILE_CELLS = 40;  // along the edge of a tile
// Radii of rings around the plot, in half edges.
constexpr std::array<double, 6> RINGS{1.0, 1.25, 1.7, 2.8, 6.0, 24.0};
constexpr int RING_SIDE = 32;  // quads along a side of a ring

// It is painted once per process.
const std::vector<Image>& sharedGrain() {
  static const std::vector<Image> grain = mipmaps(grainPicture(GRAIN_EDGE));
  return grain;
}

VertexPaint plainPaint(const Rgba& colour, float u, float v) {
  VertexPaint out{{0.f, 0.f, 1.f}, {0, 0, 0, 255}, {u, v, 1.f}};
  for (std::size_t i = 0; i < 3; ++i)
    out.colour[i] = static_cast<std::uint8_t>(std::clamp(colour[i], 0.f, 1.f) * 255.f + 0.5f);
  return out;
}

void addVertex(const Vec3& at, const VertexPaint& paint, std::vector<float>& positions,
               std::vector<VertexPaint>& paints) {
  for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(at[i]));
  paints.push_back(paint);
}

// Returns the triangles of a grid of (columns + 1) x (rows + 1) vertices, facing up.
std::vector<std::uint32_t> gridTriangles(std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
      out.insert(out.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  return out;
}

// Returns point i of 4 * RING_SIDE on the border of the square [-1, 1]^2, counter-clockwise.
std::array<double, 2> onSquare(int i) {
  const int side = (i / RING_SIDE) % 4;
  const double along = 2.0 * (i % RING_SIDE) / RING_SIDE - 1.0;
  if (side == 0) return {along, -1.0};
  if (side == 1) return {1.0, along};
  if (side == 2) return {-along, 1.0};
  return {-1.0, -along};
}

}  // namespace

GroundVisual::GroundVisual(Ogre::SceneNode& parent, const Land& land, const Daylight& daylight)
    : node_(parent.createChildSceneNode()),
      plot_texture_(uniqueName("ground_picture"), mipmaps(land.picture)),
      plain_texture_(uniqueName("plain_picture"), {Image(1, 1, {1.f, 1.f, 1.f, 1.f})}),
      grain_texture_(uniqueName("grain_picture"), sharedGrain()),
      plot_material_(Material::Kind::GROUND, uniqueName("plot_material"),
                     {plot_texture_.name(), grain_texture_.name()}),
      land_material_(Material::Kind::GROUND, uniqueName("land_material"),
                     {plain_texture_.name(), grain_texture_.name()}) {
  const Vec3& origin = land.origin;
  node_->setPosition(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                     static_cast<float>(origin.z()));
  addPlot(land);
  addLand(land, daylight);
}

GroundVisual::~GroundVisual() {
  batches_.clear();
  node_->getCreator()->destroySceneNode(node_);
}

void GroundVisual::light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze) {
  plot_material_.light(daylight, to_sun, haze);
  land_material_.light(daylight, to_sun, haze);
}

void GroundVisual::add(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
                       const std::vector<std::uint32_t>& triangles, const std::string& material) {
  batches_.push_back(std::make_unique<Batch>(uniqueName("ground"), material));
  batches_.back()->build(positions, paint, triangles, 0.f);
  batches_.back()->setRank(Batch::LAST_RANK);  // trees hide most of it
  node_->attachObject(batches_.back().get());
  triangles_ += triangles.size() / 3;
}

void GroundVisual::addPlot(const Land& land) {
  const Plot& plot = land.plot;
  const terrain::HeightMap& terrain = land.terrain;
  // The borders of tiles coincide with the points of the surrounding ring.
  const double tile = plot.edge / TILES;
  constexpr int STEP = RING_SIDE / TILES;
  const int times = std::max(1, static_cast<int>(std::lround(tile / land.cell / STEP)));
  const int cells = terrain.isFlat() ? STEP : std::min(MOST_TILE_CELLS, STEP * times);
  for (int t = 0; t < TILES * TILES; ++t) {
    std::vector<float> positions;
    std::vector<VertexPaint> paint;
    for (int r = 0; r <= cells; ++r) {
      for (int c = 0; c <= cells; ++c) {
        const double u = (t % TILES + static_cast<double>(c) / cells) / TILES;
        const double v = (t / TILES + static_cast<double>(r) / cells) / TILES;
        const double x = plot.x + plot.edge * u, y = plot.y + plot.edge * v;
        addVertex(
            Vec3(x, y, terrain.height(x, y)) - land.origin,
            plainPaint({1.f, 1.f, 1.f, 1.f}, static_cast<float>(u), static_cast<float>(1.0 - v)),
            positions, paint);
      }
    }
    const auto n = static_cast<std::uint32_t>(cells);
    add(positions, paint, gridTriangles(n, n), plot_material_.name());
  }
}

void GroundVisual::addLand(const Land& land, const Daylight& daylight) {
  const Plot& plot = land.plot;
  const terrain::HeightMap& terrain = land.terrain;
  const Noise noise(0x6a55);
  const double half = 0.5 * plot.edge;
  Rgba mean{};
  int count = 0;
  std::vector<float> positions;
  std::vector<VertexPaint> paint;
  for (const double ring : RINGS) {
    for (int i = 0; i <= 4 * RING_SIDE; ++i) {
      const std::array<double, 2> on = onSquare(i);
      const double x = plot.x + half * (1.0 + ring * on[0]);
      const double y = plot.y + half * (1.0 + ring * on[1]);
      Rgba colour = groundColour(noise, x, y, 0.0, land.tint);
      mean = mix(mean, colour, 1.f / static_cast<float>(++count));
      // Patches of colour on these distant points would become long streaks.
      colour = mix(colour, mean, static_cast<float>(smoothStep((ring - 1.1) / 1.2)));
      const Rgba light = openLight(daylight, terrain.normal(x, y));
      for (std::size_t k = 0; k < 3; ++k) colour[k] *= light[k];
      // The outer ring has the colour of the horizon, so that no edge shows.
      colour = mix(colour, daylight.horizon, static_cast<float>(smoothStep((ring - 2.8) / 21.2)));
      addVertex(Vec3(x, y, terrain.height(x, y)) - land.origin, plainPaint(colour, 0.f, 0.f),
                positions, paint);
    }
  }
  // Rings run counter-clockwise and outwards, so their winding is opposite to that of a grid.
  std::vector<std::uint32_t> triangles = gridTriangles(4 * RING_SIDE, RINGS.size() - 1);
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i], triangles[i + 1]);
  add(positions, paint, triangles, land_material_.name());
}

std::unique_ptr<GroundVisual> plainGround(Ogre::SceneNode& parent, const Plot& plot,
                                          const Shade& shade, const terrain::HeightMap& terrain,
                                          const Daylight& daylight, const Rgba& tint) {
  const Image picture =
      groundPicture(plot, PLAIN_EDGE, wholePlot(PLAIN_EDGE), shade, terrain, daylight, tint);
  const double x = plot.x + 0.5 * plot.edge, y = plot.y + 0.5 * plot.edge;
  Land land{plot, picture, terrain, Vec3(x, y, terrain.height(x, y)), 1.0, tint};
  if (!terrain.isFlat()) land.cell = terrain.resolution();
  return std::make_unique<GroundVisual>(parent, land, daylight);
}

}  // namespace vegetation_sim::view
