// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim {

/// Freed memory that a process keeps for later at most [bytes].
constexpr std::size_t MOST_FREED_MEMORY = 1'000'000;

/// Large blocks are returned to the system as soon as they are freed from this size on [bytes].
constexpr int LARGE_BLOCK = 1'000'000;
/// Regions from which glibc takes the smaller blocks.
constexpr int ARENAS = 2;

/// Sets how glibc allocates in this process. By itself it raises the size from which blocks are
/// returned at once to that of the largest one freed, so that one large message makes all later
/// ones split its heaps, and it gives each thread a heap of its own.
void limitFreedMemory();

/// Returns freed memory to the system if the process keeps more than MOST_FREED_MEMORY. After a
/// flood of large messages glibc keeps theirs: its threads allocate in arenas of their own, and it
/// shrinks each at its end only.
void releaseFreedMemory();

/// Returns the bytes of this process that are allocated and not freed; 0 with another library than
/// glibc.
std::size_t countUsedMemory();

}  // namespace vegetation_sim
