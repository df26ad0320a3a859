// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The program that libFuzzer drives.
// usage: fuzz --target=NAME [libFuzzer options] [FOLDER ...]
//        fuzz --seeds=FOLDER    writes the seeds of all targets into a folder for each
//        fuzz --list            prints the names of all targets
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>

#include "fuzz/cost.h"
#include "fuzz/fuzz_target.h"

namespace vegetation_sim::fuzz {
namespace {

/// Code under sanitizers is up to this much slower than the code that is shipped: about ten times,
/// and growth of trees, whose vectors clang emulates at -O1, seventeen times.
constexpr double SLOWNESS = 18.0;

const Target* target = nullptr;
std::atomic<long> live_bytes{0}, peak_bytes{0};

void onMalloc(const volatile void*, std::size_t size) {
  const long now = live_bytes += static_cast<long>(size);
  if (now > peak_bytes) peak_bytes = now;
}

void onFree(const volatile void* block) {
  if (block)
    live_bytes -= static_cast<long>(__sanitizer_get_allocated_size(const_cast<const void*>(block)));
}

/// Value of an option --NAME=VALUE; null if it is not given.
const char* optionOf(int argc, char** argv, const char* name) {
  for (int i = 1; i < argc; ++i)
    if (!std::strncmp(argv[i], name, std::strlen(name))) return argv[i] + std::strlen(name);
  return nullptr;
}

void writeSeeds(const std::filesystem::path& folder) {
  for (const Target& each : allTargets()) {
    std::filesystem::create_directories(folder / each.name);
    int number = 0;
    for (const std::string& seed : each.seeds())
      std::ofstream(folder / each.name / ("seed_" + std::to_string(number++)), std::ios::binary)
          << seed;
  }
}

/// Handles the options of this program. @return whether a target is to be fuzzed.
bool prepare(int argc, char** argv) {
  if (const char* folder = optionOf(argc, argv, "--seeds=")) return writeSeeds(folder), false;
  const char* name = optionOf(argc, argv, "--target=");
  if (name) return target = &findTarget(name), true;
  for (const Target& each : allTargets()) std::printf("%s\n", each.name);
  return false;
}

/// Returns the processor time of a run [s].
double secondsOf(std::string_view input) {
  const double start = processorSeconds();
  target->run(input);
  return processorSeconds() - start;
}

/// An input that seems slow is run again, since other processes disturb the time.
void runOnce(std::string_view input) {
  peak_bytes = live_bytes.load();
  const long before = live_bytes;
  double seconds = secondsOf(input);
  for (int i = 0; i < 2 && seconds > SLOWNESS * MOST_SECONDS; ++i)
    seconds = std::min(seconds, secondsOf(input));
  if (seconds > SLOWNESS * MOST_SECONDS) {
    std::fprintf(stderr, "SLOW: %.3f s\n", seconds);
    std::abort();
  }
  if (const long bytes = peak_bytes - before; bytes > mostBytes(input.size())) {
    std::fprintf(stderr, "LARGE: %ld bytes\n", bytes);
    std::abort();
  }
}

}  // namespace
}  // namespace vegetation_sim::fuzz

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  using namespace vegetation_sim::fuzz;
  try {
    if (!prepare(*argc, *argv)) std::exit(0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz: %s\n", error.what());
    std::exit(2);
  }
  __sanitizer_install_malloc_and_free_hooks(onMalloc, onFree);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vegetation_sim::fuzz::runOnce({reinterpret_cast<const char*>(data), size});
  return 0;
}
