// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/swath.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double FALL_SHARE = 0.4;  // of the height of a ribbon above the cut, along the fall
constexpr double SPREAD = 0.6;      // of the directions of ribbons [rad]
constexpr double BEND = 0.15;       // of a ribbon per piece [rad]
constexpr double SCATTER = 0.12;    // across the fall [m]
constexpr double LOWEST = 0.003;    // [m]
constexpr double DRY = 0.4;         // part of the way to the lightest colour
constexpr float DEEP_LIGHT = 0.5F;  // daylight at the bottom of the layer

enum SwathPart : std::uint64_t { SWATH = 3ULL << 40 };
enum SwathDraw : std::uint64_t { DIRECTION, OFFSET, ROLL, LAYER, LIFT, CURVE = LIFT + 64 };

Vec3 ahead(double angle) {
  const SinCos at = sinCos(angle);
  return {at.cos, at.sin, 0.0};
}

/// Lays the ribbons of one plant.
class SwathLayer {
 public:
  SwathLayer(const PlantKind& kind, const Plant& plant, double height, std::vector<Leaf>& out)
      : random_(Random(plant.seed).child(SWATH)),
        foot_(plant.position),
        cut_(plant.position.z() + height),
        falls_(isRibbon(kind)),
        fall_(2.0 * PI * random_.uniform(DIRECTION)),
        out_(out) {}

  // `last` numbers the last piece, which stays the same when the plant is cut again lower down.
  void lay(const FallenLeaf* begin, const FallenLeaf* end, std::size_t last) {
    const Random random = random_.child(last);
    double angle = falls_ ? fall_ + random.uniform(DIRECTION, -SPREAD, SPREAD)
                          : 2.0 * PI * random.uniform(DIRECTION);
    Vec3 at = middleOf(begin->leaf.root, random);
    double size = 0.0;
    for (const FallenLeaf* piece = begin; piece != end; ++piece)
      size += length(piece->leaf.tip - piece->leaf.root);
    at -= 0.5 * size * ahead(angle);
    double lift = random.uniform(LAYER);
    for (const FallenLeaf* piece = begin; piece != end; ++piece) {
      const auto number = static_cast<std::uint64_t>(piece - begin);
      Leaf leaf = piece->leaf;
      const double half = length(leaf.side) * std::max(leaf.root_width, leaf.tip_width);
      const double tilt = half > 0.0 ? std::min(0.3, 0.25 * SWATH_HEIGHT / half) : 0.0;
      const SinCos roll = sinCos(random.uniform(ROLL, -tilt, tilt));
      const double next = saturate(lift + random.uniform(LIFT + number, -0.2, 0.2));
      const auto raised = [&](double share) {
        const double least = LOWEST + half * std::fabs(roll.sin);
        return least + share * std::max(0.0, SWATH_HEIGHT - 2.0 * least);
      };
      const Vec3 way = ahead(angle);
      leaf.root = at + raised(lift) * Vec3::UnitZ();
      at += length(piece->leaf.tip - piece->leaf.root) * way;
      leaf.tip = at + raised(next) * Vec3::UnitZ();
      leaf.anchor = Vec3(leaf.root.x(), leaf.root.y(), foot_.z());
      leaf.lies = true;
      leaf.side =
          length(leaf.side) * (roll.cos * Vec3(-way.y(), way.x(), 0.0) + roll.sin * Vec3::UnitZ());
      leaf.shade += static_cast<float>(DRY) * (1.0F - leaf.shade);
      leaf.light = DEEP_LIGHT + (1.0F - DEEP_LIGHT) * static_cast<float>(0.5 * (lift + next));
      out_.push_back(leaf);
      angle += random.uniform(CURVE + number, -BEND, BEND);
      lift = next;
    }
  }

 private:
  Vec3 middleOf(const Vec3& root, const Random& random) const {
    Vec3 out(root.x(), root.y(), foot_.z());
    if (falls_)
      out += FALL_SHARE * std::max(0.0, root.z() - cut_) * ahead(fall_) +
             random.uniform(OFFSET, -SCATTER, SCATTER) * ahead(fall_ + 0.5 * PI);
    return out;
  }

  Random random_;
  Vec3 foot_;
  double cut_;  // height of the cut, world [m]
  bool falls_;
  double fall_;  // [rad]
  std::vector<Leaf>& out_;
};

}  // namespace

void layDown(const PlantKind& kind, const Plant& plant, double height,
             const std::vector<FallenLeaf>& fallen, std::vector<Leaf>& leaves) {
  SwathLayer layer(kind, plant, height, leaves);
  for (std::size_t i = 0; i < fallen.size();) {
    std::size_t end = i + 1;
    while (end < fallen.size() && fallen[end].leaf.root == fallen[end - 1].leaf.tip) ++end;
    layer.lay(fallen.data() + i, fallen.data() + end, fallen[end - 1].number);
    i = end;
  }
}

}  // namespace vegetation_sim::canopy
