// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Replaces operator new and delete of the test programs with versions that count.
#include "heap.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> live_bytes{0}, peak_bytes{0};
std::atomic<std::size_t> allocations{0};
}  // namespace

namespace vegetation_sim {

long liveBytes() {
  return live_bytes;
}
long peakBytes() {
  return peak_bytes;
}
void restartPeak() {
  peak_bytes = live_bytes.load();
}
std::size_t allocationCount() {
  return allocations;
}

}  // namespace vegetation_sim

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* out = std::malloc(size > 0 ? size : 1);
  if (out == nullptr) return nullptr;
  ++allocations;
  const long now = live_bytes += static_cast<long>(malloc_usable_size(out));
  if (now > peak_bytes) peak_bytes = now;
  return out;
}
void* operator new(std::size_t size) {
  if (void* out = operator new(size, std::nothrow)) return out;
  throw std::bad_alloc();
}
void operator delete(void* block) noexcept {
  if (block == nullptr) return;
  live_bytes -= static_cast<long>(malloc_usable_size(block));
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  operator delete(block);
}
