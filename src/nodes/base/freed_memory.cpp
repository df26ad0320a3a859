// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/freed_memory.h"

#include <malloc.h>

namespace vegetation_sim {

#ifdef __GLIBC__
namespace {

/// Bytes that the process keeps for later; before glibc 2.33 modulo 2^32.
std::size_t countFreedBytes() {
#if __GLIBC_PREREQ(2, 33)
  return mallinfo2().fordblks;
#else
  return static_cast<unsigned>(mallinfo().fordblks);
#endif
}

}  // namespace
#endif

void limitFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, LARGE_BLOCK);
  mallopt(M_ARENA_MAX, ARENAS);
#endif
}

std::size_t countUsedMemory() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;  // small and large blocks
#elif defined(__GLIBC__)
  const auto info = mallinfo();
  return std::size_t{static_cast<unsigned>(info.uordblks)} + static_cast<unsigned>(info.hblkhd);
#else
  return 0;
#endif
}

void releaseFreedMemory() {
#ifdef __GLIBC__
  if (countFreedBytes() > MOST_FREED_MEMORY) malloc_trim(0);
#endif
}

}  // namespace vegetation_sim
