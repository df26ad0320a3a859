// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/canopy_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t POINTS_PER_LEAF = 6, POINTS_PER_STEM = 12;
constexpr std::size_t SHADE_EDGES = 12, POINTS_PER_SHADE = 3 * SHADE_EDGES;
constexpr double SHADE_HEIGHT = 0.012;  // [m] over the ground, so that it is not hidden
constexpr double LEAST_SHARE = 0.125;   // of a plant's leaves, over an even share of the points
constexpr double DARK_ROOT = 0.6;       // light at a leaf's root over that at its tip

Vec3 leafColour(const canopy::PlantKind& kind, const canopy::Leaf& leaf) {
  const double young = leaf.shade, light = leaf.light;
  return light * (kind.colour * (1.0 - young) + kind.colour_young * young);
}

std_msgs::ColorRGBA darkened(std_msgs::ColorRGBA colour, double light) {
  const auto share = static_cast<float>(light);
  colour.r *= share;
  colour.g *= share;
  colour.b *= share;
  return colour;
}

/// Adds a strip with two corners at the root and two at the tip.
void addStrip(TriangleLists& lists, std::size_t list, const std::array<Vec3, 4>& corner,
              const std_msgs::ColorRGBA& at_root, const std_msgs::ColorRGBA& at_tip) {
  for (const std::size_t i : {0, 1, 2, 2, 1, 3})
    lists.add(list, corner[i], i < 2 ? at_root : at_tip);
}

std::array<Vec3, 4> cornersOf(const canopy::Leaf& leaf, const canopy::MovedLeaf& moved) {
  const Vec3 low = static_cast<double>(leaf.root_width) * moved.side;
  const Vec3 high = static_cast<double>(leaf.tip_width) * moved.side;
  return {moved.root - low, moved.root + low, moved.tip - high, moved.tip + high};
}

// Rigid faces of a mesh are counted as stems.
std::size_t movingLeaves(const canopy::PlantKind& kind) {
  const std::size_t rigid = kind.form ? kind.form->rigid.size() : 0;
  return canopy::leafCount(kind) - (isRead(kind) ? rigid : 0);
}

std::size_t leavesOf(const canopy::Layout& layout, const canopy::CrownRule& rule) {
  return static_cast<std::size_t>(rule.trees) *
         static_cast<std::size_t>(layout.kinds[rule.kind].leaves);
}

}  // namespace

CanopyMarkers::CanopyMarkers(int points)
    : leaf_points_(static_cast<std::size_t>(points) * 5 / 6 / POINTS_PER_LEAF * POINTS_PER_LEAF) {
  const auto all = static_cast<std::size_t>(points);
  lists_.addList("leaves", leaf_points_);
  lists_.addList("stems", all * 9 / 60 / POINTS_PER_STEM * POINTS_PER_STEM);
  lists_.addList("shade", all / 60 / POINTS_PER_SHADE * POINTS_PER_SHADE);
  lists_.addList("crowns", 0);
}

void CanopyMarkers::setLayout(const canopy::Layout& layout) {
  plants_.assign(layout.plants.size(), {});
  held_ = {};
  lists_.clear(STEMS);
  lists_.clear(SHADE);
  std::size_t leaves = 0;
  for (const canopy::Plant& plant : layout.plants) leaves += movingLeaves(layout.kinds[plant.kind]);
  for (const canopy::CrownRule& rule : layout.crowns) leaves += leavesOf(layout, rule);
  const auto wanted = static_cast<double>(leaves * POINTS_PER_LEAF);
  share_ = wanted > 0.0 ? std::min(1.0, static_cast<double>(leaf_points_) / wanted) : 1.0;
  setLadders(layout);
  for (std::size_t id = 0; id < layout.plants.size(); ++id) addPlant(layout, id);
  std::size_t crown_points = 0;
  for (const canopy::CrownRule& rule : layout.crowns)
    crown_points += POINTS_PER_LEAF * static_cast<std::size_t>(rule.trees) *
                    drawnOf(static_cast<std::size_t>(layout.kinds[rule.kind].leaves));
  lists_.setSize(CROWNS, crown_points);
  lists_.setSize(LEAVES, leaf_points_ - crown_points);
}

