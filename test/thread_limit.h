// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <fstream>

namespace vegetation_sim {

inline void setAddressSpace(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
  setrlimit(RLIMIT_AS, &limit);
}

/// Leaves no address space for the stacks of threads.
inline void exhaustThreads() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  setAddressSpace(pages * 4096 + (1u << 20));
}
inline void allowThreads() {
  setAddressSpace(RLIM_INFINITY);
}

}  // namespace vegetation_sim
