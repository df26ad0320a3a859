// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::forest {

/// Share of a tree's lag (lag.h) that its modes are off themselves, against the full chain, at the
/// farthest tip. Below 1: what costs more is never the worse.
constexpr double MODAL_SHARE = 0.62;
static_assert(MODAL_SHARE < 1.0);
/// Share of the motion per turn that gathers along a way [1/rad] by which modes are off, and the
/// procedural motion too: both take levers at rest (docs/modal.md).
constexpr double BENT_SHARE = 0.075;

}  // namespace vegetation_sim::forest
