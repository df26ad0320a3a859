// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/bark_mesh.h"

#include <algorithm>
#include <cmath>

#include "tree/mesh/foliage.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr int FEWEST_SIDES = 3;

// Clusters of the four shapes, then their boughs: 48 to 86 % of the square, because pixels without
// leaves cost as much as others. One percent of the leaves is cut off.
constexpr std::array<LeafOutline, 8> OUTLINES{
    {{{{0.14f, 0.14f}, {0.94f, 0.01f}, {0.75f, 1.00f}, {0.23f, 1.00f}}},
     {{{0.12f, 0.08f}, {1.00f, 0.04f}, {0.84f, 0.96f}, {0.03f, 0.90f}}},
     {{{0.08f, 0.16f}, {0.84f, 0.01f}, {0.80f, 0.99f}, {0.22f, 1.00f}}},
     {{{0.31f, 0.06f}, {0.69f, 0.00f}, {0.83f, 1.00f}, {0.16f, 0.90f}}},
     {{{0.15f, 0.00f}, {0.95f, 0.00f}, {0.87f, 1.00f}, {0.00f, 0.99f}}},
     {{{0.09f, 0.11f}, {1.00f, 0.00f}, {0.71f, 0.98f}, {0.14f, 0.83f}}},
     {{{0.03f, 0.01f}, {1.00f, 0.00f}, {0.79f, 1.00f}, {0.00f, 0.96f}}},
     {{{0.09f, 0.05f}, {1.00f, 0.10f}, {0.82f, 0.98f}, {0.00f, 0.92f}}}}};

class MeshBuilder {
 public:
  MeshBuilder(const Skeleton& skeleton, const Species& species, const TreeMeshDetail& detail)
      : skeleton_(skeleton), species_(species), detail_(detail) {}

  TreeMesh build() {
    const int depths = detail_.depths();
    for (std::size_t i = 0; i < skeleton_.branches.size(); ++i) {
      const Branch& branch = skeleton_.branches[i];
      if (branch.depth >= depths) break;
      if (branch.broken || branch.depth >= detail_.of(static_cast<int>(i)).depths) continue;
      const bool first =
          branch.parent < 0 ||
          skeleton_.branches[static_cast<std::size_t>(branch.parent)].next != static_cast<int>(i);
      if (first) addLimb(static_cast<int>(i));
    }
    out_.clusters = placeLeaves(skeleton_, species_, detail_, out_.leaves);
    out_.shape = species_.leaf_shape;
    return std::move(out_);
  }

 private:
  const Branch& at(int i) const { return skeleton_.branches[static_cast<std::size_t>(i)]; }

  // A tube along the limb: a ring at the base of each branch (of some where there are more than
  // the detail allows sections) and one at the tip.
  void addLimb(int first) {
    const MeshDetail& detail = detail_.of(first);
    const int sides = std::max(FEWEST_SIDES, detail.trunk_sides - 4 * at(first).depth);
    int segments = 0;
    for (int i = first; i >= 0; i = at(i).next) ++segments;
    const int sections = std::min(segments, std::max(1, detail.sections));
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

  // The trunk extends into the ground, so that no slope shows its end, and flares above its roots.
  void addFoot(int branch, int sides) {
    const double radius = at(branch).base_radius;
    if (at(branch).parent >= 0 || !skeleton_.rooted)
      return addRing(branch, 0.0, radius, 0.0, sides);
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

  const Skeleton& skeleton_;
  const Species& species_;
  const TreeMeshDetail& detail_;
  TreeMesh out_;
};

}  // namespace

const LeafOutline& leafOutline(LeafShape shape, bool boughs) {
  return OUTLINES[static_cast<std::size_t>(shape) + (boughs ? 4 : 0)];
}

TreeMesh buildMesh(const Skeleton& skeleton, const Species& species, const TreeMeshDetail& detail) {
  return MeshBuilder(skeleton, species, detail).build();
}

TreeMesh buildMesh(const Skeleton& skeleton, const Species& species, const MeshDetail& detail) {
  return buildMesh(skeleton, species, TreeMeshDetail{detail, {}, {}});
}

}  // namespace vegetation_sim::forest
