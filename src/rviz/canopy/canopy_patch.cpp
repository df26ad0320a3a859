// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_patch.h"

#include <algorithm>
#include <cmath>

#include "rviz/canopy/ribbon_ends.h"
#include "rviz/render/texture.h"
#include "rviz/textures/foliage_texture.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

constexpr int STEM_SIDES = 5;
constexpr double SUN_DEPTH = 2.2;    // optical depth of the radius of the ball
constexpr double WIDEST = 4.0;       // largest factor of the width of leaves
constexpr double PUFF_SIZE = 2.4;    // of a puff relative to a leaf
constexpr double CLOUD_LIGHT = 0.3;  // least share of sunlight in a cloud
constexpr double MARGIN = 1.0;       // [m] around the bounding box
constexpr double FOOT_LIGHT = 0.4;   // share of light at the foot of a ribbon in the ground
constexpr double SEEN = 0.02;        // least change of the share of light that is drawn

// Joined pieces have their own outline, others that of a texture.
LeafCut cutOf(const canopy::PlantKind& kind, const canopy::Leaf& leaf) {
  if (leaf.joined) return LeafCut::PLAIN;
  if (kind.shape == canopy::PlantShape::SLICES)
    return kind.look == canopy::CellLook::PUFFS ? LeafCut::PUFF : LeafCut::SPRIG;
  return isRibbon(kind) ? LeafCut::RIBBON : LeafCut::LEAF;
}

bool joins(LeafCut cut) {
  return cut == LeafCut::RIBBON || cut == LeafCut::PLAIN;
}

// Returns the place of a leaf in the unit ball of leaves.
Vec3 inBall(const canopy::Layout& layout, std::size_t plant, const Vec3& at) {
  const canopy::Plant& p = layout.plants[plant];
  const canopy::PlantKind& kind = layout.kinds[p.kind];
  const double base = kind.shape == canopy::PlantShape::CROWN ? 0.35 * kind.height : 0.0;
  const double half = 0.5 * (kind.height - base);
  const Vec3 local = (at - p.position) / p.scale;
  return {local.x() / kind.radius, local.y() / kind.radius, (local.z() - base - half) / half};
}

// Returns the distance from a point in the unit ball to its surface.
double wayOut(const Vec3& at, const Vec3& direction) {
  const double b = dot(at, direction), c = dot(at, at) - 1.0;
  return std::max(0.0, -b + std::sqrt(std::max(0.0, b * b - c)));
}

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
  const double size = length(v);
  return size > 1e-9 ? Vec3(v / size) : otherwise;
}

// Makes an upright square of the length of a leaf around its foot, so that no puff is seen on edge
// from the ground.
void setUpright(double size, Vec3& root, Vec3& tip, Vec3& side) {
  const double half = 0.5 * size * length(tip - root);
  side = half * unit(Vec3(side.x(), side.y(), 0.0), Vec3::UnitX());
  tip = root + Vec3(0.0, 0.0, half);
  root -= Vec3(0.0, 0.0, half);
}

Vec3 rolled(const Roll& roll, const Vec3& side, const Vec3& across) {
  return static_cast<double>(roll.cos) * side + static_cast<double>(roll.sin) * across;
}

void setColour(const Vec3& rgb, double sun, VertexPaint& paint) {
  for (int i = 0; i < 3; ++i)
    paint.colour[i] = static_cast<std::uint8_t>(255.0 * std::clamp(rgb[i], 0.0, 1.0));
  paint.colour[3] = static_cast<std::uint8_t>(255.0 * std::clamp(sun, 0.0, 1.0));
}

void darken(double light, VertexPaint& paint) {
  for (int i = 0; i < 3; ++i) paint.colour[i] = static_cast<std::uint8_t>(light * paint.colour[i]);
}

