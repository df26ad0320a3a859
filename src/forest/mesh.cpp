// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/common/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr int FEWEST_SIDES = 3;
constexpr double GOLDEN_ANGLE = 2.399963229728653;  // pi (3 - sqrt 5)

constexpr double LARGEST_PREFERENCE = 1.6;

enum Draw : std::uint64_t { KEPT, PLACE, AZIMUTH, ANGLE, TURN, SIZE, SHADE, FLUTTER };

// How clusters of one shape stand on their branch [rad].
struct LeafHabit {
  double least_angle, largest_angle;  // between the midrib and the branch
  double turn;                        // +- about the midrib
  bool hangs;                         // boughs hang straight down
};
constexpr std::array<LeafHabit, 4> HABITS{{{0.4, 1.3, 1.2, false},     // broad
                                           {0.45, 0.9, 0.9, false},    // needle
                                           {0.6, 1.5, 1.4, false},     // small
                                           {0.15, 0.55, 1.4, true}}};  // long

float narrow(double x) {
  return static_cast<float>(x);
}

class MeshBuilder {
 public:
  MeshBuilder(const Skeleton& skeleton, const Species& species, const MeshDetail& detail)
      : skeleton_(skeleton), species_(species), detail_(detail) {
    double sum = 0.0, leaves = 1e-9;
    for (const Branch& branch : skeleton.branches) {
      sum += branch.leaves * branch.length;
      leaves += branch.leaves;
    }
    mean_leafy_length_ = std::max(sum / leaves, 1e-3);
    // A young tree has smaller clusters, though not in proportion.
    if (!skeleton.branches.empty())
      leaf_scale_ = std::sqrt(skeleton.branches[0].base_radius / species.trunk_radius);
  }

  TreeMesh build() {
    for (std::size_t i = 0; i < skeleton_.branches.size(); ++i) {
      const Branch& branch = skeleton_.branches[i];
      if (branch.depth >= detail_.depths) break;
      const bool first =
          branch.parent < 0 ||
          skeleton_.branches[static_cast<std::size_t>(branch.parent)].next != static_cast<int>(i);
      if (first) addLimb(static_cast<int>(i));
    }
    addLeaves();
    out_.boughs = detail_.boughs;
    return std::move(out_);
  }

 private:
  const Branch& at(int i) const { return skeleton_.branches[static_cast<std::size_t>(i)]; }

  // A tube along the limb: a ring at the base of each branch (of some where there are more than
  // the detail allows sections) and one at the tip.
  void addLimb(int first) {
    const int sides = std::max(FEWEST_SIDES, detail_.trunk_sides - 4 * at(first).depth);
    int segments = 0;
    for (int i = first; i >= 0; i = at(i).next) ++segments;
    const int sections = std::min(segments, std::max(1, detail_.sections));
    double along = 0.0;
    int last = first;
    for (int i = first, s = 0; i >= 0; i = at(i).next, ++s) {
      if (i == first) {
        addFoot(i, sides);
      } else if (s * sections / segments != (s - 1) * sections / segments) {
        addRing(i, 0.0, at(i).base_radius, along, sides);
        joinRings(sides);
      }
      along += at(i).length;
      last = i;
    }
    addRing(last, at(last).length, at(last).tip_radius, along, sides);
    joinRings(sides);
  }

  // The trunk stands in the ground, so that no slope shows its end, and flares above its roots.
  void addFoot(int branch, int sides) {
    const double radius = at(branch).base_radius;
    if (at(branch).parent >= 0) return addRing(branch, 0.0, radius, 0.0, sides);
    addRing(branch, -3.0 * radius, 1.9 * radius, -3.0 * radius, sides);
    if (sides < 5) return;
    addRing(branch, 0.0, 1.5 * radius, 0.0, sides);
    joinRings(sides);
    addRing(branch, 1.2 * radius, 1.12 * radius, 1.2 * radius, sides);
    joinRings(sides);
    addRing(branch, 3.0 * radius, radius, 3.0 * radius, sides);
    joinRings(sides);
  }

  void addRing(int branch, double z, double radius, double along, int sides) {
    const double roll = at(branch).roll;
    for (int s = 0; s <= sides; ++s) {  // the first point twice, for the texture's seam
      const SinCos a = sinCos(roll + 2.0 * PI * (s % sides) / sides);
      BarkVertex v;
      v.branch = branch;
      v.local = {narrow(radius * a.cos), narrow(radius * a.sin), narrow(z)};
      v.normal = {narrow(a.cos), narrow(a.sin), 0.f};
      v.uv = {narrow(static_cast<double>(s) / sides), narrow(along)};
      out_.bark.push_back(v);
    }
  }

  void joinRings(int sides) {
    const auto ring = static_cast<std::uint32_t>(sides) + 1;
    const auto upper = static_cast<std::uint32_t>(out_.bark.size()) - ring, lower = upper - ring;
    for (std::uint32_t s = 0; s + 1 < ring; ++s) {
      const std::uint32_t a = lower + s, b = a + 1, c = upper + s, d = c + 1;
      out_.triangles.insert(out_.triangles.end(), {a, b, d, a, d, c});
    }
  }

  // Fewer clusters are a subset of more: a card is kept if its own number is below the fraction.
  void addLeaves() {
    for (std::size_t i = 0; i < skeleton_.branches.size(); ++i) {
      const Branch& branch = skeleton_.branches[i];
      for (int l = 0; l < branch.leaves; ++l) {
        const Random random = Random(branch.key).child(static_cast<std::uint64_t>(l));
        // Cheap first: at low levels nearly all are left out.
        if (random.uniform(KEPT) >= detail_.leaf_fraction * LARGEST_PREFERENCE) continue;
        LeafCard leaf = card(static_cast<int>(i), l, random);
        if (random.uniform(KEPT) >= detail_.leaf_fraction * preference(leaf)) continue;
        carryToDrawn(leaf);
        out_.leaves.push_back(leaf);
      }
    }
  }

