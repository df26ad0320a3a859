// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/canopy_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "ros/services/allocation_report.h"
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

CanopyMarkers::CanopyMarkers(canopy::Canopy& canopy, const LeafedCrowns& crowns,
                             const forest::ForestReplica& forest, int points, double tolerance)
    : canopy_(canopy),
      layout_(canopy.layout()),
      crowns_(crowns),
      forest_(forest),
      tolerance_(tolerance),
      leaf_points_(static_cast<std::size_t>(points) * 5 / 6 / POINTS_PER_LEAF * POINTS_PER_LEAF),
      plants_(layout_.plants.size()) {
  const auto all = static_cast<std::size_t>(points);
  lists_.addList("leaves", leaf_points_);
  lists_.addList("stems", all * 9 / 60 / POINTS_PER_STEM * POINTS_PER_STEM);
  lists_.addList("shade", all / 60 / POINTS_PER_SHADE * POINTS_PER_SHADE);
  lists_.addList("crowns", 0);
  shareLeaves();
  setLadders();
  for (std::size_t id = 0; id < plants_.size(); ++id) {
    wood_.push_back(woodOf(id));
    addWood(id);
  }
  addShades();
}

CanopyMarkers::Wood CanopyMarkers::woodOf(std::size_t id) const {
  const canopy::Plant& plant = layout_.plants[id];
  canopy::GrownPlant grown = canopy::grow(layout_.kinds[plant.kind], plant, plants_[id].height);
  return {std::move(grown.stems), std::move(grown.rigid)};
}

// Divides the points of leaves between plants and crowns.
void CanopyMarkers::shareLeaves() {
  std::size_t leaves = 0, crown_points = 0;
  for (const canopy::Plant& plant : layout_.plants)
    leaves += movingLeaves(layout_.kinds[plant.kind]);
  for (const canopy::CrownRule& rule : layout_.crowns) leaves += leavesOf(layout_, rule);
  const auto wanted = static_cast<double>(leaves * POINTS_PER_LEAF);
  share_ = wanted > 0.0 ? std::min(1.0, static_cast<double>(leaf_points_) / wanted) : 1.0;
  for (const canopy::CrownRule& rule : layout_.crowns)
    crown_points += POINTS_PER_LEAF * static_cast<std::size_t>(rule.trees) *
                    drawnOf(static_cast<std::size_t>(layout_.kinds[rule.kind].leaves));
  lists_.setSize(CROWNS, crown_points);
  lists_.setSize(LEAVES, leaf_points_ - crown_points);
}

