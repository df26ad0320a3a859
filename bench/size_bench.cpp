// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a frame over the number of trees, branches, physical branches, blades,
// trodden nodes, walkers and cells of a leaf field, from one on.
// usage: size_bench [--quick | --full] [--part NAME,..] [--csv FILE]
// Parts: trees, branches, physical, links, blades, nodes, walkers, cells.

#include <cstdio>

#include "crowd/agents/crowd.h"
#include "dynamics/batch_step/batch_chain.h"
#include "options.h"
#include "processor_time.h"
#include "scenes/dynamics/chain_scene.h"
#include "scenes/forest/level_scene.h"
#include "scenes/forest/physics_scene.h"
#include "scenes/grass/grass_fixture.h"
#include "table.h"
#include "vegetation_sim/canopy/flow/fluid.h"
#include "vegetation_sim/canopy/flow/oscillator.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim {
namespace {

using bench::Options;
using bench::Table;

/// Returns the median processor time of `work` over some rounds, each long enough to be measured
/// [s].
template <class Work>
double timeOf(const Options& options, const Work& work) {
  work();
  std::vector<double> times;
  for (int round = 0; round < (options.quick ? 3 : 7); ++round) {
    int repeats = 0;
    double spent = 0.0;
    const double start = bench::processorTime(), least = options.quick ? 1e-3 : 1e-2;
    for (; spent < least; spent = bench::processorTime() - start, ++repeats) work();
    times.push_back(spent / repeats);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void report(Table& table, const char* series, double size, double seconds) {
  std::printf("%-10s %10.0f %12.6f ms %10.2f ns each\n", series, size, 1e3 * seconds,
              1e9 * seconds / size);
  table.row(series, size, seconds);
}

/// Returns the limit for each of the three extents of a run.
double most(const Options& options, double quick, double usual, double full) {
  return options.quick ? quick : options.full ? full : usual;
}

// ---- forest -----------------------------------------------------------------------------------

// Measures trees in tiles of 16 with a viewer among them in a breeze: a tick chooses levels and
// publishes them.
void growTrees(const Options& options, Table& table) {
  for (double count = 1; count <= most(options, 1024, 65536, 1048576); count *= 4) {
    forest::Layout layout = forest::gridLayout(1, 8.0);
    layout.trees.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      forest::TreeSeed seed;
      seed.seed = i;
      seed.species = static_cast<std::uint16_t>(i % 4);
      seed.position = Vec3(8.0 * (i % 1024), 8.0 * (i / 1024), 0.0);
      layout.trees.push_back(seed);
    }
    forest::Forest trees(layout, forest::flatTerrain(), forest::Settings());
    trees.setWind(wind::Field({forest::makeBreeze(1, Vec3(5, 1, 0))}));
    const forest::Camera camera = forest::edgeCamera(std::sqrt(count) * 8.0);
    const TickGrid grid(30);
    std::int64_t tick = grid.tickAt(forest::PHYSICS_START);
    forest::settle(trees, camera, grid, tick, 60);
    tick += 60;
    report(table, "trees", count, timeOf(options, [&] {
             forest::settle(trees, camera, grid, tick++, 1);
             trees.update(false);
           }));
  }
}

// Measures batched poses at full depth.
void poseBranches(const Options& options, Table& table) {
  for (int side = 1; side * side <= most(options, 16, 256, 4096); side *= 2) {
    const forest::TreeBatch grove = forest::growTrees(forest::gridLayout(side, 8.0));
    const wind::Instant wind = forest::threeDiscs(8.0 * side).at(forest::PHYSICS_START);
    forest::BatchPoses poses;
    report(table, "branches", static_cast<double>(grove.branches), timeOf(options, [&] {
             for (std::size_t i = 0; i < grove.trees.size(); ++i)
               grove.posers[i].pose(wind.relativeTo(grove.trees[i].foot), forest::fullWeights(),
                                    forest::MAX_DEPTHS, poses);
           }));
  }
}

// Measures a tick of 1/60 s of a forest in a wind, with all branches physical down to a depth in
// `trees` of its trees.
void stepPhysical(const Options& options, Table& table) {
  forest::PhysicsSettings settings;
  settings.promotion = forest::Promotion::DEPTH;
  settings.most_branches = 1000000;
  for (int side = 1; side <= most(options, 2, 8, 16); side *= 2)
    for (int depth = side == 1 ? 0 : 3; depth < 4; ++depth) {
      forest::PhysicsRig rig(settings, side);
      rig.forest.setWind(forest::steadyWind(Vec3(5, 1, 0)));
      for (std::uint32_t tree = 0; tree < rig.forest.layout().treeCount(); ++tree) {
        const forest::Tree grown = growTree(rig.forest.layout(), tree, rig.forest.terrain());
        const auto& ends = grown.skeleton.depth_end;
        forest::Push push;
        push.point = {
            tree, ends[static_cast<std::size_t>(std::min(depth, grown.skeleton.depths() - 1))] - 1,
            0.0};
        push.until = rig.now() + forest::seconds(1e5);
        rig.forest.push(push);
      }
      rig.run(1.0);  // by then the compensation has faded
      const double seconds = timeOf(options, [&] { rig.advance(); });
      report(table, "physical", static_cast<double>(rig.forest.physicsFigures().branches), seconds);
    }
}

// Measures a step of one tree's chain, plain and on wide vectors.
void stepLinks(const Options& options, Table& table) {
  for (int count = 1; count <= most(options, 1000, 10000, 100000); count *= 10) {
    const auto links = physics::fractalTree(count, 3);
    physics::Simulation plain{links};
    plain.state = physics::randomState(links.size(), 0.02, 0.1, 1);
    report(table, "links, plain", count, timeOf(options, [&] { plain.step({}, 0.0, 1.0 / 240); }));
    physics::BatchChain batch({links});
    batch.setState(0, physics::randomState(links.size(), 0.02, 0.1, 1));
    report(table, "links, SIMD", count, timeOf(options, [&] { batch.step(1.0 / 240); }));
  }
}

// ---- grass ------------------------------------------------------------------------------------

void poseBlades(const Options& options, Table& table) {
  using namespace grass;
  std::vector<BladeBlock> blocks(static_cast<std::size_t>(blocksFor(4096)));
  const Tile tile = tileOf({1024.f, 1024.f, 1024.f, 1024.f});
  TileMotion motion;
  motion.wind_x = {2.f, 3.f, 2.5f, 1.f};
  for (double count = 1; count <= most(options, 4096, 1048576, 16777216); count *= 4)
    report(table, "blades", count, timeOf(options, [&] {
             for (double done = 0; done < count; done += 4096)
               poseBlades(tile, motion, static_cast<int>(std::min(4096.0, count - done)),
                          blocks.data());
           }));
}

// Measures walkers on straight paths of 1.4 m/s, 60 frames per second, over nodes 5 cm apart.
void treadNodes(const Options& options, Table& table) {
  using namespace grass;
  MapLaw law;
  law.columns = law.rows = 101;
  TreadSettings settings;
  settings.memory_cap = 4e9;
  for (int count = 1; count <= most(options, 64, 1024, 4096); count *= 4) {
    TreadMap map(law, settings);
    int frame = 0, touched = 0;
    const auto walk = [&] {
      touched = 0;
      ++frame;
      for (int i = 0; i < count; ++i) {
        const Random random(static_cast<std::uint64_t>(i));
        const double way = 1.4 / 60.0 * (frame % 3000);
        touched += map.tread(static_cast<std::uint32_t>(i), TreadLaw(),
                             {random.uniform(0, 5.0, 115.0) + way, random.uniform(1, 5.0, 195.0)},
                             forest::PHYSICS_START + fromSeconds(frame / 60.0));
      }
    };
    walk();
    const double seconds = timeOf(options, walk);
    report(table, "nodes", std::max(1, touched), seconds);
  }
}

// ---- walkers and leaf fields -------------------------------------------------------------------

// Measures a tick of 1/60 s of wandering walkers among ten trunks each, 90 m^2 per walker.
void stepWalkers(const Options& options, Table& table) {
  using namespace crowd;
  for (int count = 1; count <= most(options, 256, 16384, 65536); count *= 4) {
    const double side = std::sqrt(90.0 * std::max(10, count));
    Crowd crowd(3, CrowdSettings(), Area{0.0, side, 0.0, side},
                std::make_shared<terrain::HeightMap>());
    const Random random(11);
    const auto place = [&](std::uint64_t k) {
      return Point{random.uniform(2 * k, 0.0, side), random.uniform(2 * k + 1, 0.0, side)};
    };
    std::vector<Obstacle> trunks;
    for (std::uint64_t i = 0; i < 10 * static_cast<std::uint64_t>(count); ++i)
      trunks.push_back(discObstacle(place(i), 0.2));
    crowd.setObstacles(std::move(trunks));
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
      Spawn spawn;
      spawn.position = place((1ULL << 40) + i);
      crowd.spawn(spawn);
    }
    const auto step = [&] { crowd.advance(crowd.snapshot().stamp + fromSeconds(1.0 / 60.0)); };
    for (int i = 0; i < 30; ++i) step();
    report(table, "walkers", count, timeOf(options, step));
  }
}

// Measures a step of 1/30 s of wind and leaves in the plane, over its cells.
void stepCells(const Options& options, Table& table) {
  using namespace canopy;
  for (int side = SMALLEST_FIELD; side <= most(options, 64, 256, LARGEST_FIELD); side *= 2) {
    FluidSettings settings;
    settings.cells = side;
    Fluid fluid(settings, SourceSettings(), 1);
    Oscillator leaves(OscillatorSettings(), side, settings.width);
    double time = 0.0;
    report(table, "cells", side * side, timeOf(options, [&] {
             fluid.advance(time, 1.0 / 30.0);
             leaves.advance(1.0 / 30.0, fluid.state().flow, 0.0);
             time += 1.0 / 30.0;
           }));
  }
}

void run(const Options& options) {
  Table table(options.csv, bench::SIZE_COLUMNS);
  if (options.wants("trees")) growTrees(options, table);
  if (options.wants("branches")) poseBranches(options, table);
  if (options.wants("physical")) stepPhysical(options, table);
  if (options.wants("links")) stepLinks(options, table);
  if (options.wants("blades")) poseBlades(options, table);
  if (options.wants("nodes")) treadNodes(options, table);
  if (options.wants("walkers")) stepWalkers(options, table);
  if (options.wants("cells")) stepCells(options, table);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    run(bench::readOptions(
        argc, argv,
        {"trees", "branches", "physical", "links", "blades", "nodes", "walkers", "cells"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "size_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
