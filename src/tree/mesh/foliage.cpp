// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tree/growth/golden_angle.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr double SQRT_HALF = 0.70710678118654752440;
constexpr double LARGEST_PREFERENCE = 1.6;

enum Draw : std::uint64_t { KEPT, PLACE, AZIMUTH, ANGLE, TURN, SIZE, SHADE, FLUTTER };

// Orientation of clusters of one shape on their branch [rad].
struct LeafHabit {
  double least_angle, largest_angle;  // between the midrib and the branch
  double turn;                        // +- about the midrib
  double inner;                       // preference for innermost leaves when some are omitted
  bool hangs;                         // boughs hang straight down
};
constexpr std::array<LeafHabit, 4> HABITS{{{0.4, 1.3, 1.2, 0.4, false},     // broad
                                           {0.45, 0.9, 0.9, 0.9, false},    // needle
                                           {0.6, 1.5, 1.4, 0.4, false},     // small
                                           {0.15, 0.55, 1.4, 0.4, true}}};  // long

// Returns the rotation about an axis, from cosine and sine of half the angle.
Quat aboutX(double angle) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, half.sin, 0.0, 0.0};
}
Quat aboutY(double angle) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, 0.0, half.sin, 0.0};
}
Quat aboutZ(double angle) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, 0.0, 0.0, half.sin};
}

// Returns the shortest rotation of the y axis to a unit direction.
Quat turnYTo(const Vec3& d) {
  const Quat sum{1.0 + d.y(), d.z(), 0.0, -d.x()};  // 1 + y . d, y x d
  const double norm = std::sqrt(sum.w * sum.w + sum.x * sum.x + sum.z * sum.z);
  if (norm < 1e-6) return {0.0, 0.0, 0.0, 1.0};  // opposite direction: half a turn
  return {sum.w / norm, sum.x / norm, 0.0, sum.z / norm};
}

class Foliage {
 public:
  Foliage(const Skeleton& skeleton, const Species& species, const TreeMeshDetail& detail)
      : skeleton_(skeleton),
        species_(species),
        detail_(detail),
        habit_(HABITS[static_cast<std::size_t>(species.leaf_shape)]) {
    double sum = 0.0, leaves = 1e-9;
    for (const Branch& branch : skeleton.branches) {
      sum += branch.leaves * branch.length;
      leaves += branch.leaves;
    }
    mean_leafy_length_ = std::max(sum / leaves, 1e-3);
    // A young tree has smaller clusters, though not in proportion.
    leaf_scale_ = std::sqrt(skeleton.trunk_radius / species.trunk_radius);
  }

  // Returns the number of cards that show clusters, which come first.
  std::size_t place(std::vector<LeafCard>& out) const {
    std::vector<LeafCard> boughs;
    for (std::size_t i = 0; i < skeleton_.branches.size(); ++i) {
      const Branch& branch = skeleton_.branches[i];
      const MeshDetail& detail = detail_.of(static_cast<int>(i));
      for (int l = 0; l < branch.leaves; ++l) {
        const Random random = Random(branch.key).child(static_cast<std::uint64_t>(l));
        // The cheap test comes first: at low levels nearly all are omitted.
        if (random.uniform(KEPT) >= detail.leaf_fraction * LARGEST_PREFERENCE) continue;
        LeafCard leaf = card(static_cast<int>(i), l, detail, random);
        if (random.uniform(KEPT) >= detail.leaf_fraction * preference(leaf, detail)) continue;
        if (branch.depth >= detail.depths) carryToDrawn(leaf, detail, random);
        (detail.boughs ? boughs : out).push_back(leaf);
      }
    }
    const std::size_t clusters = out.size();
    out.insert(out.end(), boughs.begin(), boughs.end());
    return clusters;
  }

 private:
  const Branch& at(int i) const { return skeleton_.branches[static_cast<std::size_t>(i)]; }

  static void setRotation(const Quat& q, LeafCard& leaf) {
    leaf.rotation = {narrow(q.w), narrow(q.x), narrow(q.y), narrow(q.z)};
  }

  LeafCard card(int branch, int number, const MeshDetail& detail, const Random& random) const {
    const Branch& b = at(branch);
    LeafCard out;
    out.branch = branch;
    const double f = (number + random.uniform(PLACE)) / b.leaves;
    out.local = {0.f, 0.f, narrow(b.length * f)};
    // About z to its side, down from the branch about x, then about its own midrib.
    const double side = GOLDEN_ANGLE * number + random.uniform(AZIMUTH, -0.6, 0.6);
    const double angle = random.uniform(ANGLE, habit_.least_angle, habit_.largest_angle);
    setRotation(aboutZ(side) * aboutX(-angle) * Quat{SQRT_HALF, SQRT_HALF, 0.0, 0.0} *
                    aboutY(random.uniform(TURN, -habit_.turn, habit_.turn)),
                out);
    if (hangs(detail)) setRotation(conjugate(b.rest.orientation) * hanging(random), out);
    // Short branches, as at the tip of a cone, have small clusters.
    const double fit = std::clamp(std::sqrt(b.length / mean_leafy_length_), 0.4, 1.25);
    out.size = narrow(species_.leaf_size * leaf_scale_ * detail.leaf_growth * fit *
                      random.uniform(SIZE, 0.8, 1.2));
    out.shade = narrow(shadeAt(tipOf(b, b.rest), random.uniform(SHADE)));
    out.key = static_cast<std::uint32_t>(random.bits(FLUTTER));
    return out;
  }

