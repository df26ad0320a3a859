// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::forest {

/// From one lateral, or leaf, to the next around its bearer [rad]: pi (3 - sqrt 5).
constexpr double GOLDEN_ANGLE = 2.399963229728653;

}  // namespace vegetation_sim::forest