  LeafCard card(int branch, int number, const Random& random) const {
    const Branch& b = at(branch);
    const LeafHabit& habit = HABITS[static_cast<std::size_t>(species_.leaf_shape)];
    LeafCard out;
    out.branch = branch;
    const double f = (number + random.uniform(PLACE)) / b.leaves;
    out.local = {0.f, 0.f, narrow(b.length * f)};
    const SinCos t = sinCos(0.5 * (GOLDEN_ANGLE * number + random.uniform(AZIMUTH, -0.6, 0.6)));
    const SinCos p = sinCos(0.5 * random.uniform(ANGLE, habit.least_angle, habit.largest_angle));
    const SinCos r = sinCos(0.5 * random.uniform(TURN, -habit.turn, habit.turn));
    if (hangs()) {
      setRotation(conjugate(b.rest.orientation) * hanging(random), out);
      return finished(b, random, out);
    }
    // About z to its side, down from the branch about x, then about its own midrib.
    const Quat q = Quat{t.cos, 0.0, 0.0, t.sin} * Quat{p.cos, -p.sin, 0.0, 0.0} *
                   Quat{SQRT_HALF, SQRT_HALF, 0.0, 0.0} * Quat{r.cos, 0.0, r.sin, 0.0};
    setRotation(q, out);
    return finished(b, random, out);
  }

  // Far away, boughs that hang are drawn hanging straight down.
  bool hangs() const {
    return detail_.boughs && HABITS[static_cast<std::size_t>(species_.leaf_shape)].hangs;
  }

  // Where the limb of a branch leaves its bearer, at rest.
  Vec3 sproutOf(int branch) const {
    while (at(branch).parent >= 0 && at(at(branch).parent).next == branch)
      branch = at(branch).parent;
    return at(branch).rest.position;
  }

  // In the tree's frame: midrib down, any way round.
  static Quat hanging(const Random& random) {
    const SinCos t = sinCos(0.5 * random.uniform(AZIMUTH, -PI, PI));
    const SinCos p = sinCos(-0.25 * PI + 0.5 * random.uniform(ANGLE, -0.15, 0.15));
    return Quat{t.cos, 0.0, 0.0, t.sin} * Quat{p.cos, p.sin, 0.0, 0.0};
  }

  static void setRotation(const Quat& q, LeafCard& leaf) {
    leaf.rotation = {narrow(q.w), narrow(q.x), narrow(q.y), narrow(q.z)};
  }

  LeafCard finished(const Branch& b, const Random& random, LeafCard leaf) const {
    // Short branches, as at the tip of a cone, bear small clusters.
    const double fit = std::clamp(std::sqrt(b.length / mean_leafy_length_), 0.4, 1.25);
    leaf.size = narrow(species_.leaf_size * leaf_scale_ * detail_.leaf_growth * fit *
                       random.uniform(SIZE, 0.8, 1.2));
    leaf.shade = narrow(shadeAt(tipOf(b, b.rest), random.uniform(SHADE)));
    leaf.key = static_cast<std::uint32_t>(random.bits(FLUTTER));
    return leaf;
  }

  // Leaves inside the crown are hidden by those outside: they are the first to be left out.
  double preference(const LeafCard& leaf) const {
    if (detail_.leaf_fraction >= 1.0) return LARGEST_PREFERENCE;
    return std::min(LARGEST_PREFERENCE, 0.4 + 1.3 * static_cast<double>(leaf.shade));
  }

  // A card on a branch that is not drawn is fixed to the nearest one below that is, where it was at
  // rest: joints that no vertex needs are then not posed either (S1-09).
  void carryToDrawn(LeafCard& leaf) const {
    int bearer = leaf.branch;
    while (at(bearer).depth >= detail_.depths) bearer = at(bearer).parent;
    if (bearer == leaf.branch) return;
    const Pose& from = at(leaf.branch).rest;
    const Pose& to = at(bearer).rest;
    const Quat back = conjugate(to.orientation);
    Vec3 place = from.position + static_cast<double>(leaf.local[2]) * axisZ(from.orientation);
    if (hangs()) place += 0.5 * (sproutOf(leaf.branch) - place);  // not in mid-air
    const Vec3 local = rotate(back, place - to.position);
    const Quat q = back * from.orientation *
                   Quat{leaf.rotation[0], leaf.rotation[1], leaf.rotation[2], leaf.rotation[3]};
    leaf.branch = bearer;
    leaf.local = {narrow(local.x()), narrow(local.y()), narrow(local.z())};
    setRotation(q, leaf);
  }

  // Outer and upper leaves are young and light, those near the trunk old and dark.
  double shadeAt(const Vec3& p, double noise) const {
    const double out = std::sqrt(p.x() * p.x() + p.y() * p.y()) / std::max(skeleton_.reach, 0.1);
    const double up = p.z() / std::max(skeleton_.height, 0.1);
    return saturate(0.55 * out * out + 0.45 * up * up + 0.16 * (noise - 0.5));
  }

  static constexpr double SQRT_HALF = 0.70710678118654752440;

  const Skeleton& skeleton_;
  const Species& species_;
  const MeshDetail& detail_;
  double mean_leafy_length_{1.0};  // [m]
  double leaf_scale_{1.0};
  TreeMesh out_;
};

}  // namespace

TreeMesh buildMesh(const Skeleton& skeleton, const Species& species, const MeshDetail& detail) {
  return MeshBuilder(skeleton, species, detail).build();
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