// Returns two triangles for each leaf of four corners.
std::vector<std::uint32_t> leafTriangles(std::size_t leaves) {
  std::vector<std::uint32_t> out;
  out.reserve(6 * leaves);
  for (std::size_t i = 0; i < leaves; ++i) {
    const auto first = static_cast<std::uint32_t>(4 * i);
    out.insert(out.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
  }
  return out;
}

// Puts items into a random order, the same for the same number of items.
template <class Item>
void shuffle(std::vector<Item>& items) {
  const Random random(items.size());
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1],
              items[static_cast<std::size_t>(random.uniform(i) * static_cast<double>(i))]);
}

void setNormal(const Vec3& normal, VertexPaint& paint) {
  for (int i = 0; i < 3; ++i) paint.normal[i] = static_cast<float>(normal[i]);
}

}  // namespace

CanopyPatch::CanopyPatch(const canopy::Layout& layout, std::vector<std::size_t> plants,
                         std::vector<double> heights, const PatchScene& scene)
    : plants_(std::move(plants)),
      heights_(std::move(heights)),
      textures_(scene.textures),
      scene_(scene.node->getCreator()),
      frame_(scene.frame),
      origin_(scene.origin),
      leaf_batch_(uniqueName("canopy_leaves"), scene.leaf_material),
      stem_batch_(uniqueName("canopy_stems"), scene.stem_material) {
  for (const std::size_t plant : plants_)
    middle_ += layout.plants[plant].position / static_cast<double>(plants_.size());
  for (std::size_t i = 0; i < plants_.size(); ++i) grow(layout, plants_[i], heights_[i]);
  finish(layout, scene);
}

CanopyPatch::CanopyPatch(const canopy::Layout& layout, const LeafedCrowns::Crown& crown,
                         std::size_t number, const PatchScene& scene)
    : crown_(number),
      textures_(scene.textures),
      scene_(scene.node->getCreator()),
      frame_(scene.frame),
      origin_(scene.origin),
      middle_(0.5 * (crown.box.low + crown.box.high)),
      reach_(0.5 * length(Vec3(crown.box.high - crown.box.low))),
      leaf_batch_(uniqueName("canopy_leaves"), scene.leaf_material),
      stem_batch_(uniqueName("canopy_stems"), scene.stem_material) {
  const Vec3 half = (0.5 * (crown.box.high - crown.box.low)).cwiseMax(0.01);
  const std::size_t count = crown.leaves.size();
  for (std::size_t i = 0; i < count; ++i) {
    const canopy::Leaf& leaf = crown.leaves[i].leaf;
    const Vec3 at = (leaf.root - middle_).cwiseQuotient(half);
    leaves_.push_back(
        {leaf, i, crown.kind, at, LeafCut::LEAF, Share::OTHERS, static_cast<float>(-length(at))});
  }
  finish(layout, scene);
}

void CanopyPatch::finish(const canopy::Layout& layout, const PatchScene& scene) {
  std::stable_sort(leaves_.begin(), leaves_.end(),
                   [](const Drawn& a, const Drawn& b) { return a.order < b.order; });
  alike_ = static_cast<std::size_t>(
      std::count_if(leaves_.begin(), leaves_.end(),
                    [](const Drawn& drawn) { return drawn.share == Share::ALIKE; }));
  build(layout, scene.to_sun);
  scene.node->attachObject(&leaf_batch_);
  scene.node->attachObject(&stem_batch_);
}

bool CanopyPatch::isOutdated(const canopy::Replica& canopy) const {
  for (std::size_t i = 0; i < plants_.size(); ++i)
    if (canopy.cutHeight(plants_[i]) != heights_[i]) return true;
  return false;
}

bool CanopyPatch::isInOtherLight() const {
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    const SharedLight::Shares now = lightAt(tops_[i]);
    if (std::fabs(now.sun - light_[i].sun) > SEEN || std::fabs(now.sky - light_[i].sky) > SEEN)
      return true;
  }
  return false;
}

void CanopyPatch::setRank(int rank) {
  leaf_batch_.setRank(rank);
  stem_batch_.setRank(rank);
}

