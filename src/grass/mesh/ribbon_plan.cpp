// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/mesh/ribbon_plan.h"

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {
namespace {

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

}  // namespace

RibbonPlan::RibbonPlan(const FeatureMap& map, const Tile& drawn, const RibbonStyle& drawing,
                       const Vec3& origin)
    : tile(drawn),
      style(drawing),
      corner(toFloat3(Vec3(drawn.x, drawn.y, drawn.z) - origin)),
      eye(toFloat3(drawing.eye - origin)),
      plan(drawn, TileMotion()),
      colour(drawn.colour),
      kept(keptPoints(drawing.segments)) {
  if (drawn.sloped) {
    const auto n = static_cast<std::size_t>(drawn.ground_cells), last = n * (n + 1);
    const std::vector<float>& g = drawn.ground;
    slope_x = 0.5f * (g[n] - g[0] + g[last + n] - g[last]) / drawn.size;
    slope_y = 0.5f * (g[last] - g[0] + g[last + n] - g[n]) / drawn.size;
  }
  for (const SpeciesInput& s : map.species()) {
    const Float3 fresh = toFloat3(s.species.colour), dry = toFloat3(s.species.dry_colour);
    looks.push_back({fresh, dry - fresh, toFloat3(s.species.flower_colour),
                     static_cast<float>(0.5 * s.species.width * style.width),
                     static_cast<float>(s.species.flower_radius * cubeRoot(style.width))});
  }
}

bool RibbonPlan::hasFlowers() const {
  return std::any_of(looks.begin(), looks.end(),
                     [](const RibbonLook& look) { return look.flower > 0.f; });
}

Float3 shadeRibbon(const RibbonPlan& plan, const Float3& own, const Float3& p, const Float3& root,
                   float way, float facing) {
  if (!plan.style.light) return own * (0.45f + 0.55f * way);
  const Float3 lean = p - root, view = p - plan.eye;
  const float flat = std::sqrt(lean.x * lean.x + lean.y * lean.y);
  const float long_way = std::sqrt(flat * flat + lean.z * lean.z);
  const float far = std::sqrt(view.x * view.x + view.y * view.y);
  BladePiece piece;
  piece.flat = long_way > 1e-6f ? flat / long_way : 0.f;
  piece.facing = facing;
  piece.way = way;
  if (flat > 1e-6f && far > 1e-6f) piece.away = (lean.x * view.x + lean.y * view.y) / (flat * far);
  piece.flat *= piece.flat;
  const PieceLight l = lightOn(*plan.style.light, piece);
  return {own.x * l.factor[0] + l.shine[0], own.y * l.factor[1] + l.shine[1],
          own.z * l.factor[2] + l.shine[2]};
}

float tipSize(const RibbonPlan& plan, const RibbonTip& tip) {
  constexpr std::uint32_t HEADS = 62500;         // of 65536: random numbers above have a seed head
  constexpr float LEAST_LENGTH = 0.18f;          // [m] of blades with a seed head
  constexpr float HEAD = 0.09f;                  // half its length per length of the blade
  constexpr float SMALL = 0.65f, RANGE = 0.35f;  // factor of the radius of flowers
  const float radius = plan.looks[static_cast<std::size_t>(tip.kind)].flower;
  if (!(radius > 0.f)) {
    const bool has_head = (tip.dice & 0xffffU) > HEADS && tip.length > LEAST_LENGTH;
    return has_head ? -HEAD * std::min(1.f, tip.length) : 0.f;
  }
  // Sums of waves make drifts of some metres, different ones for each species.
  const float x = tip.x + static_cast<float>(plan.tile.x) + 17.f * static_cast<float>(tip.kind);
  const float y = tip.y + static_cast<float>(plan.tile.y) + 5.f * static_cast<float>(tip.kind);
  const double bend_y = 1.2 * sinCos(double{0.57f * y + 1.f}).sin;
  const double bend_x = 1.3 * sinCos(double{0.66f * x}).sin;
  const auto wave = static_cast<float>(sinCos(double{0.85f * x} + bend_y).sin +
                                       sinCos(double{0.94f * y} + bend_x).sin);
  const float chance = static_cast<float>(tip.dice & 0xffffU) / 65535.f;
  if (chance > 0.10f + std::max(0.f, wave - 0.1f)) return 0.f;
  return radius * (SMALL + RANGE * static_cast<float>(tip.dice >> 24) / 255.f);
}

namespace {

// Adds a spindle around the tip of a blade. @param r half its length [m].
void writeSeedHead(const RibbonPlan& plan, const Float3& tip, const Float3& below,
                   const Float3& side, float r, std::uint32_t dice, MeshPlaces& out) {
  constexpr Float3 PALE{0.66f, 0.57f, 0.36f}, BROWN{0.52f, 0.41f, 0.28f};
  constexpr float THICKNESS = 0.17f;
  constexpr std::array<std::array<float, 2>, PETALS> CORNERS{
      {{0.f, -1.f}, {0.8f, -0.4f}, {0.9f, 0.1f}, {0.f, 1.f}, {-0.9f, 0.1f}, {-0.8f, -0.4f}}};
  const Float3 way = tip - below;
  const float size = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
  const Float3 along = size > 1e-6f ? way * (r / size) : Float3{0.f, 0.f, r};
  const Float3 across = side * (r * THICKNESS);
  const Float3 own = PALE + (BROWN - PALE) * (static_cast<float>(dice >> 24) / 255.f);
  const Float3 light = plan.style.light ? shadeRibbon(plan, own, tip, below, 1.f, 0.6f) : own;
  const std::uint32_t first = out.next;
  out.vertex(tip, 0.5f, 0.5f, light);
  for (const auto& corner : CORNERS)
    out.vertex(tip + across * corner[0] + along * corner[1], 0.5f + 0.5f * corner[0],
               0.5f + 0.5f * corner[1], light * (0.85f + 0.15f * corner[1]));
  for (std::uint32_t k = 0; k < PETALS; ++k)
    out.triangle(first, first + 1 + k, first + 1 + (k + 1) % PETALS);
}

}  // namespace

void writeTip(const RibbonPlan& plan, const Float3& tip, const Float3& below, const Float3& side,
              float r, std::uint32_t dice, const RibbonLook& look, MeshPlaces& out) {
  if (r < 0.f) return writeSeedHead(plan, tip, below, side, -r, dice, out);
  Float3 across{side.x * r, side.y * r, side.z * r};
  Float3 up = Float3{-side.y * 0.5f, side.x * 0.5f, 0.8f} * r;
  if (plan.isVaried()) {
    const float tilt = static_cast<float>(dice >> 16 & 0xffU) / 255.f;
    const float roll = static_cast<float>(dice >> 8 & 0xffU) / 127.5f - 1.f;
    const float away = 0.95f - 0.5f * tilt;
    up = Float3{-side.y * away, side.x * away, 0.2f + 0.55f * tilt} * r;
    across.z += 0.5f * roll * r;
  }
  const Float3 light =
      plan.style.light ? shadeRibbon(plan, look.petal, tip, tip, 1.f, 0.8f) : look.petal;
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

}  // namespace vegetation_sim::grass
