// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/posed_plant.h"

#include <utility>

#include "sensors/plants/leaf_strip.h"

namespace vegetation_sim::scan {
namespace {

constexpr double STEM_TAPER = 0.5;  // radius of a stem's tip over that of its base, as displayed

// Wind does not move faces of wood; their side turns with their ends.
Strip rigidStrip(const canopy::Leaf& leaf, const canopy::Foliage& foliage, std::size_t plant) {
  const auto bend = [&](const Vec3& point) { return foliage.bend(point, plant); };
  const Vec3 root = bend(leaf.root), tip = bend(leaf.tip);
  return stripOf(leaf, {root, tip, bend(leaf.root + leaf.side) - root});
}

Rod rodOf(const Vec3& from, const Vec3& to, double radius) {
  return rodBetween(from, to, radius, STEM_TAPER * radius);
}

}  // namespace

PosedPlant::PosedPlant(const canopy::Layout& layout, std::uint32_t id, double height,
                       std::shared_ptr<const KindMasks> masks)
    : id_(id), cut_height_(height), foot_(layout.plants[id].position), masks_(std::move(masks)) {
  const canopy::Plant& plant = layout.plants[id];
  const canopy::PlantKind& kind = layout.kinds[plant.kind];
  paint_ = {kind.colour, kind.colour_young, kind.stem_colour};
  canopy::GrownPlant grown = canopy::grow(kind, plant, height);
  leaves_ = std::move(grown.leaves);
  rigid_ = std::move(grown.rigid);
  grown_stems_ = std::move(grown.stems);
  strips_.reserve(leaves_.size() + rigid_.size());
  for (const std::vector<canopy::Leaf>* part : {&leaves_, &rigid_})
    for (const canopy::Leaf& leaf : *part)
      strips_.push_back(stripOf(leaf, {leaf.root, leaf.tip, leaf.side}));
  for (const canopy::Stem& stem : grown_stems_)
    stems_.push_back(rodOf(stem.from, stem.to, stem.radius));
  strip_tree_.build(strips_, foot_);
  stem_tree_.build(stems_, std::vector<double>(stems_.size(), 0.0), foot_);
}

void PosedPlant::pose(const canopy::Foliage& foliage) {
  for (std::size_t i = 0; i < leaves_.size(); ++i)
    strips_[i] = stripOf(leaves_[i], foliage.move(leaves_[i], id_));
  if (bent_ || foliage.isBent(id_)) bendWood(foliage);
  bent_ = foliage.isBent(id_);
  strip_tree_.fit(strips_, foot_);
}

void PosedPlant::bendWood(const canopy::Foliage& foliage) {
  for (std::size_t i = 0; i < rigid_.size(); ++i)
    strips_[leaves_.size() + i] = rigidStrip(rigid_[i], foliage, id_);
  for (std::size_t i = 0; i < stems_.size(); ++i) {
    const canopy::Stem& stem = grown_stems_[i];
    stems_[i] = rodOf(foliage.bend(stem.from, id_), foliage.bend(stem.to, id_), stem.radius);
  }
  stem_tree_.fit(stems_, std::vector<double>(stems_.size(), 0.0), foot_);
}

Box PosedPlant::bounds() const {
  Box out = strip_tree_.bounds();
  out.add(stem_tree_.bounds());
  return out;
}

void PosedPlant::meet(const Ray& ray, const FloatRay& narrow, std::uint64_t first_rank,
                      RankedHit& nearest) const {
  strip_tree_.visit(ray, narrow, nearest.hit(), [&](std::size_t strip) {
    nearest.offer(first_rank + strip, [&](Hit& hit) { return meetStrip(strip, ray, hit); });
  });
  stem_tree_.visit(ray, narrow, nearest.hit(), [&](std::size_t stem) {
    nearest.offer(first_rank + strips_.size() + stem,
                  [&](Hit& hit) { return meetStem(stem, ray, hit); });
  });
}

bool PosedPlant::meetStrip(std::size_t strip, const Ray& ray, Hit& nearest) const {
  Meeting meeting;
  if (!scan::meet(ray, strips_[strip], nearest.distance, meeting)) return false;
  if (masks_ && isHole(strip, ray.at(meeting.distance))) return false;
  const bool leaf = strip < leaves_.size();
  nearest = {meeting.distance, leaf ? Label::FOLIAGE : Label::STEM, id_,
             static_cast<int>(leaf ? strip : stems_.size() + strip - leaves_.size()),
             meeting.cosine};
  return true;
}

bool PosedPlant::isHole(std::size_t strip, const Vec3& place) const {
  const canopy::Leaf& face =
      strip < leaves_.size() ? leaves_[strip] : rigid_[strip - leaves_.size()];
  return masks_->isHole(face, strips_[strip], place);
}

bool PosedPlant::meetStem(std::size_t stem, const Ray& ray, Hit& nearest) const {
  Meeting meeting;
  if (!scan::meet(ray, stems_[stem], nearest.distance, meeting)) return false;
  nearest = {meeting.distance, Label::STEM, id_, static_cast<int>(stem), meeting.cosine};
  return true;
}

}  // namespace vegetation_sim::scan
