// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// MOVE continues the track of a source, or puts it down. PLACE puts it down and begins a new pass.
/// LIFT takes it off the ground. STROKE puts it down at the start, moves it and takes it off.
enum class TreadAction : int { MOVE = 0, PLACE = 1, LIFT = 2, STROKE = 3 };

/// An input of a source of treading.
struct TreadInput {
  std::string source;  ///< name of the source
  TreadAction action{TreadAction::MOVE};
  Vec3 start{Vec3::Zero()};     ///< start of a STROKE, world [m]
  Vec3 position{Vec3::Zero()};  ///< world [m]
  double height_gate{0.3};      ///< A source higher than this above the ground does not tread [m].
  /// World [m/s]; if there is none, it follows from the last two positions.
  std::optional<Vec3> velocity;
  TreadLaw law;
  std::string body_frame;  ///< frame of the body that the drag acts on; empty: no drag is computed
};
/// Adds the faults of an input; `context` names the input.
void check(const TreadInput& input, const std::string& context, Faults& faults);

}  // namespace vegetation_sim::grass
