// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <functional>

#include "modal/measure.h"
#include "trees/modal_engine.h"

namespace vegetation_sim::bench {
namespace {

constexpr int STEPS = 3;   // per interval of 50 ms: 60 Hz
constexpr int PARTS = 32;  // per frame, for the full chain
constexpr double NO_CAP = 1e9;

Reference referenceFor(const TestTree& tree, const TestLoad& load, const ModalOptions& options) {
  return referenceOf(tree, load, Bend::SWING, 1e-4, 60.0, options.cache);
}

// The first frame of a sudden load: largest motion of a tip, and its largest distance from the full
// chain [mm].
struct FirstFrame {
  double way{0.0}, off{0.0};
};

FirstFrame firstFrame(Engine& engine, Engine& full, int steps = 1) {
  constexpr double FRAME = 1.0 / 60.0;
  engine.rest();
  full.rest();
  const std::vector<Vec3> rest = full.tips();
  for (int i = 0; i < steps; ++i) engine.step(0, FRAME * i / steps, FRAME / steps);
  for (int i = 0; i < PARTS; ++i) full.step(0, FRAME * i / PARTS, FRAME / PARTS);
  const std::vector<Vec3> a = engine.tips(), b = full.tips();
  FirstFrame out;
  for (std::size_t i = 0; i < a.size(); ++i) {
    out.way = std::max(out.way, 1e3 * (a[i] - rest[i]).norm());
    out.off = std::max(out.off, 1e3 * (a[i] - b[i]).norm());
  }
  return out;
}

// Returns a load as strong from the first moment on.
TestLoad stepping(TestLoad load) {
  load.kind = TestLoad::Kind::PULL;
  return load;
}

std::unique_ptr<Engine> fullChain(const TestTree& tree, const TestLoad& load) {
  return ownEngines().front().make(tree, load, "");
}

double errorOf(Engine& engine, const Reference& reference, int steps) {
  return relativeError(drive(engine, reference, steps, NO_CAP).motion, reference);
}

/// A tree under a load, and under one as strong from the first moment on.
struct Scene {
  Scene(const TestTree& on, const TestLoad& under, const ModalOptions& options)
      : tree(on),
        load(under),
        step(stepping(under)),
        options(options),
        reference(referenceFor(on, under, options)),
        full(fullChain(on, step)) {}

  void printPlain(const char* name, double error, const FirstFrame& first, double cost) const {
    if (options.table)
      options.table->row(load.name(), tree.links.size(), name, -1, -1, error, first.off, cost, 0.0,
                         0.0);
    std::printf("| %-14s |      | %6.2f %% |       | %6.1f | %6.1f |       |\n", name,
                100.0 * error, first.way, first.off);
  }
  void printModes(int modes, int vectors) const {
    const double before = processorTime();
    ModalEngine engine(tree, load, modes, vectors);
    const double found = processorTime() - before;
    ModalEngine stepped(tree, step, modes, vectors);
    const double error = errorOf(engine, reference, STEPS), turn = engine.largestTurn();
    const FirstFrame first = firstFrame(stepped, *full);
    char name[40];
    std::snprintf(name, sizeof name, "%d modes + %d", modes, vectors);
    std::printf("| %-14s | %4zu | %6.2f %% | %5.2f | %6.1f | %6.1f | %5.0f |\n", name,
                engine.modes().size(), 100.0 * error, turn, first.way, first.off,
                8e-3 * static_cast<double>(engine.modes().shape.size()));
    if (options.table)
      options.table->row(load.name(), tree.links.size(), "modes", modes, vectors, error, first.off,
                         modalCost(engine.modes()), 1e3 * found,
                         1e-3 * static_cast<double>(engine.modes().bytes()));
  }

  const TestTree& tree;
  const TestLoad &load, step;
  const ModalOptions& options;
  Reference reference;
  std::unique_ptr<Engine> full;
};

// Returns the cost of four steps per frame, as forest_animator takes them.
double costOfSteps(Engine& engine, const TestTree& tree) {
  engine.rest();
  return 4.0 * costOf([&] { engine.step(0, 0.0, 1.0 / 240.0); }, tree.links.size());
}

}  // namespace

void measureErrors(const TestTree& tree, const TestLoad& load, const ModalOptions& options) {
  const Scene scene(tree, load, options);
  std::printf("\n%s, %zu branches; first frame of a load that steps: way of a tip, off the full\n",
              load.name(), tree.links.size());
  std::printf("| model          | size | error    | turn  | way mm | off mm | kB    |\n");
  const std::unique_ptr<Engine> finer = fullChain(tree, scene.step);
  scene.printPlain("full chain", errorOf(*fullChain(tree, load), scene.reference, 4 * STEPS),
                   firstFrame(*finer, *scene.full, PARTS), costOfSteps(*finer, tree));
  StaticEngine still(tree, load), stepped(tree, scene.step);
  scene.printPlain("procedural", errorOf(still, scene.reference, STEPS),
                   firstFrame(stepped, *scene.full), options.procedural);
  for (const Maker& maker : ownEngines()) {
    if (maker.name != "paper dynamics, midpoint") continue;
    const std::unique_ptr<Engine> paper = maker.make(tree, scene.step, "");
    scene.printPlain("paper dynamics", errorOf(*maker.make(tree, load, ""), scene.reference, 50),
                     firstFrame(*paper, *scene.full, PARTS), costOfSteps(*paper, tree));
  }
  for (const int modes : {1, 2, 5, 10, 20})
    for (const int vectors : {0, 1}) scene.printModes(modes, vectors);
  for (const auto& [modes, vectors] : {std::pair{5, 2}, {20, 2}, {0, 10}, {4, 5}, {8, 6}, {10, 10}})
    scene.printModes(modes, vectors);
}

void measureLimit(const TestTree& tree, const ModalOptions& options) {
  std::printf("\ngust by strength, %zu branches, 5 modes + 1: largest turn and error\n",
              tree.links.size());
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    TestLoad load = gust(tree);
    for (Vec3& force : load.force) force *= factor;
    const Reference reference = referenceFor(tree, load, options);
    ModalEngine engine(tree, load, 5, 1);
    const double error = errorOf(engine, reference, STEPS);
    std::printf("| %4.0f x | %5.2f rad | %6.2f %% |\n", factor, engine.largestTurn(),
                100.0 * error);
  }
}

}  // namespace vegetation_sim::bench
