// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/leaf_motion.h"

#include <algorithm>
#include <cmath>

#include "reference/canopy/printed_view.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double FARTHEST = 0.4;  // limit of displacements as a share of a plant's height

// Interpolates between the four cells; the field is periodic.
double bilinearDepth(const std::vector<double>& values, int size, double x, double y) {
  const double left = std::floor(x), low = std::floor(y), p = x - left, q = y - low;
  const int mask = size - 1, x0 = static_cast<int>(left) & mask, y0 = static_cast<int>(low) & mask;
  const int x1 = (x0 + 1) & mask, y1 = (y0 + 1) & mask;
  const auto at = [&](int column, int row) {
    return values[static_cast<std::size_t>(row * size + column)];
  };
  return (1.0 - q) * ((1.0 - p) * at(x0, y0) + p * at(x1, y0)) +
         q * ((1.0 - p) * at(x0, y1) + p * at(x1, y1));
}

}  // namespace

double cutShare(const CutState& state, const CutSettings& settings, Nanoseconds stamp) {
  return smoothStep(secondsBetween(state.since, stamp) / settings.cross_fade);
}

Foliage::Foliage(const Layout& layout) : layout_(layout), plane_(layout.motion.plane) {
  for (const Plant& plant : layout.plants)
    tops_.push_back(plant.scale * layout.kinds[plant.kind].height);
}

void Foliage::update(const History& history, double front_share, const CutState& cuts,
                     Nanoseconds stamp) {
  share_ = cutShare(cuts, layout_.motion.cuts, stamp);
  cut_since_ = cuts.since;
  build(cuts_[0], cuts.now, history, front_share);
  if (share_ < 1.0) build(cuts_[1], cuts.before, history, front_share);
}

double Foliage::cutHeight(std::size_t plant) const {
  if (!anyCut()) return UNCUT;
  const auto cut = stubble_->find(static_cast<std::uint32_t>(plant));
  return cut == stubble_->end() ? UNCUT : cut->second;
}

LayerCut Foliage::cut(const CutView& view, bool crowns) const {
  const Vec3 out = axesOf(view.orientation).out;
  const double flat = std::sqrt(out.x() * out.x() + out.y() * out.y());
  double nearest = 1e9, farthest = -1e9;
  const auto add = [&](const Vec3& middle, double reach) {
    const double depth = -dot(out, Vec3(middle - view.position));
    nearest = std::min(nearest, depth - reach);
    farthest = std::max(farthest, depth + reach);
  };
  for (std::size_t i = 0; i < layout_.plants.size(); ++i) {
    const Plant& plant = layout_.plants[i];
    const double half = 0.5 * tops_[i], radius = plant.scale * layout_.kinds[plant.kind].radius;
    add(plant.position + Vec3(0.0, 0.0, half), radius * flat + half * std::fabs(out.z()));
  }
  for (const LeafBox& crown : crowns_) {
    if (!crowns) break;
    const Vec3 half = 0.5 * (crown.high - crown.low);
    add(crown.low + half, half.x() * std::fabs(out.x()) + half.y() * std::fabs(out.y()) +
                              half.z() * std::fabs(out.z()));
  }
  return LayerCut(view, layout_.motion.cuts, nearest, farthest);
}

void Foliage::build(Cut& cut, const CutView& view, const History& history, double front_share) {
  const Motion& motion = layout_.motion;
  cut.cut = cutFor(view);
  cut.to_view = PlaneToView(plane_.axes, cut.cut.axes());
  cut.layers.resize(static_cast<std::size_t>(cut.cut.layers()));
  cut.shares.clear();
  const LayerView layers{&motion.layers,  &history,    1.0 / motion.rate,
                         cut.to_view.out, front_share, plane_.width / history.size()};
  const Vec3& lambda = motion.warp.lambda;
  const double reach = motion.warp.reference_time * (std::max(lambda.x(), lambda.y()) + lambda.z());
  for (int i = 0; i < cut.cut.layers(); ++i) {
    LayerMotion& layer = cut.layers[static_cast<std::size_t>(i)];
    layerMotion(layers, cut.cut.distance(i), cut.cut.last(),
                delaySpeedOf(motion.layers, layout_.seed, i), layer);
    if (motion.plane.tiling == Tiling::BLEND) blendSeams(layer.plane);
    limitFolding(layer, reach, layers.cell);
    cut.shares.push_back(depthShare(motion.warp, cut.cut.distance(i), cut.cut.last()));
  }
}

