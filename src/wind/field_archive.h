// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::wind {

/// Writes or reads a primitive. The caller checks the primitive that it has read.
void archive(Archive& a, Primitive& primitive);
/// Writes or reads a field. @throws InvalidInput with the faults of all primitives.
void archive(Archive& a, Field& field);

}  // namespace vegetation_sim::wind
