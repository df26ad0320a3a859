// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/crown.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

/// Ball about the middle of the twigs; leaves far from its centre get more light.
struct Ball {
  explicit Ball(const std::vector<Twig>& twigs) {
    for (const Twig& twig : twigs) centre += twig.pose.position / static_cast<double>(twigs.size());
    for (const Twig& twig : twigs)
      radius = std::max(radius, length(Vec3(twig.pose.position - centre)) + twig.length);
  }
  double light(const Vec3& place) const {
    const Vec3 out = (place - centre) / std::max(radius, 1e-9);
    return saturate(0.5 + 0.4 * length(out) + 0.25 * out.z());
  }
  Vec3 centre{Vec3::Zero()};
  double radius{0.0};
};

Leaf leafOn(const Twig& twig, const PlantKind& kind, const Random& random, const Ball& ball) {
  Leaf out;
  const double along = twig.length * random.uniform(1);
  out.root = out.anchor = twig.pose.position + rotate(twig.pose.orientation, Vec3(0.0, 0.0, along));
  const SinCos around = sinCosTurns(random.uniform(2));
  const double lean = random.uniform(3, 0.1, 0.8), size = random.uniform(4, 0.65, 1.35);
  const Vec3 way = rotate(twig.pose.orientation, Vec3(around.cos, around.sin, lean));
  const Vec3 hanging = way + Vec3(0.0, 0.0, random.uniform(5, -0.7, 0.2));
  const double norm = std::max(1e-9, length(hanging));
  out.tip = out.root + hanging * (size * kind.leaf_length / norm);
  const Vec3 flat(random.uniform(6, -0.6, 0.6), random.uniform(7, -0.6, 0.6), 1.0);
  const Vec3 across = cross(hanging, flat);
  out.side = across * (0.5 * size * kind.leaf_width / std::max(1e-9, length(across)));
  out.root_width = 0.9F;
  out.tip_width = 0.25F;
  const double tone = random.uniform(8);
  out.light = static_cast<float>(ball.light(out.root));
  out.shade =
      static_cast<float>(saturate(0.2 * static_cast<double>(out.light) + 0.7 * tone * tone));
  return out;
}

}  // namespace

std::vector<CrownLeaf> growCrown(const PlantKind& kind, std::uint64_t seed,
                                 const std::vector<Twig>& rest) {
  std::vector<double> sums;
  sums.reserve(rest.size());
  double sum = 0.0;
  for (const Twig& twig : rest) sums.push_back(sum += twig.share);
  std::vector<CrownLeaf> out;
  if (!(sum > 0.0)) return out;
  const Ball ball(rest);
  const Random random(seed);
  for (int i = 0; i < kind.leaves; ++i) {
    const Random own = random.child(static_cast<std::uint64_t>(i));
    const auto found = std::upper_bound(sums.begin(), sums.end(), sum * own.uniform(0));
    const auto twig = static_cast<std::size_t>(std::min(found, sums.end() - 1) - sums.begin());
    out.push_back({static_cast<std::uint32_t>(twig), leafOn(rest[twig], kind, own, ball)});
  }
  return out;
}

MovedLeaf carry(const Foliage& foliage, const CrownLeaf& leaf, const Pose& rest, const Pose& now) {
  const Quat& back = rest.orientation;
  const Quat turn = now.orientation * Quat{back.w, -back.x, -back.y, -back.z};
  const Vec3 root = now.position + rotate(turn, Vec3(leaf.leaf.root - rest.position));
  const Vec3 along = rotate(turn, Vec3(leaf.leaf.tip - leaf.leaf.root));
  const double size = length(along);
  const Vec3 moved = foliage.freeDisplacement(leaf.leaf.anchor, leaf.leaf.root, REACH * size);
  const Vec3 side = twisted(foliage.warp(), along, rotate(turn, leaf.leaf.side), moved);
  return {root, root + along + bent(along, moved), side};  // the length of the leaf is constant
}

}  // namespace vegetation_sim::canopy
