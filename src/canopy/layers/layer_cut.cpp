// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/layer_cut.h"

#include <algorithm>
#include <limits>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double NEAR_PLANE = 0.05;  // [m] nothing nearer is visible

}  // namespace

void describe(FieldVisitor& v, CutSettings& s) {
  v.integer("near_layers", s.near_layers, "", {0, MOST_LAYERS});
  v.integer("mid_layers", s.mid_layers, "", {0, MOST_LAYERS});
  v.integer("far_layers", s.far_layers, "", {0, MOST_LAYERS});
  v.number("near_end", s.near_end, "m", {0.1, 10000.0});
  v.number("mid_end", s.mid_end, "m", {0.1, 10000.0});
  v.number("turn", s.turn, "rad", {0.001, 3.0});
  v.number("shift", s.shift, "", {0.01, 10.0});
  v.number("cross_fade", s.cross_fade, "s", {0.01, 60.0});
}

void check(CutSettings settings, const std::string& context, Faults& faults) {
  FieldChecker checker(context, faults);
  describe(checker, settings);
  const int count = settings.near_layers + settings.mid_layers + settings.far_layers;
  if (count < 1 || count > MOST_LAYERS)
    faults.add(context + "near_layers + mid_layers + far_layers = " + std::to_string(count) +
               " is outside 1 to " + std::to_string(MOST_LAYERS));
  if (settings.mid_end < settings.near_end)
    faults.add(context + "mid_end = " + std::to_string(settings.mid_end) + " m is below near_end");
}

LayerCut::LayerCut(const CutView& view, const CutSettings& settings, double nearest,
                   double farthest)
    : eye_(view.position), axes_(axesOf(view.orientation)) {
  nearest = std::max(NEAR_PLANE, nearest);
  farthest = std::max(nearest, farthest);
  std::vector<double> middles;
  double begin = nearest;
  if (farthest > nearest) thickness_ = farthest - nearest;
  const auto region = [&](int layers, double end) {
    end = std::min(end, farthest);
    if (layers < 1 || end <= begin) return;
    const double step = (end - begin) / layers;
    thickness_ = std::min(thickness_, step);
    for (int i = 0; i < layers; ++i) {
      middles.push_back(begin + (i + 0.5) * step);
      ends_.push_back(begin + (i + 1) * step);
    }
    begin = end;
  };
  region(settings.near_layers, settings.near_end);
  region(settings.mid_layers, settings.mid_end);
  region(settings.far_layers, farthest);
  if (middles.empty()) middles.push_back(nearest);
  if (!ends_.empty()) ends_.pop_back();
  first_ = middles.front();
  distances_.clear();
  for (const double middle : middles) distances_.push_back(middle - first_);
}

int LayerCut::layerAt(const Vec3& root) const {
  const double depth = depthOf(root);
  return static_cast<int>(std::upper_bound(ends_.begin(), ends_.end(), depth) - ends_.begin());
}

std::array<double, 2> LayerCut::depthsOf(int layer) const {
  constexpr double ENDLESS = std::numeric_limits<double>::infinity();
  const auto i = static_cast<std::size_t>(layer);
  return {i == 0 ? -ENDLESS : ends_[i - 1], i < ends_.size() ? ends_[i] : ENDLESS};
}

bool LayerCut::leftBy(const CutView& view, const CutSettings& settings) const {
  const Axes now = axesOf(view.orientation);
  const double limit = sinCos(settings.turn).cos;
  if (dot(now.out, axes_.out) < limit || dot(now.up, axes_.up) < limit) return true;
  const double thick = std::max(thickness_, NEAR_PLANE);
  return length(Vec3(view.position - eye_)) > settings.shift * thick;
}

}  // namespace vegetation_sim::canopy
