// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Replaces operator new and delete of the test programs with versions that count.
#include "heap.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
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
  auto* block = static_cast<std::max_align_t*>(std::malloc(size + sizeof(std::max_align_t)));
  if (block == nullptr) return nullptr;
  // The size that was asked for stands before the block. That of malloc_usable_size() may differ by
  // 16 bytes between two blocks of one size.
  std::memcpy(block, &size, sizeof(size));
  ++allocations;
  const long now = live_bytes += static_cast<long>(size);
  if (now > peak_bytes) peak_bytes = now;
  return block + 1;
}
void* operator new(std::size_t size) {
  if (void* out = operator new(size, std::nothrow)) return out;
  throw std::bad_alloc();
}
void operator delete(void* address) noexcept {
  if (address == nullptr) return;
  auto* block = static_cast<std::max_align_t*>(address) - 1;
  std::size_t size = 0;
  std::memcpy(&size, block, sizeof(size));
  live_bytes -= static_cast<long>(size);
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  operator delete(block);
}