// Leaves are ordered by the share of their plant that is farther out, so that the first leaves are
// an even part of all plants. Ribbons keep their order.
void CanopyPatch::grow(const canopy::Layout& layout, std::size_t plant, double height) {
  const canopy::Plant& p = layout.plants[plant];
  const canopy::PlantKind& kind = layout.kinds[p.kind];
  canopy::GrownPlant grown = canopy::grow(kind, p, height);
  if (isRibbon(kind) && kind.shape != canopy::PlantShape::STALK)
    finishRibbons(!(height < canopy::UNCUT), grown.leaves);
  const std::size_t count = grown.leaves.size();
  tops_.push_back(p.position + Vec3(0.0, 0.0, p.scale * kind.height));
  light_.push_back(lightAt(tops_.back()));
  tallest_ = std::max(tallest_, p.scale * kind.height);
  reach_ =
      std::max(reach_, length(p.position - middle_) + p.scale * std::max(kind.height, kind.radius));
  if (kind.shape == canopy::PlantShape::STALK) return addStrips(grown, layout, plant, height);
  const bool is_lit = light_.back().sun > 1.0 - SEEN && light_.back().sky > 1.0 - SEEN;
  const bool is_whole = !(height < canopy::UNCUT);
  const Share share = isRead(kind) && is_whole && is_lit ? Share::ALIKE : Share::OTHERS;
  std::vector<std::pair<double, std::size_t>> sorted;
  for (std::size_t i = 0; i < count; ++i)
    sorted.emplace_back(joins(cutOf(kind, grown.leaves[i]))
                            ? 0.0
                            : -length(inBall(layout, plant, grown.leaves[i].root)),
                        i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t rank = 0; rank < count; ++rank) {
    const canopy::Leaf& leaf = grown.leaves[sorted[rank].second];
    leaves_.push_back({leaf, plant, p.kind, inBall(layout, plant, leaf.root), cutOf(kind, leaf),
                       share, static_cast<float>(rank) / static_cast<float>(count)});
  }
  addStems(grown, kind.stem_colour);
  addRigid(grown, kind, p.kind);
  stem_owners_.resize(stem_paint_.size(), plant);
}

void CanopyPatch::addStrips(const canopy::GrownPlant& grown, const canopy::Layout& layout,
                            std::size_t plant, double height) {
  const canopy::Plant& p = layout.plants[plant];
  const std::vector<StalkStrip> strips = stalkStrips(layout.kinds[p.kind], p, height, grown);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const float order = static_cast<float>(i) / static_cast<float>(strips.size());
    leaves_.push_back({strips[i].leaf, plant, p.kind, Vec3::Zero(), LeafCut::RIBBON, Share::OTHERS,
                       order, static_cast<int>(strips_.size()), strips[i].roll, strips[i].face});
    strips_.push_back(strips[i].paint);
  }
}

// Adds the rigid faces of a mesh.
void CanopyPatch::addRigid(const canopy::GrownPlant& grown, const canopy::PlantKind& kind,
                           std::size_t number) {
  for (const canopy::Leaf& face : grown.rigid) {
    const Vec3 colour =
        face.look > 0 ? textures_->lookOf(number, kind.form->looks[face.look - 1].material).mean
                      : kind.stem_colour;
    const auto first = static_cast<std::uint32_t>(stem_paint_.size());
    const Vec3 normal = unit(cross(face.tip - face.root, face.side), Vec3::UnitZ());
    const Vec3 low = static_cast<double>(face.root_width) * face.side;
    const Vec3 high = static_cast<double>(face.tip_width) * face.side;
    for (const Vec3& at : {Vec3(face.root - low), Vec3(face.root + low), Vec3(face.tip - high),
                           Vec3(face.tip + high)}) {
      for (int k = 0; k < 3; ++k) stem_positions_.push_back(static_cast<float>(at[k] - origin_[k]));
      const SharedLight::Shares around = lightAt(face.root);
      VertexPaint paint{
          {0.f, 0.f, 1.f}, {0, 0, 0, 255}, {0.1f, 0.f, float(around.sky) * face.light}};
      setNormal(normal, paint);
      setColour(1.3 * colour, around.sun * static_cast<double>(face.light), paint);
      stem_paint_.push_back(paint);
    }
    // Both sides are drawn because the outer side is unknown.
    stem_triangles_.insert(stem_triangles_.end(),
                           {first, first + 1, first + 3, first, first + 3, first + 2, first + 3,
                            first + 1, first, first + 2, first + 3, first});
  }
}

