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

void writeFlower(const RibbonPlan& plan, const Float3& tip, const Float3& side, float r,
                 const RibbonLook& look, MeshPlaces& out) {
  const Float3 across{side.x * r, side.y * r, side.z * r};
  const Float3 up = Float3{-side.y * 0.5f, side.x * 0.5f, 0.8f} * r;
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
