// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

/// Bytes that the test program's operator new has handed out and not got back.
long liveBytes();
/// How often it was asked.
std::size_t allocationCount();

}  // namespace vegetation_sim
