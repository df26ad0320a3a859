// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

/// Returns the bytes that operator new has allocated and that were not freed.
long liveBytes();
/// Returns how often operator new was called.
std::size_t allocationCount();

}  // namespace vegetation_sim