// The error of a tier is the gap to the next leaf, or the height of a plant without leaves.
void CanopyMarkers::setLadders() {
  shares_ = {0.0};
  for (double share = LEAST_SHARE * share_; share < 1.0 && shares_.size() + 1 < MAX_TIERS;)
    shares_.push_back(share), share *= 2.0;
  shares_.push_back(1.0);
  for (const canopy::PlantKind& kind : layout_.kinds) {
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

void CanopyMarkers::updateCrowns() {
  crown_leaves_.clear();
  for (const LeafedCrowns::Crown& crown : crowns_.crowns()) {
    const canopy::PlantKind& kind = layout_.kinds[crown.kind];
    for (std::size_t i = 0; i < drawnOf(crown.leaves.size()); ++i) {
      const canopy::Leaf& leaf = crown.leaves[i].leaf;
      crown_leaves_.push_back({leaf, opaque(leafColour(kind, leaf))});
    }
  }
}

// Adds the parts of a plant that wind does not move.
void CanopyMarkers::addWood(std::size_t id) {
  const canopy::PlantKind& kind = layout_.kinds[layout_.plants[id].kind];
  const canopy::Foliage& foliage = canopy_.foliage();
  const auto bend = [&](const Vec3& point) { return foliage.bend(point, id); };
  for (canopy::Stem stem : wood_[id].stems) {
    stem.from = bend(stem.from);
    stem.to = bend(stem.to);
    addStem(stem, kind.stem_colour);
  }
  for (const canopy::Leaf& face : wood_[id].faces) {
    if (!lists_.hasRoom(STEMS, POINTS_PER_LEAF)) return;
    const std_msgs::ColorRGBA paint = darkened(opaque(kind.stem_colour), face.light);
    const Vec3 root = bend(face.root), side = bend(face.root + face.side) - root;
    addStrip(lists_, STEMS, cornersOf(face, {root, bend(face.tip), side}), paint, paint);
  }
}

// Grows the plants again whose cuts have changed. Returns whether there are any.
bool CanopyMarkers::updateCuts() {
  bool changed = false;
  for (std::size_t id = 0; id < plants_.size(); ++id) {
    const double height = canopy_.foliage().cutHeight(id);
    if (plants_[id].height == height) continue;
    plants_[id].height = height;
    plants_[id] = drawPlant(id, plants_[id].tier);
    wood_[id] = woodOf(id);
    changed = true;
  }
  return changed;
}

// Wood is built anew only while bodies push plants, and when plants have been cut.
void CanopyMarkers::bendWood(bool cut) {
  const bool bent = canopy_.foliage().anyBent();
  if (cut) addShades();
  if (cut || bent || bent_) {
    lists_.clear(STEMS);
    for (std::size_t id = 0; id < plants_.size(); ++id) addWood(id);
  }
  bent_ = bent;
}

BalanceTerms CanopyMarkers::balanceTerms() const {
  std::vector<std::string> tiers;
  for (const double share : shares_) {
    char name[40];
    std::snprintf(name, sizeof name, "with %.3g %% of their leaves", 100.0 * share);
    tiers.emplace_back(name);
  }
  return {"Plants", tolerance_, "marker_points", "points", static_cast<double>(room()), tiers};
}

void CanopyMarkers::choose(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  choices_.resize(layout_.plants.size());
  for (std::size_t id = 0; id < layout_.plants.size(); ++id) {
    const canopy::Plant& plant = layout_.plants[id];
    const canopy::PlantKind& kind = layout_.kinds[plant.kind];
    const Vec3 middle = plant.position + Vec3(0.0, 0.0, 0.5 * plant.scale * kind.height);
    const auto scale =
        static_cast<float>(plant.scale * largestScale(viewers, middle, plant.scale * kind.radius));
    TierChoice& choice = choices_[id] = TierChoice();
    choice.id = static_cast<std::uint32_t>(id);
    choice.scale = double{scale} / plant.scale;
    choice.cost = ladders_[plant.kind].points;
    for (std::size_t tier = 0; tier < shares_.size(); ++tier)
      choice.error[tier] = scale * ladders_[plant.kind].gaps[tier];
  }
  const int finest = static_cast<int>(shares_.size()) - 1;
  balance_ = held_.allocateTiers(choices_, finest, static_cast<double>(room()), tolerance_, stamp);
  for (const TierChoice& choice : choices_)
    if (plants_[choice.id].tier != choice.chosen)
      plants_[choice.id] = drawPlant(choice.id, choice.chosen);
}

CanopyMarkers::DrawnPlant CanopyMarkers::drawPlant(std::size_t id, int tier) const {
  const canopy::PlantKind& kind = layout_.kinds[layout_.plants[id].kind];
  const double share = shares_[static_cast<std::size_t>(tier)];
  DrawnPlant out;
  out.tier = tier;
  out.height = plants_[id].height;
  if (share <= 0.0) return out;
  const canopy::GrownPlant grown = canopy::grow(kind, layout_.plants[id], out.height);
  const auto count = static_cast<std::size_t>(share * static_cast<double>(grown.leaves.size()));
  for (std::size_t i = 0; i < count; ++i) {
    Drawn drawn{grown.leaves[i], opaque(leafColour(kind, grown.leaves[i]))};
    if (!drawn.leaf.joined) drawn.leaf.side *= 1.0 / std::sqrt(share);
    out.leaves.push_back(drawn);
  }
  return out;
}

// Adds the shade of each plant, which is smaller the lower the plant has been cut.
void CanopyMarkers::addShades() {
  lists_.clear(SHADE);
  for (std::size_t id = 0; id < plants_.size(); ++id) {
    const canopy::Plant& plant = layout_.plants[id];
    const canopy::PlantKind& kind = layout_.kinds[plant.kind];
    const double top = plant.scale * kind.height;
    addShade(plant, 0.9 * plant.scale * kind.radius * std::min(1.0, plants_[id].height / top));
  }
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

// Adds two crossed strips.
void CanopyMarkers::addStem(const canopy::Stem& stem, const Vec3& colour) {
  if (!lists_.hasRoom(STEMS, POINTS_PER_STEM)) return;
  const std_msgs::ColorRGBA paint = opaque(colour), shaded = darkened(paint, 0.6);
  for (const Vec3& side : {Vec3(stem.radius, 0.0, 0.0), Vec3(0.0, stem.radius, 0.0)})
    addStrip(lists_, STEMS, {stem.from - side, stem.from + side, stem.to - side, stem.to + side},
             paint, shaded);
}

void CanopyMarkers::addLeaf(std::size_t list, const Drawn& drawn, const canopy::MovedLeaf& moved) {
  const bool sprouts = !drawn.leaf.joined && drawn.leaf.root == drawn.leaf.anchor;
  addStrip(lists_, list, cornersOf(drawn.leaf, moved),
           darkened(drawn.colour, sprouts ? DARK_ROOT : 1.0), drawn.colour);
}

void CanopyMarkers::addCrowns(const canopy::Foliage& foliage, Nanoseconds stamp) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < crowns_.crowns().size(); ++i) {
    const LeafedCrowns::Crown& crown = crowns_.crowns()[i];
    const std::vector<Pose> wood = crowns_.wood(i, forest_, stamp);
    for (std::size_t k = 0; k < drawnOf(crown.leaves.size()); ++k) {
      const canopy::CrownLeaf& leaf = crown.leaves[k];
      addLeaf(CROWNS, crown_leaves_[next++],
              carry(foliage, leaf, crown.rest[leaf.twig].pose, wood[leaf.twig]));
    }
  }
}

void CanopyMarkers::build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  const bool cut = updateCuts();
  choose(viewers, stamp);
  lists_.clear(LEAVES);
  lists_.clear(CROWNS);
  const canopy::Foliage& foliage = canopy_.foliage();
  for (std::size_t plant = 0; plant < plants_.size(); ++plant)
    for (const Drawn& drawn : plants_[plant].leaves)
      addLeaf(LEAVES, drawn, foliage.move(drawn.leaf, plant));
  addCrowns(foliage, stamp);
  bendWood(cut);
}

}  // namespace vegetation_sim
