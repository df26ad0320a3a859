// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Batched blades as triangles. The traits of a blade are computed from the position of its root, so
// that no random number is drawn twice.

#include <algorithm>
#include <cmath>

#include "grass/blades/blade_placement.h"
#include "grass/mesh/mesh_writer.h"

namespace vegetation_sim::grass {
namespace {

constexpr float STUBBLE_PALENESS = 0.3f;  ///< stems are drier than leaves
constexpr float STUBBLE_SHADE = 0.4f;     ///< part of the shade of neighbours that stubble has
constexpr float HALF_HIDDEN = 0.12f;      ///< cut grass that hides half of what is below [kg/m^2]
constexpr int PETALS = 6;                 ///< corners of a flower around its middle

struct Float3 {
  float x, y, z;
};
constexpr Float3 HAY{0.66f, 0.60f, 0.33f};
Float3 operator+(const Float3& a, const Float3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Float3 operator-(const Float3& a, const Float3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Float3 operator*(const Float3& a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
Float3 narrow(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// Returns the unit vector across `along` that turns a ribbon's face to the viewer.
Float3 sideOf(const Float3& along, const Float3& view) {
  const Float3 c{along.y * view.z - along.z * view.y, along.z * view.x - along.x * view.z,
                 along.x * view.y - along.y * view.x};
  const float square = c.x * c.x + c.y * c.y + c.z * c.z;
  return square > 1e-20f ? c * (1.f / std::sqrt(square)) : Float3{1.f, 0.f, 0.f};
}

// Returns which of the six points a ribbon of this many segments keeps.
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

// Returns the vector from a root at (x, y) of its tile to the nearest edge.
Float3 wayToEdge(float x, float y, float size) {
  const float east = size - x, north = size - y, least = std::min({x, east, y, north});
  if (x == least) return {-x, 0.f, 0.f};
  if (east == least) return {east, 0.f, 0.f};
  return {0.f, y == least ? -y : north, 0.f};
}

std::uint8_t byteOfUnit(float part) {
  constexpr float HALF = 0.5f;  // for rounding, since std::lround would call the library
  return static_cast<std::uint8_t>(255.f * std::min(1.f, std::max(0.f, part)) + HALF);
}

/// Writes into reserved memory of a mesh.
struct Writer {
  float* position;
  float* texture;
  std::uint8_t* colour;
  std::uint32_t* index;
  std::uint32_t next;  ///< index of the next vertex

  void vertex(const Float3& p, float u, float v, const Float3& c) {
    position[0] = p.x, position[1] = p.y, position[2] = p.z;
    texture[0] = u, texture[1] = v;
    colour[0] = byteOfUnit(c.x), colour[1] = byteOfUnit(c.y), colour[2] = byteOfUnit(c.z);
    colour[3] = 255;
    position += 3, texture += 2, colour += 4, ++next;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    index[0] = a, index[1] = b, index[2] = c;
    index += 3;
  }
};

template <class T>
T* grow(std::vector<T>& list, std::size_t by) {
  list.resize(list.size() + by);
  return list.data() + (list.size() - by);
}

/// All blades of a tile.
class Ribbons {
 public:
  Ribbons(const FeatureMap& map, const Tile& tile, const RibbonStyle& style, const Vec3& origin)
      : tile_(tile),
        style_(style),
        corner_(narrow(Vec3(tile.x, tile.y, tile.z) - origin)),
        eye_(narrow(style.eye - origin)),
        plan_(tile, TileMotion()),
        colour_(tile.colour),
        kept_(keptPoints(style.segments)) {
    for (const SpeciesInput& s : map.species()) {
      const Float3 fresh = narrow(s.species.colour), dry = narrow(s.species.dry_colour);
      looks_.push_back({fresh, dry - fresh, narrow(s.species.flower_colour),
                        static_cast<float>(0.5 * s.species.width * style.width),
                        static_cast<float>(s.species.flower_radius * cubeRoot(style.width))});
    }
  }

  void append(const BladeBlock* blocks, int count, GrassMesh& mesh) {
    const auto n = static_cast<std::size_t>(style_.segments);
    kinds_.resize(static_cast<std::size_t>(count));
    flowers_.resize(static_cast<std::size_t>(count));
    std::size_t flowers = 0;
    for (int blade = 0; blade < count; ++blade) {
      const int kind = kindOf(blocks[blade / BLOCK], blade);
      kinds_[static_cast<std::size_t>(blade)] = kind;
      flowers_[static_cast<std::size_t>(blade)] =
          isCut(blocks[blade / BLOCK], blade) ? 0.f : looks_[static_cast<std::size_t>(kind)].flower;
      flowers += flowers_[static_cast<std::size_t>(blade)] > 0.f ? 1 : 0;
    }
    const auto blades = static_cast<std::size_t>(count);
    const std::size_t vertices = blades * (2 * n + 1) + flowers * (PETALS + 1);
    const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
    Writer out{grow(mesh.positions, 3 * vertices), grow(mesh.texture, 2 * vertices),
               grow(mesh.colours, 4 * vertices),
               grow(mesh.indices, 3 * (blades * (2 * n - 1) + flowers * PETALS)), first};
    const auto leaving = static_cast<float>(style_.leaving * count);
    for (int blade = 0; blade < count; ++blade) {
      const auto left = static_cast<float>(count - blade);
      write(blocks[blade / BLOCK], blade, left < leaving ? left / leaving : 1.f, out);
    }
  }

 private:
  struct Look {
    Float3 fresh, drying, petal;
    float half, flower;  ///< half the width at the root, radius of the flower [m]
  };

  struct Cut {
    bool is_cut;
    float hidden;  ///< share that is below cut grass
  };

  int kindOf(const BladeBlock& block, int blade) const {
    if (!plan_.mixed) return 0;
    const int lane = blade % BLOCK;
    const float u = block.x[0][lane] / tile_.size, v = block.y[0][lane] / tile_.size;
    const auto last = static_cast<std::size_t>(tile_.species_count - 1);
    const float aim = BladeRandom<float>(tile_.key, blade).kind() * plan_.shares[last].at(u, v);
    int kind = 0;
    for (std::size_t s = 1; s <= last; ++s)
      if (aim > plan_.shares[s - 1].at(u, v)) kind = static_cast<int>(s);
    return kind;
  }

  bool isCut(const BladeBlock& block, int blade) const { return cutAt(block, blade).is_cut; }
  Cut cutAt(const BladeBlock& block, int blade) const {
    if (!style_.crush || style_.crush->cut.empty()) return {false, 0.f};
    const int lane = blade % BLOCK;
    const std::size_t node =
        style_.crush->nearest(block.x[0][lane] / tile_.size, block.y[0][lane] / tile_.size);
    const float swath = style_.crush->swath[node];
    return {style_.crush->cut[node] < UNCUT, swath / (swath + HALF_HIDDEN)};
  }

  void write(const BladeBlock& block, int blade, float width, Writer& out) const {
    const int lane = blade % BLOCK;
    const float x = block.x[0][lane], y = block.y[0][lane];
    Float3 shift = corner_;
    if (style_.slide > 0.0)
      shift = shift + wayToEdge(x, y, tile_.size) * static_cast<float>(style_.slide);
    const auto point = [&](int k) {
      const auto i = static_cast<std::size_t>(k);
      return Float3{block.x[i][lane], block.y[i][lane], block.z[i][lane]} + shift;
    };
    const Look& look = looks_[static_cast<std::size_t>(kinds_[static_cast<std::size_t>(blade)])];
    const Float3 root = point(0), tip = point(LINKS);
    const Float3 side = sideOf(tip - root, eye_ - root);
    // Lightness and dryness vary, since blades of one colour look like plastic.
    const std::uint32_t dice =
        mix32(static_cast<std::uint32_t>(blade) ^ static_cast<std::uint32_t>(tile_.key >> 32));
    const float chance = static_cast<float>(dice & 0xffff) / 65535.f;
    const float facing = std::fabs(static_cast<float>(dice >> 16) / 32768.f - 1.f);
    const Cut cut = cutAt(block, blade);
    const float pale = cut.is_cut ? STUBBLE_PALENESS : 0.f;
    const float dry = colour_.at(x / tile_.size, y / tile_.size) +
                      style_.variety * (0.35f * chance * chance - 0.06f);
    Float3 own = (look.fresh + look.drying * std::min(1.f, std::max(0.f, dry + pale))) *
                 (1.f + style_.variety * 0.34f * (chance - 0.5f));
    own = own + (HAY - own) * cut.hidden;
    const std::uint32_t first = out.next;
    for (int k = 0; k <= style_.segments; ++k) {
      const int at = kept_[static_cast<std::size_t>(k)];
      const float way = static_cast<float>(at) / LINKS,
                  half = width * look.half * (1.f - way * way);
      const Float3 p = point(at);
      const Float3 c =
          shaded(own, p, root, cut.is_cut ? 1.f - STUBBLE_SHADE * (1.f - way) : way, facing);
      if (k == style_.segments) {
        out.vertex(p, 0.5f, 1.f, c);
        break;
      }
      out.vertex(p - side * half, 0.f, way, c);
      out.vertex(p + side * half, 1.f, way, c);
    }
    for (std::uint32_t t = 0; t + 1 < 2 * static_cast<std::uint32_t>(style_.segments); ++t)
      out.triangle(first + t, first + t + 1, first + t + 2);
    const float radius = flowers_[static_cast<std::size_t>(blade)];
    if (radius > 0.f) flower(tip, side, width * radius, look, out);
  }

  // Without light a blade is dark at the root, where neighbours shade it.
  Float3 shaded(const Float3& own, const Float3& p, const Float3& root, float way,
                float facing) const {
    if (!style_.light) return own * (0.45f + 0.55f * way);
    const Float3 lean = p - root, view = p - eye_;
    const float flat = std::sqrt(lean.x * lean.x + lean.y * lean.y);
    const float long_way = std::sqrt(flat * flat + lean.z * lean.z);
    const float far = std::sqrt(view.x * view.x + view.y * view.y);
    BladePiece piece;
    piece.flat = long_way > 1e-6f ? flat / long_way : 0.f;
    piece.facing = facing;
    piece.way = way;
    if (flat > 1e-6f && far > 1e-6f)
      piece.away = (lean.x * view.x + lean.y * view.y) / (flat * far);
    piece.flat *= piece.flat;
    const PieceLight l = lightOn(*style_.light, piece);
    return {own.x * l.factor[0] + l.shine[0], own.y * l.factor[1] + l.shine[1],
            own.z * l.factor[2] + l.shine[2]};
  }

  // Adds a disc that faces half upwards and half to the viewer.
  void flower(const Float3& tip, const Float3& side, float r, const Look& look, Writer& out) const {
    const Float3 across{side.x * r, side.y * r, side.z * r};
    const Float3 up = Float3{-side.y * 0.5f, side.x * 0.5f, 0.8f} * r;
    const Float3 light = style_.light ? shaded(look.petal, tip, tip, 1.f, 0.8f) : look.petal;
    const std::uint32_t first = out.next;
    constexpr std::array<std::array<float, 2>, PETALS> CORNERS{
        {{-1.f, 0.f}, {-0.5f, -0.8f}, {0.5f, -0.8f}, {1.f, 0.f}, {0.5f, 0.8f}, {-0.5f, 0.8f}}};
    // Pale flowers have a yellow centre, others a dark one.
    const bool pale = std::min({look.petal.x, look.petal.y, look.petal.z}) > 0.6f;
    out.vertex(tip, 0.5f, 0.5f, pale ? Float3{0.95f, 0.75f, 0.15f} : light * 0.35f);
    for (const auto& corner : CORNERS)
      out.vertex(tip + across * corner[0] + up * corner[1], 0.5f + 0.5f * corner[0],
                 0.5f + 0.5f * corner[1], light * (0.9f + 0.1f * corner[1]));
    for (std::uint32_t k = 0; k < PETALS; ++k)
      out.triangle(first, first + 1 + k, first + 1 + (k + 1) % PETALS);
  }

  const Tile& tile_;
  const RibbonStyle& style_;
  Float3 corner_, eye_;
  TilePlan<float> plan_;
  Bilinear<float> colour_;
  std::array<int, POINTS> kept_;
  std::vector<Look> looks_;
  std::vector<int> kinds_;      ///< species of each blade
  std::vector<float> flowers_;  ///< radius of the flower of each blade, 0: none [m]
};

}  // namespace

void appendRibbons(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks, int count,
                   const RibbonStyle& style, GrassMesh& mesh) {
  if (count > 0) Ribbons(map, tile, style, mesh.origin).append(blocks, count, mesh);
}

}  // namespace vegetation_sim::grass
