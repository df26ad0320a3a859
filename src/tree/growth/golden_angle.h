// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::forest {

/// Angle between successive laterals or leaves around their parent [rad]: pi (3 - sqrt 5).
constexpr double GOLDEN_ANGLE = 2.399963229728653;

}  // namespace vegetation_sim::forest
