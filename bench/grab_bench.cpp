// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a grab for a forest: each tick before, during and after one grab among 256
// trees, and a whole tree of 1 000 branches from its seed to its first physical step. Processor
// time.
// usage: grab_bench [ROUNDS]

#include <cstdio>
#include <cstdlib>

#include "processor_time.h"
#include "scenes/forest/level_scene.h"
#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

wind::Field breeze() {
  wind::Primitive out = makeBreeze(1, Vec3(4, 2, 0));
  out.turbulence = 0.2;
  out.epoch = PHYSICS_START;
  return wind::Field({out});
}

// ---- one grab among 256 trees ------------------------------------------------------------------

/// Advances and prints the median tick.
void printPhase(PhysicsRig& rig, const char* name, double duration,
                const std::function<void()>& each = {}) {
  std::vector<double> times;
  std::size_t branches = 0, blending = 0, bytes = 0;
  const auto ticks = static_cast<int>(duration * TICK_RATE + 0.5);
  for (int i = 0; i < ticks; ++i) {
    if (each) each();
    const double start = bench::processorTime();
    rig.advance();
    times.push_back(bench::processorTime() - start);
    const PhysicsFigures now = rig.forest.physicsFigures();
    branches = std::max(branches, now.branches);
    blending = std::max(blending, now.blending);
    bytes = std::max(bytes, now.bytes);
  }
  std::sort(times.begin(), times.end());
  std::printf("%-28s %10.3f %10.3f %10zu %10zu %10.1f\n", name, 1e3 * times[times.size() / 2],
              1e3 * times.back(), branches, blending, 1e-3 * static_cast<double>(bytes));
}

void benchGrab() {
  PhysicsRig rig({}, 16);
  rig.forest.setWind(breeze());
  std::printf("256 oaks in a breeze, a branch of depth 2 pulled 30 cm aside; a tick of %d Hz\n",
              TICK_RATE);
  std::printf("%-28s %10s %10s %10s %10s %10s\n", "", "ms, median", "ms, worst", "physical",
              "blending", "kB");
  printPhase(rig, "before", 1.0);
  Grab grab = rig.grabOf(rig.branchOfDepth(2));
  const std::uint32_t id = rig.forest.addGrab(grab);
  int pulled = 0;
  const auto pull = [&] {
    if (pulled++ >= TICK_RATE / 2) return;
    grab.target += Vec3(0.0, 0.3, -0.1) * (2.0 / TICK_RATE);
    rig.forest.moveGrab(id, grab.target);
  };
  printPhase(rig, "pulled, wind fades in", 0.5, pull);
  rig.run(0.7);
  printPhase(rig, "held", 1.0);
  rig.forest.release(id);
  printPhase(rig, "let go", 1.0);
  for (int i = 0; i < 20 * TICK_RATE && rig.forest.physicsFigures().blending == 0; ++i)
    rig.advance();
  printPhase(rig, "blends back", 1.0);
  rig.run(10.0);
  printPhase(rig, "after", 1.0);
  std::printf("\n");
}

// ---- promotion ---------------------------------------------------------------------------------

// Measures from the request to the end of the first step: grown, weighed, all of it physical.
void benchPromotion(int rounds) {
  PhysicsSettings settings;
  settings.promotion = Promotion::DEPTH;
  PhysicsRig rig(settings);
  const Layout layout = richLayout(1, 12.0, 1000);
  rig.forest.setLayout(layout, flatTerrain());
  rig.tree = growTree(layout, 0, rig.forest.terrain());
  rig.forest.setWind(breeze());
  rig.run(2.0);
  const ForestSnapshot procedural = rig.forest.snapshot();
  const Nanoseconds first = rig.now() + NANOSECONDS_PER_SECOND / PHYSICS_RATE;
  double sink = 0.0;
  std::vector<bench::Candidate> candidates{
      {"a tick without physics",
       [&] {
         rig.forest.restore(procedural);
         rig.forest.advance(first);
       }},
      {"grown from its seed",
       [&] { sink += growTree(layout, 0, rig.forest.terrain()).skeleton.height; }},
      {"its wood weighed",
       [&] { sink += woodOf(rig.tree.skeleton, layout.species[0], Material::BEAM).reach[0]; }},
      {"seed to first step", [&] {
         rig.forest.restore(procedural);
         rig.touch(rig.twig(), 1.0);
         rig.forest.advance(first);
       }}};
  bench::timeOnProcessor(candidates, rounds);
  std::printf("promotion of a whole oak of %zu branches in a breeze (%zu physical), bar 2 ms\n",
              rig.branches().size(), rig.forest.physicsFigures().branches);
  for (const bench::Candidate& c : candidates)
    std::printf("%-28s %10.3f ms\n", c.name.c_str(), 1e3 * c.seconds);
  std::printf("%-28s %10.3f ms\n", "promotion alone",
              1e3 * (candidates[3].seconds - candidates[0].seconds));
  if (sink < 0.0) std::printf("\n");
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 51;
  vegetation_sim::forest::benchGrab();
  vegetation_sim::forest::benchPromotion(rounds);
  return 0;
}
