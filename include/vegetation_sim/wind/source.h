// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

/// The description of a source by a user: a primitive, and the tf frame that its centre follows, if
/// any. The PrimitiveSchedule that takes it assigns the id.
struct Source {
  Primitive primitive;
  std::string attached_frame;  ///< empty if the source is not attached
};

/// Adds all faults of one source: those of its primitive, and those of checkFrame().
void check(const Source& source, Faults& faults);

/// Adds the faults of the frame, and of fields that cannot go with one.
void checkFrame(const Source& source, Faults& faults);

/// Returns the same source with all its stamps later by `start`. A t_off of 0 stays "never".
Source startedAt(Source source, Nanoseconds start);

}  // namespace vegetation_sim::wind