// Adds tapering prisms.
void CanopyPatch::addStems(const canopy::GrownPlant& grown, const Vec3& colour) {
  for (const canopy::Stem& stem : grown.stems) {
    const Vec3 along = unit(stem.to - stem.from, Vec3::UnitZ());
    const Vec3 u = unit(cross(along, std::fabs(along.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()),
                        Vec3::UnitY());
    const Vec3 v = cross(along, u);
    const auto first = static_cast<std::uint32_t>(stem_paint_.size());
    const SharedLight::Shares around = lightAt(stem.from);
    for (int i = 0; i < 2 * (STEM_SIDES + 1); ++i) {
      const bool top = i > STEM_SIDES;
      const double turns = static_cast<double>(i % (STEM_SIDES + 1)) / STEM_SIDES;
      const SinCos turn = sinCosTurns(turns);
      const Vec3 normal = turn.cos * u + turn.sin * v;
      const Vec3 at =
          (top ? stem.to : stem.from) + (top ? 0.5 : 1.0) * stem.radius * normal - origin_;
      for (int k = 0; k < 3; ++k) stem_positions_.push_back(static_cast<float>(at[k]));
      VertexPaint paint{{0.f, 0.f, 1.f}, {255, 255, 255, 255}, {0.f, 0.f, top ? 0.35f : 0.6f}};
      setNormal(normal, paint);
      setColour(1.3 * colour, around.sun * (top ? 0.25 : 0.6), paint);
      paint.place[2] *= float(around.sky);
      paint.place[0] = static_cast<float>(0.25 * turns);
      paint.place[1] = static_cast<float>(top ? 0.5 * length(stem.to - stem.from) : 0.0);
      stem_paint_.push_back(paint);
    }
    for (std::uint32_t i = 0; i < STEM_SIDES; ++i) {
      const std::uint32_t a = first + i, b = a + STEM_SIDES + 1;
      stem_triangles_.insert(stem_triangles_.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
}

// The light of crowns that hang in trees is that among the trees already.
SharedLight::Shares CanopyPatch::lightAt(const Vec3& place) const {
  return crown_ ? SharedLight::Shares() : SharedLight::at(scene_, frame_, place);
}

VertexPaint CanopyPatch::paintOf(const canopy::Layout& layout, const Drawn& drawn,
                                 const Vec3& to_sun) const {
  VertexPaint out = ownPaintOf(layout, drawn, to_sun);
  const SharedLight::Shares around = lightAt(drawn.leaf.root);
  out.colour[3] = static_cast<std::uint8_t>(around.sun * out.colour[3]);
  out.place[2] *= static_cast<float>(around.sky);
  return out;
}

// Inner leaves are darker: sunlight is absorbed along the path through the leaves.
VertexPaint CanopyPatch::ownPaintOf(const canopy::Layout& layout, const Drawn& drawn,
                                    const Vec3& to_sun) const {
  const canopy::PlantKind& kind = layout.kinds[drawn.kind];
  const Vec3 along = unit(drawn.leaf.tip - drawn.leaf.root, Vec3::UnitZ());
  const Vec3 across = unit(drawn.leaf.side, Vec3::UnitX());
  Vec3 face = cross(along, across);
  if (face.z() < 0.0) face = -face;
  if (drawn.cut == LeafCut::RIBBON) face = Vec3::UnitZ();  // the same for all its pieces
  const auto light = static_cast<double>(drawn.leaf.light);
  double sun = light;
  Vec3 outward = face;
  if (drawn.cut == LeafCut::LEAF || drawn.cut == LeafCut::PUFF) {
    outward = unit(drawn.in_ball, Vec3::UnitZ());
    sun = std::exp(-SUN_DEPTH * wayOut(drawn.in_ball, to_sun)) * (0.4 + 0.6 * light);
  }
  // Light is scattered many times in a cloud, which hardly absorbs it.
  float sky = static_cast<float>(light);
  if (drawn.cut == LeafCut::PUFF) {
    sun = CLOUD_LIGHT + (1.0 - CLOUD_LIGHT) * sun;
    sky = 0.8f;
    face = unit(0.7 * to_sun + outward, Vec3::UnitZ());
    outward = face;
  }
  if (drawn.leaf.look > 0) {
    const canopy::FaceLook& look = kind.form->looks[drawn.leaf.look - 1];
    const SinCos turn = sinCos(crown_ ? 0.0 : layout.plants[drawn.owner].yaw);
    const Vec3 given(look.normal[0], look.normal[1], look.normal[2]);
    const Vec3 turned(turn.cos * given.x() - turn.sin * given.y(),
                      turn.sin * given.x() + turn.cos * given.y(), given.z());
    VertexPaint out{{0.f, 0.f, 1.f}, {0, 0, 0, 255}, {0.f, 0.f, sky}};
    setNormal(unit(turned, face), out);
    setColour(textures_->lookOf(drawn.kind, look.material).colour, sun, out);
    return out;
  }
  const double young = drawn.leaf.shade;
  VertexPaint out{{0.f, 0.f, 1.f}, {0, 0, 0, 255}, {0.f, 0.f, sky}};
  setNormal(unit(0.75 * outward + 0.5 * face, Vec3::UnitZ()), out);
  setColour(kind.colour * (1.0 - young) + kind.colour_young * young, sun, out);
  return out;
}

// Paints the four corners of a strip.
void CanopyPatch::paintEnds(const StripPaint& strip, const SharedLight::Shares& around,
                            VertexPaint* corners) const {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const std::size_t end = corner / 2;
    VertexPaint& paint = corners[corner];
    const std::array<float, 2> place =
        foliagePlace(LeafCut::RIBBON, strip.across[corner % 2], static_cast<float>(end));
    paint = {{0.f, 0.f, 1.f}, {0, 0, 0, 255}, {place[0], place[1], 0.f}};
    setNormal(strip.normals[corner], paint);
    setColour(strip.colours[end], around.sun * strip.light[end], paint);
    paint.place[2] = static_cast<float>(around.sky * strip.light[end]);
  }
}

// Corners 2 and 3 are the tip of a face.
std::array<float, 2> CanopyPatch::placeOf(const canopy::Layout& layout, const Drawn& drawn,
                                          int corner) const {
  if (drawn.leaf.look > 0) {
    const canopy::FaceLook& look = layout.kinds[drawn.kind].form->looks[drawn.leaf.look - 1];
    const int place = textures_->lookOf(drawn.kind, look.material).place;
    const auto& uv = look.uv[static_cast<std::size_t>(std::min(corner, 2))];
    if (place >= 0) return foliagePlace(place, uv[0], 1.f - uv[1]);
  }
  return foliagePlace(drawn.cut, corner % 2 == 0 ? 0.f : 1.f, corner < 2 ? 0.f : 1.f);
}

void CanopyPatch::build(const canopy::Layout& layout, const Vec3& to_sun) {
  std::vector<VertexPaint>& paint = leaf_paint_;
  paint.clear();
  paint.reserve(4 * leaves_.size());
  double size = 0.0;
  std::size_t counted = 0;
  for (const Drawn& drawn : leaves_) {
    const canopy::Leaf& leaf = drawn.leaf;
    if (drawn.face <= 0) {
      size += length(leaf.tip - leaf.root);
      ++counted;
    }
    if (drawn.strip >= 0) {
      paint.resize(paint.size() + 4);
      paintEnds(strips_[static_cast<std::size_t>(drawn.strip)], lightAt(leaf.root),
                &paint[paint.size() - 4]);
      continue;
    }
    const VertexPaint own = paintOf(layout, drawn, to_sun);
    for (int corner = 0; corner < 4; ++corner) {
      const std::array<float, 2> place = placeOf(layout, drawn, corner);
      paint.push_back(own);
      if (corner < 2 && drawn.cut == LeafCut::RIBBON && isFoot(drawn.leaf))
        darken(FOOT_LIGHT, paint.back());
      paint.back().place[0] = place[0];
      paint.back().place[1] = place[1];
    }
  }
  if (counted > 0) leaf_size_ = size / static_cast<double>(counted);
  std::vector<StripPaint>().swap(strips_);
  std::vector<const Drawn*> leaves;
  for (const Drawn& drawn : leaves_) leaves.push_back(&drawn);
  positions_ = placeAtRest(leaves);
  leaf_batch_.build(positions_, paint, leafTriangles(leaves_.size()),
                    static_cast<float>(MARGIN + leaf_size_ + tallest_));
  stem_batch_.build(stem_positions_, stem_paint_, stem_triangles_, static_cast<float>(tallest_));
}

// Returns the corners of leaves [m].
std::vector<float> CanopyPatch::placeAtRest(const std::vector<const Drawn*>& leaves) const {
  std::vector<float> out(12 * leaves.size());
  float* at = out.data();
  for (const Drawn* drawn : leaves)
    at = placeCorners({drawn->leaf.root, drawn->leaf.tip, drawn->leaf.side}, *drawn, 1.0, at);
  return out;
}

std::vector<std::size_t> CanopyPatch::alike() const {
  std::vector<std::size_t> out;
  for (const Drawn& drawn : leaves_)
    if (drawn.share == Share::ALIKE) out.push_back(drawn.owner);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::unique_ptr<Batch> CanopyPatch::copyAtRest(Ogre::SceneNode& node, const std::string& material,
                                               Share share) const {
  std::vector<const Drawn*> leaves;
  for (const Drawn& drawn : leaves_)
    if (drawn.share == share) leaves.push_back(&drawn);
  if (share == Share::ALIKE) shuffle(leaves);
  std::vector<VertexPaint> paint;
  std::vector<float> anchors;
  paint.reserve(4 * leaves.size());
  anchors.reserve(12 * leaves.size());
  for (const Drawn* drawn : leaves) {
    const auto first = leaf_paint_.begin() + 4 * (drawn - leaves_.data());
    paint.insert(paint.end(), first, first + 4);
    for (int corner = 0; corner < 4; ++corner)
      for (int k = 0; k < 3; ++k)
        anchors.push_back(static_cast<float>(drawn->leaf.anchor[k] - origin_[k]));
  }
  auto out = std::make_unique<Batch>(uniqueName("leaves_at_rest"), material);
  out->build(placeAtRest(leaves), paint, leafTriangles(leaves.size()), 0.f);
  out->setAnchors(anchors);
  node.attachObject(out.get());
  return out;
}

bool CanopyPatch::isBent(const canopy::Foliage& foliage) const {
  return std::any_of(plants_.begin(), plants_.end(),
                     [&](std::size_t plant) { return foliage.isBent(plant); });
}

bool CanopyPatch::isPictured(const canopy::Foliage& foliage,
                             const std::vector<bool>& pictured) const {
  if (pictured.empty()) return false;
  const Vec3 reach = reach_ * foliage.layerCut().axes().out;
  const auto from = pictured.begin() + foliage.layerAt(middle_ + reach);
  const auto to = pictured.begin() + foliage.layerAt(middle_ - reach);
  return std::find(from, to + 1, false) == to + 1;
}

void CanopyPatch::move(const canopy::Foliage& foliage, std::size_t count,
                       const std::vector<bool>& pictured) {
  const auto hasPicture = [&](const Drawn& drawn) {
    return !pictured.empty() &&
           pictured[static_cast<std::size_t>(foliage.layerAt(drawn.leaf.anchor))];
  };
  const Vec3 none = Vec3::Zero();
  std::size_t skipped = 0;
  moveBy(
      [&](const Drawn& drawn) {
        if (!hasPicture(drawn)) return foliage.move(drawn.leaf, drawn.owner);
        ++skipped;
        return canopy::MovedLeaf{none, none, none};
      },
      isPictured(foliage, pictured) ? 0 : count);
  drawn_ -= skipped;
  if (drawn_ == 0) leaf_batch_.limit(0);
  bendStems(foliage);
}

void CanopyPatch::bendStems(const canopy::Foliage& foliage) {
  const auto isBent = [&](std::size_t plant) { return foliage.isBent(plant); };
  const bool bent =
      foliage.anyBent() && std::any_of(stem_owners_.begin(), stem_owners_.end(), isBent);
  if (bent || bent_) {
    std::vector<float> positions(stem_positions_);
    for (std::size_t i = 0; i < stem_owners_.size(); ++i) {
      float* at = positions.data() + 3 * i;
      const Vec3 moved = foliage.bend(origin_ + Vec3(at[0], at[1], at[2]), stem_owners_[i]);
      for (int k = 0; k < 3; ++k) at[k] = static_cast<float>(moved[k] - origin_[k]);
    }
    stem_batch_.move(positions);
  }
  bent_ = bent;
}

void CanopyPatch::move(const canopy::Foliage& foliage, const LeafedCrowns::Crown& crown,
                       const std::vector<Pose>& wood, std::size_t count) {
  moveBy(
      [&](const Drawn& drawn) {
        const canopy::CrownLeaf& leaf = crown.leaves[drawn.owner];
        return carry(foliage, leaf, crown.rest[leaf.twig].pose, wood[leaf.twig]);
      },
      count);
}

// Writes the corners of a leaf that is `grown` times as large, and returns the end of what it
// wrote.
float* CanopyPatch::placeCorners(const canopy::MovedLeaf& moved, const Drawn& drawn, double grown,
                                 float* out) const {
  const bool joined = joins(drawn.cut);
  Vec3 root = moved.root - origin_;
  Vec3 tip = root + (joined ? 1.0 : grown) * (moved.tip - moved.root);
  Vec3 side = grown * moved.side;
  if (drawn.cut == LeafCut::PUFF) setUpright(PUFF_SIZE, root, tip, side);
  const double first = joined ? static_cast<double>(drawn.leaf.root_width) : 1.0;
  const double last = joined ? static_cast<double>(drawn.leaf.tip_width) : 1.0;
  Vec3 at_root = first * side, at_tip = last * side;
  if (drawn.roll[1].sin != 0.f) {
    const Vec3 across = cross(unit(tip - root, Vec3::UnitZ()), side);
    at_root = first * rolled(drawn.roll[0], side, across);
    at_tip = last * rolled(drawn.roll[1], side, across);
  }
  for (const Vec3& at :
       {Vec3(root - at_root), Vec3(root + at_root), Vec3(tip - at_tip), Vec3(tip + at_tip)})
    for (int k = 0; k < 3; ++k) *out++ = static_cast<float>(at[k]);
  return out;
}

template <class Mover>
void CanopyPatch::moveBy(const Mover& mover, std::size_t count) {
  drawn_ = std::min(count, leaves_.size());
  leaf_batch_.limit(2 * drawn_);
  if (drawn_ == 0) return;
  const double share = static_cast<double>(drawn_) / static_cast<double>(leaves_.size());
  const double grown = std::min(WIDEST, 1.0 / std::sqrt(share));
  positions_.resize(12 * drawn_);
  float* out = positions_.data();
  for (std::size_t i = 0; i < drawn_; ++i) {
    out = placeCorners(mover(leaves_[i]), leaves_[i], grown, out);
  }
  leaf_batch_.move(positions_);
}

}  // namespace vegetation_sim::view
