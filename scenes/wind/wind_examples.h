// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::wind {

inline Nanoseconds at(double seconds) {
  return fromSeconds(seconds);
}

/// A source at full strength from the first instant on, centred at the origin.
inline Primitive example(Kind kind, const std::string& name = "source") {
  Primitive p;
  p.id = 1;
  p.name = name;
  p.kind = kind;
  p.fade_in = p.fade_out = 0.0;
  return p;
}

/// The disk of the reference values: r = 10 m, w = 2 rad/s, |F| = 5.
inline Primitive printedDisk() {
  Primitive p = example(Kind::DISK);
  p.envelope = Envelope::PAPER;
  p.radius = 10.0;
  p.omega = 2.0;
  p.velocity = Vec3(5.0, 0.0, 0.0);
  return p;
}

/// Returns the same source with all its stamps later.
inline Primitive later(Primitive p, Nanoseconds shift) {
  p.epoch += shift;
  p.t_on += shift;
  if (p.t_off != 0) p.t_off += shift;
  for (Waypoint& point : p.trajectory) point.stamp += shift;
  return p;
}

/// Returns one source of each kind, with every feature of its own in use.
inline std::vector<Primitive> oneOfEach() {
  std::vector<Primitive> all;
  for (int kind = 0; kind < static_cast<int>(kindNames().size()); ++kind) {
    Primitive p = example(static_cast<Kind>(kind), kindNames()[static_cast<std::size_t>(kind)]);
    p.id = static_cast<std::uint32_t>(kind + 1);
    p.t_on = at(1.0);
    p.t_off = at(40.0);
    p.fade_in = 2.0;
    p.fade_out = 3.0;
    p.epoch = at(0.5);
    p.velocity = Vec3(4.0, 3.0, 0.5);
    p.phase = 0.3;
    p.orbit_radius = 3.0;
    p.orbit_period = 15.0;
    p.repeat = 25.0;
    p.trajectory = {{at(0.0), Vec3(-9.0, 2.0, 1.0)},
                    {at(8.0), Vec3(4.0, 5.0, 2.0)},
                    {at(30.0), Vec3(8.0, -6.0, 1.0)}};
    all.push_back(p);
  }
  return all;
}

}  // namespace vegetation_sim::wind
