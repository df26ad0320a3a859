// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/swath.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double FALL_SHARE = 0.25;  // of the height of the end of a ribbon, along the fall
constexpr double SPREAD = 0.6;       // of the directions of ribbons [rad]
constexpr double BEND = 0.15;        // of a ribbon per piece [rad]
constexpr double SCATTER = 0.12;     // across the fall [m]
constexpr double LOWEST = 0.003;     // [m]
constexpr double DRY = 0.4;          // part of the way to the lightest colour
constexpr float DEEP_LIGHT = 0.5F;   // daylight at the bottom of the layer

enum SwathPart : std::uint64_t { SWATH = 3ULL << 40 };
enum SwathDraw : std::uint64_t { DIRECTION, OFFSET, ROLL, LAYER, LIFT, CURVE = LIFT + 64 };

Vec3 ahead(double angle) {
  const SinCos at = sinCos(angle);
  return {at.cos, at.sin, 0.0};
}

/// Lays the ribbons of one plant.
class SwathLayer {
 public:
  SwathLayer(const PlantKind& kind, const Plant& plant, std::vector<Leaf>& out)
      : random_(Random(plant.seed).child(SWATH)),
        foot_(plant.position),
        reach_(0.5 * plant.scale *
               (kind.shape == PlantShape::STALK ? kind.leaf_length : kind.height)),
        falls_(isRibbon(kind)),
        fall_(2.0 * PI * random_.uniform(DIRECTION)),
        out_(out) {}

  // Lays a ribbon from its last piece, of the number `last`, on: so a second cut that is lower
  // moves none of what lies.
  void lay(const FallenLeaf* begin, const FallenLeaf* end, std::size_t last) {
    const Random random = random_.child(last);
    double angle = falls_ ? fall_ + random.uniform(DIRECTION, -SPREAD, SPREAD)
                          : 2.0 * PI * random.uniform(DIRECTION);
    Vec3 at = endOf(end[-1].leaf, angle, random);
    const double half = length(end[-1].leaf.side);  // of all its pieces; widths are shares of it
    const double tilt = half > 0.0 ? std::min(0.3, 0.25 * SWATH_HEIGHT / half) : 0.0;
    const SinCos roll = sinCos(random.uniform(ROLL, -tilt, tilt));
    const double least = LOWEST + half * std::fabs(roll.sin), room = SWATH_HEIGHT - 2.0 * least;
    double lift = random.uniform(LAYER);
    for (const FallenLeaf* piece = end; piece-- != begin;) {
      const auto number = static_cast<std::uint64_t>(end - piece);
      Leaf leaf = piece->leaf;
      const double size = length(leaf.tip - leaf.root);
      const double most = std::min(0.2, 0.5 * size / SWATH_HEIGHT);
      const double next = saturate(lift + random.uniform(LIFT + number, -most, most));
      const double rise = (next - lift) * room;
      const Vec3 way = ahead(angle);
      leaf.tip = at + (least + lift * room) * Vec3::UnitZ();
      at -= std::sqrt(std::max(0.0, size * size - rise * rise)) * way;
      leaf.root = at + (least + next * room) * Vec3::UnitZ();
      leaf.anchor = Vec3(at.x(), at.y(), foot_.z());
      leaf.lies = true;
      leaf.side =
          length(leaf.side) * (roll.cos * Vec3(-way.y(), way.x(), 0.0) + roll.sin * Vec3::UnitZ());
      leaf.shade += static_cast<float>(DRY) * (1.0F - leaf.shade);
      leaf.light = DEEP_LIGHT + (1.0F - DEEP_LIGHT) * static_cast<float>(0.5 * (lift + next));
      out_.push_back(leaf);
      angle += random.uniform(CURVE + number, -BEND, BEND);
      lift = next;
    }
    std::reverse(out_.end() - (end - begin), out_.end());
  }

 private:
  // Returns where the tip of a ribbon comes to lie.
  Vec3 endOf(const Leaf& last, double angle, const Random& random) const {
    Vec3 out(last.root.x(), last.root.y(), foot_.z());
    if (!falls_) return out + 0.5 * length(last.tip - last.root) * ahead(angle);
    return out + FALL_SHARE * (last.root.z() - foot_.z()) * ahead(fall_) + reach_ * ahead(angle) +
           random.uniform(OFFSET, -SCATTER, SCATTER) * ahead(fall_ + 0.5 * PI);
  }

  Random random_;
  Vec3 foot_;
  double reach_;  // half the length of a ribbon [m]
  bool falls_;
  double fall_;  // [rad]
  std::vector<Leaf>& out_;
};

}  // namespace

void layDown(const PlantKind& kind, const Plant& plant, const std::vector<FallenLeaf>& fallen,
             std::vector<Leaf>& leaves) {
  SwathLayer layer(kind, plant, leaves);
  for (std::size_t i = 0; i < fallen.size();) {
    std::size_t end = i + 1;
    while (end < fallen.size() && fallen[end].leaf.root == fallen[end - 1].leaf.tip) ++end;
    layer.lay(fallen.data() + i, fallen.data() + end, fallen[end - 1].number);
    i = end;
  }
}

}  // namespace vegetation_sim::canopy