// The error of a tier is the gap to the next leaf, or the height of a plant without leaves.
void CanopyMarkers::setLadders(const canopy::Layout& layout) {
  shares_ = {0.0};
  for (double share = LEAST_SHARE * share_; share < 1.0 && shares_.size() + 1 < MAX_TIERS;)
    shares_.push_back(share), share *= 2.0;
  shares_.push_back(1.0);
  ladders_.clear();
  for (const canopy::PlantKind& kind : layout.kinds) {
    Ladder ladder;
    for (std::size_t tier = 0; tier < shares_.size(); ++tier) {
      const double share = shares_[tier];
      const double gap = kind.leaf_length * (1.0 / std::sqrt(share) - 1.0);
      ladder.gaps[tier] = static_cast<float>(share > 0.0 ? gap : kind.height);
      const double leaves = std::floor(share * static_cast<double>(movingLeaves(kind)));
      ladder.points[tier] = static_cast<float>(POINTS_PER_LEAF * leaves);
    }
    ladders_.push_back(ladder);
  }
}

std::size_t CanopyMarkers::drawnOf(std::size_t leaves) const {
  return static_cast<std::size_t>(share_ * static_cast<double>(leaves));
}

void CanopyMarkers::setCrowns(const canopy::Layout& layout, const LeafedCrowns& crowns) {
  crown_leaves_.clear();
  for (const LeafedCrowns::Crown& crown : crowns.crowns()) {
    const canopy::PlantKind& kind = layout.kinds[crown.kind];
    for (std::size_t i = 0; i < drawnOf(crown.leaves.size()); ++i) {
      const canopy::Leaf& leaf = crown.leaves[i].leaf;
      crown_leaves_.push_back({leaf, opaque(leafColour(kind, leaf))});
    }
  }
}

void CanopyMarkers::addPlant(const canopy::Layout& layout, std::size_t id) {
  const canopy::PlantKind& kind = layout.kinds[layout.plants[id].kind];
  const canopy::GrownPlant grown = canopy::grow(kind, layout.plants[id]);
  addStems(grown.stems, kind.stem_colour);
  addShade(layout.plants[id], 0.9 * layout.plants[id].scale * kind.radius);
  for (const canopy::Leaf& face : grown.rigid) {
    if (!lists_.hasRoom(STEMS, POINTS_PER_LEAF)) return;
    const std_msgs::ColorRGBA paint = darkened(opaque(kind.stem_colour), face.light);
    addStrip(lists_, STEMS, cornersOf(face, {face.root, face.tip, face.side}), paint, paint);
  }
}

std::vector<std::string> CanopyMarkers::tiers() const {
  std::vector<std::string> out;
  for (const double share : shares_) {
    char name[40];
    std::snprintf(name, sizeof name, "with %.3g %% of their leaves", 100.0 * share);
    out.push_back(name);
  }
  return out;
}

void CanopyMarkers::choose(const canopy::Layout& layout, const Viewpoint& eye, double tolerance,
                           Nanoseconds stamp) {
  choices_.resize(layout.plants.size());
  for (std::size_t id = 0; id < layout.plants.size(); ++id) {
    const canopy::Plant& plant = layout.plants[id];
    const canopy::PlantKind& kind = layout.kinds[plant.kind];
    const Vec3 middle = plant.position + Vec3(0.0, 0.0, 0.5 * plant.scale * kind.height);
    const double distance = length(eye.position - middle) - plant.scale * kind.radius;
    const auto scale = static_cast<float>(plant.scale * pixelsPerMetre(eye, distance));
    TierChoice& choice = choices_[id] = TierChoice();
    choice.id = static_cast<std::uint32_t>(id);
    choice.cost = ladders_[plant.kind].points;
    for (std::size_t tier = 0; tier < shares_.size(); ++tier)
      choice.error[tier] = scale * ladders_[plant.kind].gaps[tier];
  }
  const int finest = static_cast<int>(shares_.size()) - 1;
  balance_ = held_.allocateTiers(choices_, finest, static_cast<double>(room()), tolerance, stamp);
  for (const TierChoice& choice : choices_)
    if (plants_[choice.id].tier != choice.chosen)
      plants_[choice.id] = drawPlant(layout, choice.id, choice.chosen);
}

