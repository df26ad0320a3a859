// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Strips and layers of tiles that are too far away for single blades.

#include <algorithm>
#include <array>
#include <cmath>

#include "grass/blades/blade_placement.h"
#include "grass/mesh/mesh_writer.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::grass {
namespace {

// The grass of a tile as one continuous sheet: the motion of the middle of a blade at each place.
class Sheet {
 public:
  Sheet(const FeatureMap& map, const Tile& tile, const TileMotion& motion, double full_density,
        const Vec3& origin)
      : tile_(tile),
        corner_(Vec3(tile.x, tile.y, tile.z) - origin),
        full_density_(full_density),
        density_(tile.density),
        height_(tile.height),
        crush_(motion.crush && motion.crush->cells > 0 ? motion.crush : nullptr) {
    double compliance = 0.0;
    for (int s = 0; s < tile.species_count; ++s)
      compliance +=
          double{tile.species[static_cast<std::size_t>(s)].compliance} / tile.species_count;
    Corners bend_x, bend_y;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 air(double{motion.wind_x[i]}, double{motion.wind_y[i]}, 0.0);
      const Point bend = bendIn(air, compliance);
      bend_x[i] = static_cast<float>(bend.x);
      bend_y[i] = static_cast<float>(bend.y);
      colours_[i] = cornerColour(map, i);
    }
    bend_x_ = Bilinear<double>(bend_x);
    bend_y_ = Bilinear<double>(bend_y);
  }

  Vec3 groundAt(double u, double v) const {
    const double size = double{tile_.size};
    return corner_ + Vec3(u * size, v * size, groundHeight(u, v));
  }

  // Returns the offset of the top of grass of this height by wind and tread, without stretching.
  Vec3 offsetAt(double u, double v, double height) const {
    const Point bend{bend_x_.at(u, v), bend_y_.at(u, v)};
    double tilt = 0.0, tx = 0.0, ty = 0.0;
    if (crush_) {
      const std::size_t i = nodeOf(u, v);
      tilt = double{crush_->tilt[i]};
      tx = double{crush_->tx[i]};
      ty = double{crush_->ty[i]};
    }
    // The chord of an arc leans half as far as its tip.
    const double left = 0.5 * (1.0 - tilt / BEND_LIMIT);
    const double x = tx + left * bend.x, y = ty + left * bend.y, lean = std::sqrt(x * x + y * y);
    const SineCosine<double> turn = sineCosine(std::min(lean, BEND_LIMIT));
    const double reach = lean > 0.0 ? height * turn.sin / lean : 0.0;
    return {reach * x, reach * y, height * turn.cos};
  }

  double heightAt(double u, double v) const {
    const double height = height_.at(u, v);
    if (!crush_ || crush_->cut.empty()) return height;
    return std::min(height, double{crush_->cut[nodeOf(u, v)]});
  }
  // Returns the colour of grass that leans by `offset` in this light.
  Vec3 litAt(double u, double v, const Vec3& offset, const GrassLight* light) const {
    Vec3 own = colourAt(u, v);
    if (!light) return own;
    const double flat = offset.x() * offset.x() + offset.y() * offset.y();
    BladePiece piece;
    piece.flat = static_cast<float>(flat / std::max(flat + offset.z() * offset.z(), 1e-12));
    const PieceLight l = lightOn(*light, piece);
    Vec3 out;
    for (int i = 0; i < 3; ++i)
      out[i] = own[i] * static_cast<double>(l.factor[i]) + static_cast<double>(l.shine[i]);
    return out;
  }

  // Strips of stubble would look like a net, so there are the fewer the lower it is.
  double coverAt(double u, double v) const {
    const double cover = saturate(density_.at(u, v) / full_density_), height = height_.at(u, v);
    return heightAt(u, v) < height ? cover * heightAt(u, v) / height : cover;
  }

  // Interpolates the colours of the corners.
  Vec3 colourAt(double u, double v) const {
    return (1.0 - v) * ((1.0 - u) * colours_[0] + u * colours_[1]) +
           v * ((1.0 - u) * colours_[2] + u * colours_[3]);
  }

 private:
  Vec3 cornerColour(const FeatureMap& map, std::size_t corner) const {
    const int k = static_cast<int>(corner);
    Features f = map.node(tile_.column + k % 2, tile_.row + k / 2);
    f.colour = double{tile_.colour[corner]};  // includes masks
    return farColour(map, f);
  }
  std::size_t nodeOf(double u, double v) const {
    const auto column = static_cast<std::size_t>(std::lround(u * crush_->cells));
    const auto row = static_cast<std::size_t>(std::lround(v * crush_->cells));
    return row * static_cast<std::size_t>(crush_->cells + 1) + column;
  }

  double groundHeight(double u, double v) const {
    if (!tile_.sloped) return 0.0;
    const int n = tile_.ground_cells;
    const int column = std::min(static_cast<int>(u * n), n - 1);
    const int row = std::min(static_cast<int>(v * n), n - 1);
    const float* low = tile_.ground.data() + row * (n + 1) + column;
    const float* high = low + n + 1;
    const double p = u * n - column, q = v * n - row;
    return (low[0] * (1 - p) + low[1] * p) * (1 - q) + (high[0] * (1 - p) + high[1] * p) * q;
  }

