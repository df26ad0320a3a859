// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The modal rung (N13): error against full dynamics by number of modes, beside the procedural rung
// and paper 1's dynamics; what a step of the load does in one frame; rotation at which modes cease
// to hold; cost of finding and of posing. usage: modal_bench [--quick | --full] [--cache FOLDER]
// --full: trees of 10 000 branches too.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "forest/modal_scene.h"
#include "modal/measure.h"

namespace vegetation_sim::bench {
namespace {

void measureSpecies(const ModalOptions& options) {
  const wind::Field breeze({forest::makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3);
  std::printf("\nbreeze of 5 m/s, species of the package: error by modes + vectors each side\n");
  std::printf("| species | procedural | 0 + 1 | 6 + 1 | 20 + 1 | 4 + 5 | 10 + 5 |\n");
  for (std::uint32_t id = 0; id < 4; ++id) {
    const forest::Swaying scene(id, breeze, options.duration);
    std::printf("| %-7s | %8.1f %% |", forest::speciesNames()[id].c_str(),
                100.0 * scene.proceduralError());
    for (const forest::ModalDepth depth :
         {forest::ModalDepth{0, 1, 1}, {6, 1, 1}, {20, 1, 1}, {4, 5, 1}, {10, 5, 1}})
      std::printf(" %4.1f %% |", 100.0 * scene.modalError(depth));
    std::printf("\n");
  }
}

int run(int argc, char** argv) {
  ModalOptions options;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--quick")) {
      options.branches = {100};
      options.duration = 1.0;
    } else if (!std::strcmp(argv[i], "--full")) {
      options.branches.push_back(10000);
    } else if (!std::strcmp(argv[i], "--cache") && i + 1 < argc) {
      options.cache = argv[++i];
    } else {
      throw std::invalid_argument(std::string(argv[i]) + ": unknown, or its value is missing");
    }
  }
  if (!options.cache.empty()) std::filesystem::create_directories(options.cache);
  for (const int branches : options.branches) {
    const TestTree tree = fractalTree(branches);
    measureFinding(tree, options.rounds);
    for (const TestLoad& load : {gust(tree), pull(tree)}) measureErrors(tree, load, options);
  }
  measureLimit(fractalTree(std::min(1000, options.branches.back())), options);
  measureSpecies(options);
  measurePosing(options.rounds);
  return 0;
}

}  // namespace
}  // namespace vegetation_sim::bench

int main(int argc, char** argv) {
  try {
    return vegetation_sim::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "modal_bench: %s\n", error.what());
    return 1;
  }
}