CanopyMarkers::DrawnPlant CanopyMarkers::drawPlant(const canopy::Layout& layout, std::size_t id,
                                                   int tier) const {
  const canopy::PlantKind& kind = layout.kinds[layout.plants[id].kind];
  const double share = shares_[static_cast<std::size_t>(tier)];
  DrawnPlant out;
  out.tier = tier;
  if (share <= 0.0) return out;
  const canopy::GrownPlant grown = canopy::grow(kind, layout.plants[id]);
  const auto count = static_cast<std::size_t>(share * static_cast<double>(grown.leaves.size()));
  for (std::size_t i = 0; i < count; ++i) {
    Drawn drawn{grown.leaves[i], opaque(leafColour(kind, grown.leaves[i]))};
    if (!drawn.leaf.joined) drawn.leaf.side *= 1.0 / std::sqrt(share);
    out.leaves.push_back(drawn);
  }
  return out;
}

// Adds a disc of darker ground under a plant, transparent at its rim.
void CanopyMarkers::addShade(const canopy::Plant& plant, double radius) {
  if (!lists_.hasRoom(SHADE, POINTS_PER_SHADE)) return;
  const Vec3 middle = plant.position + Vec3(0.0, 0.0, SHADE_HEIGHT);
  std_msgs::ColorRGBA dark = opaque(Vec3(0.05, 0.06, 0.02)), clear = dark;
  dark.a = 0.75F;
  clear.a = 0.F;
  const auto rim = [&](std::size_t edge) {
    const SinCos turn = sinCosTurns(static_cast<double>(edge) / SHADE_EDGES);
    return Vec3(middle + radius * Vec3(turn.cos, turn.sin, 0.0));
  };
  for (std::size_t edge = 0; edge < SHADE_EDGES; ++edge) {
    lists_.add(SHADE, middle, dark);
    lists_.add(SHADE, rim(edge), clear);
    lists_.add(SHADE, rim(edge + 1), clear);
  }
}

// Adds two crossed strips for each stem.
void CanopyMarkers::addStems(const std::vector<canopy::Stem>& stems, const Vec3& colour) {
  const std_msgs::ColorRGBA paint = opaque(colour), shaded = darkened(paint, 0.6);
  for (const canopy::Stem& stem : stems) {
    if (!lists_.hasRoom(STEMS, POINTS_PER_STEM)) return;
    for (const Vec3& side : {Vec3(stem.radius, 0.0, 0.0), Vec3(0.0, stem.radius, 0.0)})
      addStrip(lists_, STEMS, {stem.from - side, stem.from + side, stem.to - side, stem.to + side},
               paint, shaded);
  }
}

visualization_msgs::MarkerArray CanopyMarkers::build(const canopy::Foliage& foliage,
                                                     const std::vector<canopy::MovedLeaf>& crowns,
                                                     const std::string& frame_id) {
  lists_.clear(LEAVES);
  lists_.clear(CROWNS);
  const auto add = [&](List list, const Drawn& drawn, const canopy::MovedLeaf& moved) {
    const bool sprouts = !drawn.leaf.joined && drawn.leaf.root == drawn.leaf.anchor;
    addStrip(lists_, list, cornersOf(drawn.leaf, moved),
             darkened(drawn.colour, sprouts ? DARK_ROOT : 1.0), drawn.colour);
  };
  for (std::size_t plant = 0; plant < plants_.size(); ++plant)
    for (const Drawn& drawn : plants_[plant].leaves)
      add(LEAVES, drawn, foliage.move(drawn.leaf, plant));
  for (std::size_t i = 0; i < std::min(crowns.size(), crown_leaves_.size()); ++i)
    add(CROWNS, crown_leaves_[i], crowns[i]);
  return lists_.message(frame_id);
}

}  // namespace vegetation_sim