  const Tile& tile_;
  Vec3 corner_;
  double full_density_;
  Bilinear<double> density_, height_, bend_x_, bend_y_;
  const CrushPatch* crush_;
  std::array<Vec3, 4> colours_;  ///< colours of the corners, along x first
};

// A row of vertical lines, each joined to the one before.
class Fence {
 public:
  Fence(GrassMesh& mesh, int rows, int cells)
      : writer_(mesh, 2 * std::size_t(rows) * (std::size_t(cells) + 1),
                2 * std::size_t(rows) * std::size_t(cells)) {}
  void add(const Vec3& bottom, const Vec3& offset, double along, const Vec3& colour, double cover,
           bool is_first) {
    const std::uint32_t low = writer_.vertex(bottom, along, 0.0, colour, cover);
    writer_.vertex(bottom + offset, along, 1.0, colour, cover);
    if (is_first) return;
    writer_.triangle(low - 2, low, low + 1);
    writer_.triangle(low - 2, low + 1, low - 1);
  }

 private:
  MeshWriter writer_;
};

}  // namespace

void appendStrips(const FeatureMap& map, const Tile& tile, const TileMotion& motion, double grown,
                  double full_density, GrassMesh& mesh, const GrassLight* light) {
  const Sheet sheet(map, tile, motion, full_density, mesh.origin);
  Fence fence(mesh, 4, STRIP_CELLS);
  const Point starts[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int edge = 0; edge < 4; ++edge) {
    const Point a = starts[edge], b = starts[(edge + 1) % 4];
    for (int k = 0; k <= STRIP_CELLS; ++k) {
      const double s = static_cast<double>(k) / STRIP_CELLS;
      const double u = a.x + s * (b.x - a.x), v = a.y + s * (b.y - a.y);
      const Vec3 bottom = sheet.groundAt(u, v);
      const Vec3 offset = sheet.offsetAt(u, v, grown * sheet.heightAt(u, v));
      fence.add(bottom, offset, s * double{tile.size} / PICTURE_WIDTH,
                sheet.litAt(u, v, offset, light), sheet.coverAt(u, v), k == 0);
    }
  }
}

void appendRows(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int rows,
                double grown, double full_density, GrassMesh& mesh, const GrassLight* light) {
  constexpr int CELLS = 3;
  const Sheet sheet(map, tile, motion, full_density, mesh.origin);
  const Random random = Random(tile.key).child(1);
  Fence fence(mesh, 2 * rows, CELLS);
  for (int line = 0; line < 2 * rows; ++line) {
    const auto word = static_cast<std::uint64_t>(line) * (CELLS + 2);
    const double shift = random.uniform(word + CELLS + 1);
    const int row = line / 2;
    for (int k = 0; k <= CELLS; ++k) {
      const double aside = random.uniform(word + static_cast<std::uint64_t>(k), -0.45, 0.45);
      const double along = static_cast<double>(k) / CELLS;
      const double across = saturate((row + 0.5 + aside) / rows);
      const double u = line % 2 ? across : along, v = line % 2 ? along : across;
      const Vec3 bottom = sheet.groundAt(u, v);
      const Vec3 offset = sheet.offsetAt(u, v, grown * sheet.heightAt(u, v));
      const double s = shift + along * double{tile.size} / PICTURE_WIDTH;
      fence.add(bottom, offset, s, sheet.litAt(u, v, offset, light), sheet.coverAt(u, v), k == 0);
    }
  }
}

void appendLayers(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int layers,
                  double grown, double full_density, GrassMesh& mesh, const GrassLight* light) {
  const Sheet sheet(map, tile, motion, full_density, mesh.origin);
  const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
  MeshWriter writer(mesh, 4 * static_cast<std::size_t>(layers),
                    2 * static_cast<std::size_t>(layers));
  for (int layer = 1; layer <= layers; ++layer) {
    const double share = static_cast<double>(layer) / layers;
    // The lowest layer shows all blades, so the ground has the same cover for any number of layers.
    const double below = static_cast<double>(layer - 1) / layers;
    const std::uint32_t base = first + 4 * static_cast<std::uint32_t>(layer - 1);
    for (int corner = 0; corner < 4; ++corner) {
      const int side = corner / 2;
      const double u = corner % 2, v = side;
      const Vec3 top = sheet.offsetAt(u, v, grown * sheet.heightAt(u, v));
      // The bend of an arc grows with the square of the height.
      const Vec3 place = sheet.groundAt(u, v) +
                         Vec3(top.x() * share * share, top.y() * share * share, top.z() * share);
      const double size = double{tile.size} / PICTURE_WIDTH;
      const Vec3 colour = sheet.litAt(u, v, top, light) * (0.45 + 0.55 * share);
      writer.vertex(place, u * size, v * size, colour, sheet.coverAt(u, v) * (1.0 - 0.6 * below));
    }
    writer.triangle(base, base + 1, base + 3);
    writer.triangle(base, base + 3, base + 2);
  }
}

}  // namespace vegetation_sim::grass
