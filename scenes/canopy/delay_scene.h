// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <deque>

#include "scenes/canopy/plane_scene.h"
#include "vegetation_sim/canopy/flow/fluid.h"
#include "vegetation_sim/canopy/flow/oscillator.h"
#include "vegetation_sim/canopy/layers/layer_delay.h"

// A layer behind the first one in gusts; shared by tests and benches.

namespace vegetation_sim::canopy {

inline LayerView viewOf(const LayerSettings& settings, const History& history) {
  return {&settings, &history, 1.0 / 30.0, Vec3(0.0, 0.0, 1.0), 1.0, 4.0 / history.size()};
}

/// Relative error of a delayed layer in a gusty wind, compared with the motion of the first layer
/// in double precision at four times the rate.
struct GustErrors {
  double history{0.0}, lookup{0.0}, nothing{0.0};
};
/// @param delay [s], a multiple of a quarter of a tick of 1/30 s, below 1 s.
inline GustErrors errorsInGusts(double delay) {
  constexpr int FINE = 4;
  constexpr double TICK = 1.0 / 30.0;
  SourceSettings sources;
  sources.sides[0] = {5.0, 0.4};
  FluidSettings fluid_settings;
  fluid_settings.cells = 32;
  Fluid fluid(fluid_settings, sources, 5);
  Oscillator leaves({}, 32, 4.0);
  History history(32, 31);
  std::deque<PlaneField> truth;
  GustErrors out;
  double norm = 0.0;
  for (int i = 0; i < 300 * FINE; ++i) {
    fluid.advance(i * TICK / FINE, TICK / FINE);
    leaves.advance(TICK / FINE, fluid.state().flow, 0.0);
    truth.push_front(leaves.motion());
    if (truth.size() > 31 * FINE) truth.pop_back();
    if (i % FINE != 0) continue;
    history.push(toFrame(leaves.motion(), 0.0));
    if (i < 100 * FINE) continue;
    LayerSettings settings;
    LayerMotion layer;
    const PlaneField& wanted = truth[static_cast<std::size_t>(std::lround(delay / TICK * FINE))];
    const auto square = [&](const PlaneField& got) {
      const double error = relativeError(got, wanted);
      return error * error * energyOf(wanted);
    };
    norm += energyOf(wanted);
    out.nothing += square(truth.front());
    layerMotion(viewOf(settings, history), 2.0 * delay, 1.0, 2.0, layer);
    out.history += square(layer.plane);
    settings.model = LayerModel::LOOKUP;
    layerMotion(viewOf(settings, history), 2.0 * delay, 1.0, 2.0, layer);
    out.lookup += square(layer.plane);
  }
  for (double* value : {&out.history, &out.lookup, &out.nothing}) *value = std::sqrt(*value / norm);
  return out;
}

}  // namespace vegetation_sim::canopy
