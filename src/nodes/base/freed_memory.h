// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

/// Freed memory that a process keeps for later at most [bytes].
constexpr std::size_t MOST_FREED_MEMORY = 4'000'000;

/// Returns freed memory to the system if the process keeps more than MOST_FREED_MEMORY. After a
/// flood of large messages glibc keeps theirs: its threads allocate in arenas of their own, and it
/// shrinks each at its end only.
void releaseFreedMemory();

}  // namespace vegetation_sim
