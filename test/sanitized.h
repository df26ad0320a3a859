// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim {

/// True in builds that watch every access, twenty times as slow: tests that only repeat a step take
/// fewer of them there.
#ifdef __SANITIZE_ADDRESS__
constexpr bool SANITIZED = true;
#else
constexpr bool SANITIZED = false;
#endif

}  // namespace vegetation_sim
