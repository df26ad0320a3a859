// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "grass/tread_simulation.h"
#include "scenes/grass/tread_fixture.h"

namespace vegetation_sim::grass {

/// A flat meadow of 20 m with sources, at 30 ticks a second.
class FieldTest : public Treading {
 protected:
  static TreadInput input(const std::string& source, double x, double y, double z = 0.0,
                          TreadAction action = TreadAction::MOVE) {
    TreadInput out;
    out.source = source;
    out.action = action;
    out.position = Vec3(x, y, z);
    out.body_frame = source + "_link";
    return out;
  }
  /// Drives a source eastward at `speed` [m/s] for some ticks, from (x, y) at the next tick.
  void drive(const std::string& source, double x, double y, double speed, int ticks,
             double z = 0.0) {
    for (int i = 0; i < ticks; ++i) {
      ++tick_;
      field_.apply(input(source, x + speed * i / 30.0, y, z), now());
      field_.advance(now());
    }
  }
  Nanoseconds now() const { return START + tick_ * NANOSECONDS_PER_SECOND / 30; }

  Layout layout_;
  std::int64_t tick_{0};
  TreadSimulation field_{makeField(map_)};

  TreadSimulation makeField(TreadMap& map) {
    MapInput map_input;
    map_input.law = mapLaw();
    layout_.map = std::make_shared<const FeatureMap>(map_input);
    layout_.tread_spacing = map.spacing();
    return TreadSimulation(layout_, std::make_shared<const terrain::HeightMap>(), TreadSettings(),
                           map);
  }
};

}  // namespace vegetation_sim::grass
