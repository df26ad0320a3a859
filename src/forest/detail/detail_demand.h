// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "forest/contact/contact_body.h"
#include "tree/lod/tree_tiers.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/tree/state/viewer.h"

namespace vegetation_sim::forest {

/// Settings that can change at run time.
struct Settings {
  double tolerance{1.0};  ///< error that a viewer may see [pixel]
  int fixed_level{2};     ///< of trees where neither bodies nor listeners require another
  int highest_level{MAX_DEPTHS};
  double robot_tolerance{0.05};  ///< error near the bodies of robots [m]
  double robot_range{3.0};       ///< distance to a body within which robot_tolerance holds [m]
  Budget budget;
};
void describe(FieldVisitor& visitor, Settings& settings);

/// Budget of the changes of levels that one group of listeners receives [B/s], and what one takes
/// at most in a message [B].
constexpr double DELTA_BYTES = 5e6, ENTRY_BYTES = 61.0;
/// Returns how many trees may change their level for a group of listeners in a tick, at least one,
/// and any number if no time passes. It depends on stamps and sizes only.
std::size_t changesWithin(Nanoseconds from, Nanoseconds to);

/// The detail that one group of listeners requires of the trees.
struct DetailDemand {
  /// A ball in which errors may not exceed a tolerance [m].
  struct Place {
    Vec3 centre;
    double range, tolerance;
  };
  std::vector<Viewpoint> eyes;
  std::vector<Place> places;
  int base{0};                  ///< level of the trees that neither eyes nor places require
  bool frame_time_binds{true};  ///< limits the cost of all tiers to Budget::frame_time
  /// Number of trees whose level may change in this tick; those with more error go first.
  std::size_t most_changes{std::numeric_limits<std::size_t>::max()};

  bool empty() const { return eyes.empty() && places.empty(); }
  /// Returns the pixels that a metre of error in a ball counts as: those of the viewer that sees it
  /// best, or the tolerance of viewers per tolerance of a place.
  double pixelsPerMetre(const Vec3& centre, double reach, double tolerance) const;
};

/// Returns the detail that settings and bodies require of the world; listeners do not affect it.
DetailDemand worldDemand(const Settings& settings, const Bodies& bodies);
/// Returns the detail that sensors perceive: that of the world, or finer.
DetailDemand sensorDemand(const Settings& settings, const Bodies& bodies,
                          const std::map<std::string, Sensor>& sensors);
/// Returns the detail that displays draw. Without viewers, trees have the level of the settings.
DetailDemand viewDemand(const Settings& settings, const Bodies& bodies,
                        const std::vector<Viewpoint>& viewers);

}  // namespace vegetation_sim::forest
