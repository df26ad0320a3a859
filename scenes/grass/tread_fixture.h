// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;

inline Nanoseconds after(double seconds) {
  return START + fromSeconds(seconds);
}

inline TreadLaw permanent() {
  TreadLaw law;
  law.recovery = PERMANENT_RECOVERY;
  return law;
}

// A map of 20 m with nodes 5 cm apart.
class Treading : public testing::Test {
 protected:
  static MapLaw mapLaw() {
    MapLaw law;
    law.columns = law.rows = 11;
    return law;
  }
  static TreadMap makeMap(double spacing = 0.05, double cap = 128e6) {
    TreadSettings settings;
    settings.spacing = spacing;
    settings.memory_cap = cap;
    return TreadMap(mapLaw(), settings);
  }

  // Walks from a to b in equal steps, all at one stamp.
  static void walk(TreadMap& map, const TreadLaw& law, const Point& a, const Point& b, int steps,
                   Nanoseconds stamp, std::uint32_t source = 1) {
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      map.tread(source, law, {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, stamp);
    }
  }

  TreadMap map_{makeMap()};
};

}  // namespace vegetation_sim::grass
