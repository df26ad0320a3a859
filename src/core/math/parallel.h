// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace vegetation_sim {

/// Calls `part(0)` to `part(parts - 1)`, each in a thread of its own, the first in the caller's.
/// Where the machine has no more threads, the caller's does the remaining parts. A part must not
/// throw.
template <class Part>
void runInParallel(std::size_t parts, const Part& part) {
  std::vector<std::thread> others;
  others.reserve(parts);
  std::size_t next = 1;
  try {
    for (; next < parts; ++next) others.emplace_back(part, next);
  } catch (const std::system_error&) {
  }
  if (parts > 0) part(0);
  for (; next < parts; ++next) part(next);
  for (std::thread& other : others) other.join();
}

}  // namespace vegetation_sim