  // Far away, boughs of some species are drawn hanging straight down.
  bool hangs(const MeshDetail& detail) const { return detail.boughs && habit_.hangs; }

  // In the tree's frame: midrib down, any way round.
  static Quat hanging(const Random& random) {
    return aboutZ(random.uniform(AZIMUTH, -PI, PI)) *
           aboutX(-0.5 * PI + random.uniform(ANGLE, -0.15, 0.15));
  }

  // Outer leaves hide those inside the crown, which are omitted first.
  double preference(const LeafCard& leaf, const MeshDetail& detail) const {
    if (detail.leaf_fraction >= 1.0) return LARGEST_PREFERENCE;
    return habit_.inner + 2.0 * (1.0 - habit_.inner) * static_cast<double>(leaf.shade);
  }

  // A card on a branch that is not drawn is fixed to the nearest drawn ancestor at its rest pose:
  // joints without vertices are then not posed either (S1-09). A piece of which nothing is drawn
  // has its cards on its first branch.
  void carryToDrawn(LeafCard& leaf, const MeshDetail& detail, const Random& random) const {
    int root = leaf.branch;  // the lowest ancestor that is not drawn
    while (at(root).parent >= 0 && at(at(root).parent).depth >= detail.depths)
      root = at(root).parent;
    const int holder = std::max(at(root).parent, 0);
    const Pose& from = at(leaf.branch).rest;
    const Pose& to = at(holder).rest;
    Vec3 place = from.position + static_cast<double>(leaf.local[2]) * axisZ(from.orientation);
    Quat turn = from.orientation *
                Quat{leaf.rotation[0], leaf.rotation[1], leaf.rotation[2], leaf.rotation[3]};
    if (detail.boughs) rootBough(at(root).rest.position, random, place, turn, leaf);
    const Quat back = conjugate(to.orientation);
    const Vec3 local = rotate(back, place - to.position);
    leaf.branch = holder;
    leaf.local = {narrow(local.x()), narrow(local.y()), narrow(local.z())};
    setRotation(back * turn, leaf);
  }

  // A bough replaces the omitted limb: it starts near the limb's joint and points along it, so that
  // no leaves float.
  void rootBough(const Vec3& sprout, const Random& random, Vec3& place, Quat& turn,
                 LeafCard& leaf) const {
    const Vec3 along = place - sprout;
    const double way = length(along);
    place = sprout + 0.4 * along;
    leaf.size = std::clamp(narrow(1.1 * way), leaf.size, 1.4f * leaf.size);
    if (habit_.hangs || way < 1e-3) return;
    turn = turnYTo(along / way) * aboutY(random.uniform(AZIMUTH, -PI, PI)) *
           aboutX(random.uniform(ANGLE, -0.8, 0.8));
  }

  // Outer and upper leaves are young and light, those near the trunk old and dark.
  double shadeAt(const Vec3& p, double noise) const {
    const double out = std::sqrt(p.x() * p.x() + p.y() * p.y()) / std::max(skeleton_.reach, 0.1);
    const double up = p.z() / std::max(skeleton_.height, 0.1);
    return saturate(0.55 * out * out + 0.45 * up * up + 0.16 * (noise - 0.5));
  }

  const Skeleton& skeleton_;
  const Species& species_;
  const TreeMeshDetail& detail_;
  const LeafHabit& habit_;
  double mean_leafy_length_{1.0};  // [m]
  double leaf_scale_{1.0};
};

}  // namespace

std::size_t placeLeaves(const Skeleton& skeleton, const Species& species,
                        const TreeMeshDetail& detail, std::vector<LeafCard>& out) {
  return Foliage(skeleton, species, detail).place(out);
}

std::array<float, 2> leafFlutter(std::uint32_t key, double seconds, double wind_speed,
                                 double largest) {
  // Two incommensurate tones per axis: no visible repetition, and each has zero mean.
  const double a = (key & 0xff) / 256.0, b = ((key >> 8) & 0xff) / 256.0;
  const double rate = 1.2 + 1.1 * ((key >> 16) & 0xff) / 256.0;  // [Hz]
  const double amplitude = largest * wind_speed / (wind_speed + 5.0);
  const double t = seconds * rate;
  return {narrow(amplitude * (0.6 * sinCosTurns(t + a).sin + 0.4 * sinCosTurns(1.618 * t + b).sin)),
          narrow(0.6 * amplitude *
                 (0.6 * sinCosTurns(0.79 * t + b).sin + 0.4 * sinCosTurns(1.27 * t + a).sin))};
}

}  // namespace vegetation_sim::forest
