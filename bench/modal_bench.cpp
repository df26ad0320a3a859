// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the modal tier (N13): error against full dynamics by number of modes, beside the
// procedural tier and paper 1's dynamics; the first frame of a sudden load; the rotation at which
// modes cease to hold; levers that turn; cost of finding and of posing; ticks that start modes.
// usage: modal_bench [--quick | --full | --ticks] [--cache FOLDER] [--csv FILE]
// --full adds trees of 10 000 branches, --ticks measures nothing but ticks.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "modal/measure.h"
#include "scenes/forest/modal_scene.h"

namespace vegetation_sim::bench {
namespace {

const std::vector<forest::ModalDepth> DEPTHS{
    {0, 1, 1, false}, {6, 1, 1, false}, {20, 1, 1, false}, {4, 4, 1}, {}};

// Returns the additional cost of wind and step of a tree in modes.
double breezeCost(const forest::Swaying& scene, forest::ModalDepth depth) {
  const forest::ModalTree modal(scene.tree(), scene.species(), depth);
  const wind::Instant air = scene.field().at(forest::MODAL_START);
  forest::ModalAir kept;
  std::vector<double> load;
  return modalCost(modal.modes()) +
         costOf([&] { modal.loadOf(air, kept, load); }, scene.tree().skeleton.branches.size());
}

void measureSpecies(const ModalOptions& options) {
  const wind::Field breeze({forest::makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3);
  std::printf("\nbreeze of 5 m/s, species of the package: error by modes + vectors each side\n");
  std::printf("| species | procedural | 0 + 1 | 6 + 1 | 20 + 1 | 4 + 5 | 8 + 6 |\n");
  for (std::uint32_t id = 0; id < 4; ++id) {
    const forest::Swaying scene(id, breeze, options.duration);
    const std::string load = "breeze, " + forest::speciesNames()[id];
    const std::size_t branches = scene.tree().skeleton.branches.size();
    const double procedural = scene.proceduralError();
    std::printf("| %-7s | %8.1f %% |", forest::speciesNames()[id].c_str(), 100.0 * procedural);
    if (options.table)
      options.table->row(load, branches, "procedural", -1, -1, procedural, 0.0, options.procedural,
                         0.0, 0.0);
    for (const forest::ModalDepth depth : DEPTHS) {
      const double error = scene.modalError(depth);
      std::printf(" %4.1f %% |", 100.0 * error);
      if (options.table)
        options.table->row(load, branches, "modes", depth.modes, depth.sideways + depth.quick,
                           error, 0.0, breezeCost(scene, depth), 0.0, 0.0);
    }
    std::printf("\n");
  }
}

int run(int argc, char** argv) {
  ModalOptions options;
  std::string csv;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--quick")) {
      options.branches = {100};
      options.duration = 1.0;
    } else if (!std::strcmp(argv[i], "--full")) {
      options.branches.push_back(10000);
    } else if (!std::strcmp(argv[i], "--ticks")) {
      measureTicks();
      return 0;
    } else if (!std::strcmp(argv[i], "--cache") && i + 1 < argc) {
      options.cache = argv[++i];
    } else if (!std::strcmp(argv[i], "--csv") && i + 1 < argc) {
      csv = argv[++i];
    } else {
      throw std::invalid_argument(std::string(argv[i]) + ": unknown, or its value is missing");
    }
  }
  if (!options.cache.empty()) std::filesystem::create_directories(options.cache);
  Table table(csv, MODAL_COLUMNS);
  options.table = &table;
  options.procedural = proceduralCost();
  for (const int branches : options.branches) {
    const TestTree tree = fractalTree(branches);
    measureFinding(tree, options.rounds);
    for (const TestLoad& load : {gust(tree), pull(tree)}) measureErrors(tree, load, options);
  }
  measureSpecies(options);
  if (!csv.empty()) return 0;  // the following parts have no rows in the table
  measureLimit(fractalTree(std::min(1000, options.branches.back())), options);
  measureBending();
  measurePosing(options.rounds);
  measureTicks();
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
