// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// What a user asks for: a primitive, and the tf frame that its centre follows, if any. The id is
/// given by the PrimitiveSchedule that takes it.
struct Source {
  Primitive primitive;
  std::string attached_frame;  ///< empty: not tied
};

/// All faults of one source: those of its primitive, and those of checkFrame().
void check(const Source& source, Faults& faults);

/// Faults of the frame, and of what does not go with one.
void checkFrame(const Source& source, Faults& faults);

/// The same source with all its stamps later by `start`. A t_off of 0 stays "for ever".
Source startedAt(Source source, Nanoseconds start);

}  // namespace vegetation_sim::wind