Vec3 Foliage::motionIn(const Cut& cut, const Vec3& anchor, const Vec3& point) const {
  const LayerMotion& layer = cut.layers[static_cast<std::size_t>(cut.cut.layerAt(anchor))];
  const int size = layer.plane.size;
  const PlaneVector cell = plane_.cellAt(point, size);
  const PlaneVector across = bilinear(layer.plane, cell.u, cell.v);
  if (layout_.motion.plane.projection == Projection::PRINTED) {
    const PrintedAngles angles = printedAngles(plane_.axes, cut.cut.axes());
    return printedToView(across, angles.tilt, angles.alpha, angles.beta);
  }
  return cut.to_view.apply(
      Vec3(across.u, across.v, bilinearDepth(layer.depth, size, cell.u, cell.v)));
}

std::vector<float> Foliage::sheet(int layer) const {
  const Cut& cut = cuts_[0];
  const LayerMotion& motion = cut.layers[static_cast<std::size_t>(layer)];
  std::vector<float> out;
  for (std::size_t i = 0; i < motion.depth.size(); ++i) {
    const Vec3 seen =
        cut.to_view.apply(Vec3(motion.plane.u[i], motion.plane.v[i], motion.depth[i]));
    for (const double value : {seen.x(), seen.y(), seen.z()})
      out.push_back(static_cast<float>(value));
  }
  return out;
}

Vec3 Foliage::motion(const Vec3& anchor, const Vec3& point) const {
  return motionIn(cuts_[0], anchor, point);
}

Vec3 Foliage::displacementIn(const Cut& cut, const Vec3& anchor, const Vec3& point,
                             double limit) const {
  const double share = cut.shares[static_cast<std::size_t>(cut.cut.layerAt(anchor))];
  const Vec3 d = canopy::displacement(layout_.motion.warp, motionIn(cut, anchor, point), share,
                                      1.0 / layout_.motion.rate);
  const double size = length(d);
  const double kept = size > 0.0 ? softLimit(size, 0.5 * limit, limit) / size : 0.0;
  return outOf(cut.cut.axes(), kept * d);
}

Vec3 Foliage::displacement(const Vec3& anchor, const Vec3& point, std::size_t plant) const {
  Vec3 out = sway(anchor, point, plant);
  const auto bent = bent_.find(plant);
  if (bent == bent_.end()) return out;
  return turnAt(bent->second, anchor).of(point + out) - point;
}

Freedom Foliage::freedomOf(const Vec3& point, std::size_t plant) const {
  const double top = tops_[plant], rigidity = layout_.motion.warp.rigidity;
  const double height = point.z() - layout_.plants[plant].position.z();
  return {mobility(height, top, rigidity), FARTHEST * top / std::max(1.0, rigidity)};
}

Vec3 Foliage::sway(const Vec3& anchor, const Vec3& point, std::size_t plant) const {
  const Freedom freedom = freedomOf(point, plant);
  if (!(freedom.share > 0.0)) return Vec3::Zero();
  Vec3 out = freedom.share * freeDisplacement(anchor, point, freedom.limit);
  if (layout_.motion.warp.method == WarpMethod::WARP) return out;
  return bent(Vec3(point - layout_.plants[plant].position), out);
}

Vec3 Foliage::freeDisplacement(const Vec3& anchor, const Vec3& point, double limit) const {
  if (!(limit > 0.0)) return Vec3::Zero();
  Vec3 out = displacementIn(cuts_[0], anchor, point, limit);
  if (!(share_ < 1.0)) return out;
  return share_ * out + (1.0 - share_) * displacementIn(cuts_[1], anchor, point, limit);
}

// A leaf turns with the fibre of its anchor, so that it keeps its shape.
MovedLeaf Foliage::move(const Leaf& leaf, std::size_t plant) const {
  if (leaf.lies) return {leaf.root, leaf.tip, leaf.side};
  MovedLeaf out = swayed(leaf, plant);
  const auto bent = bent_.find(plant);
  if (bent == bent_.end()) return out;
  const Turn turn = turnAt(bent->second, leaf.anchor);
  return {turn.of(out.root), turn.of(out.tip), rotate(turn.turn, out.side)};
}

MovedLeaf Foliage::swayed(const Leaf& leaf, std::size_t plant) const {
  if (leaf.joined) {  // each corner by its own position, as in the faces that share it
    const Vec3 left = leaf.root - leaf.side, right = leaf.root + leaf.side;
    const Vec3 to_left = left + sway(leaf.anchor, left, plant);
    const Vec3 to_right = right + sway(leaf.anchor, right, plant);
    return {0.5 * (to_left + to_right), leaf.tip + sway(leaf.anchor, leaf.tip, plant),
            0.5 * (to_right - to_left)};
  }
  const Vec3 at_root = sway(leaf.anchor, leaf.root, plant);
  const Vec3 at_tip = sway(leaf.anchor, leaf.tip, plant);
  return {leaf.root + at_root, leaf.tip + at_tip,
          twisted(layout_.motion.warp, Vec3(leaf.tip - leaf.root), leaf.side, at_tip)};
}

}  // namespace vegetation_sim::canopy
