// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/paint.h"

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr double THICK =
    0.4;  // fraction of the trunk's radius from which wood has the colour of bark
constexpr double BRIGHTNESS = 0.12;  // +- from tree to tree
constexpr double WARMTH = 0.09;      // +- red against blue

Colour tinted(const Vec3& colour, double brightness, double warmth) {
  return {static_cast<float>(saturate(colour.x() * brightness * (1.0 + warmth))),
          static_cast<float>(saturate(colour.y() * brightness)),
          static_cast<float>(saturate(colour.z() * brightness * (1.0 - warmth)))};
}

}  // namespace

Colour mixColours(const Colour& a, const Colour& b, double weight_of_b) {
  const auto w = static_cast<float>(weight_of_b);
  return {a[0] + (b[0] - a[0]) * w, a[1] + (b[1] - a[1]) * w, a[2] + (b[2] - a[2]) * w};
}

TreePaint::TreePaint(const Species& species, std::uint64_t tree_seed)
    : thin_(species.twig_radius), thick_(THICK * species.trunk_radius) {
  const Random random = Random(tree_seed).child(0x7061696e74);
  const double brightness = 1.0 + random.uniform(0, -BRIGHTNESS, BRIGHTNESS);
  const double warmth = random.uniform(1, -WARMTH, WARMTH);
  leaf_old_ = tinted(species.leaf_colour, brightness, warmth);
  leaf_young_ = tinted(species.leaf_colour_young, brightness, warmth);
  bark_ = tinted(species.bark_colour, 1.0 + 0.5 * (brightness - 1.0), 0.3 * warmth);
  twig_ = tinted(species.twig_colour, 1.0, 0.3 * warmth);
}

Colour TreePaint::bark(double radius) const {
  return mixColours(twig_, bark_, smoothStep((radius - thin_) / (thick_ - thin_ + 1e-9)));
}

Colour TreePaint::leaf(const LeafCard& card) const {
  // The bits of the key vary the colour of neighbouring clusters.
  const double own = 0.1 * (static_cast<double>(card.key & 0xffff) / 65536.0 - 0.5);
  return mixColours(leaf_old_, leaf_young_, saturate(card.shade + own));
}

}  // namespace vegetation_sim::forest
