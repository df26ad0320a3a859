// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures a step of physical branches: the plain double stepper against the batched ones, over
// links of equal depth and over trees of one topology, and each instruction set.
// usage: chain_bench [ROUNDS]

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "dynamics/batch_step/batch_chain.h"
#include "processor_time.h"
#include "scenes/dynamics/chain_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/wind/field.h"
#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::physics {
namespace {

using bench::Candidate;
using Trees = std::vector<std::vector<Link>>;

constexpr int SUB_STEPS = 4;
constexpr double STEPS_A_SECOND = 60.0 * SUB_STEPS;

struct Path {
  std::string name;
  double links;                      ///< number of links that one call steps
  std::function<void(int)> advance;  ///< advances by so many steps, whole frames
};

void frame(BatchChain& chain) {
  chain.step(STEP, SUB_STEPS);
}

template <class Batch>
Path batched(const std::string& name, const Trees& trees, Products products = Products::MEAN) {
  auto batch = std::make_shared<Batch>(trees);
  batch->setProducts(products);
  double links = 0.0;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    batch->setState(static_cast<int>(t), randomState(trees[t].size(), 0.02, 0.1, t));
    links += static_cast<double>(trees[t].size());
  }
  return {name, links, [batch](int steps) {
            for (int i = 0; i < steps; i += SUB_STEPS) frame(*batch);
          }};
}

template <class Batch>
Path inWind(const std::string& name, std::shared_ptr<Trees> trees) {
  Path out = batched<Batch>(name, *trees);
  auto batch = std::make_shared<Batch>(*trees);
  auto around = std::make_shared<std::vector<Surroundings>>();
  for (const auto& tree : *trees) around->push_back(gustAndPull(tree, 18.0, 20.0));
  out.advance = [batch, around, trees](int steps) {
    for (int i = 0; i < steps; ++i) batch->step(*around, 0.3, STEP);
  };
  return out;
}

wind::Field gust() {
  wind::Primitive out;
  out.kind = wind::Kind::GUST;
  out.name = "gust";
  out.velocity = Vec3(18.0, 0.0, 0.0);
  return wind::Field({out});
}

// Returns a breeze of 24 modes.
wind::Field breeze() {
  wind::Primitive out;
  out.kind = wind::Kind::BREEZE;
  out.velocity = Vec3(4.0, 2.0, 0.0);
  out.name = "breeze";
  out.turbulence = 0.2;
  return wind::Field({out});
}

// The wind is queried once per frame of 60 Hz, at the positions of the links then, and held for its
// four steps.
Path heldAir(const std::string& name, const Trees& trees, const wind::Field& wind) {
  Path out = batched<BatchChain>(name, trees);
  auto batch = std::make_shared<BatchChain>(trees);
  for (std::size_t t = 0; t < trees.size(); ++t) {
    std::vector<Grip> grips;
    for (const Link& link : trees[t])
      grips.push_back({link.centre, 0.0, 0.6 * 2.0 * radiusOf(link) * link.length});
    batch->setGrips(static_cast<int>(t), grips);
  }
  out.advance = [batch, wind](int steps) {
    for (int i = 0; i < steps; i += SUB_STEPS) {
      const forest::FloatWind now(wind.at(fromSeconds(0.3 + STEP * i)), 100.0);
      batch->queryWind([now](const float* places, float* air, std::size_t blocks) {
        fillWind(now, places, air, blocks);
      });
      batch->step(STEP, SUB_STEPS);
    }
  };
  return out;
}

Path plain(const std::string& name, std::shared_ptr<Trees> trees, bool wind,
           Products products = Products::MEAN) {
  auto run = std::make_shared<Simulation>(Simulation{trees->front()});
  run->stepper.setProducts(products);
  run->state = randomState(run->links.size(), 0.02, 0.1, 1);
  const Surroundings around = wind ? gustAndPull(trees->front(), 18.0, 20.0) : Surroundings();
  return {name, static_cast<double>(run->links.size()), [run, around, trees](int steps) {
            for (int i = 0; i < steps; ++i) run->step(around, 0.3, STEP);
          }};
}

/// Nanoseconds per link and step.
struct Cost {
  double median, least;
};

std::vector<Cost> measure(const std::vector<Path>& paths, int rounds) {
  std::vector<Candidate> candidates;
  std::vector<double> updates;
  for (const Path& path : paths) {
    const int steps = SUB_STEPS * std::max(1, static_cast<int>(5e4 / path.links));
    candidates.push_back({path.name, [&path, steps] { path.advance(steps); }});
    updates.push_back(steps * path.links);
  }
  bench::timeOnProcessor(candidates, rounds);
  std::vector<Cost> out;
  for (std::size_t i = 0; i < paths.size(); ++i)
    out.push_back(
        {1e9 * candidates[i].seconds / updates[i], 1e9 * candidates[i].least / updates[i]});
  return out;
}

void benchPaths(int rounds) {
  std::printf("%-34s %7s %9s %7s %14s\n", "path", "links", "ns/link", "ratio", "links at 60 Hz");
  for (const int n : {100, 1000, 10000}) {
    const auto one = std::make_shared<Trees>(1, fractalTree(n, 3));
    Trees several;
    for (int links = 0; links < 4000; links += n)
      several.push_back(fractalTree(n, static_cast<std::uint64_t>(3 + links)));
    const std::vector<Path> paths{
        plain("plain double", one, false),
        batched<BatchChain>("equal depth, one tree", *one),
        batched<BatchChain>("equal depth, trees together", several),
        plain("plain double, wind asked for", one, true),
        inWind<BatchChain>("equal depth, wind asked for", one),
        heldAir("one tree, gust asked at 60 Hz", *one, gust()),
        heldAir("one tree, breeze asked at 60 Hz", *one, breeze()),
        heldAir("together, gust asked at 60 Hz", several, gust()),
        heldAir("together, breeze asked at 60 Hz", several, breeze()),
        plain("plain, products at start", one, false, Products::START),
        batched<BatchChain>("one tree, products at start", *one, Products::START),
        batched<BatchChain>("together, products at start", several, Products::START)};
    const std::vector<Cost> cost = measure(paths, rounds);
    for (std::size_t i = 0; i < paths.size(); ++i)
      std::printf("%-34s %7.0f %9.2f %7.1f %14.0f\n", paths[i].name.c_str(), paths[i].links,
                  cost[i].median, cost[i >= 3 && i < 9 ? 3 : 0].median / cost[i].median,
                  1e9 / (STEPS_A_SECOND * cost[i].median));
  }
}

// Measures a whole forest, far more than the caches hold.
void benchForests(int rounds) {
  std::printf(
      "\n100 000 links in trees of so many: median [ns], thousand links at 60 Hz, least, links\n");
  for (const int n : {100, 1000, 10000}) {
    Trees trees;
    for (int links = 0; links < 100000; links += n)
      trees.push_back(fractalTree(n, static_cast<std::uint64_t>(3 + links)));
    const std::vector<Path> paths{batched<BatchChain>("no wind", trees),
                                  heldAir("gust", trees, gust()),
                                  heldAir("breeze", trees, breeze())};
    const std::vector<Cost> cost = measure(paths, rounds);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      std::printf("%-6d %-8s", n, paths[i].name.c_str());
      for (const double each : {cost[i].median, cost[i].least})
        std::printf(" %8.1f %5.0f", each, 1e6 / (STEPS_A_SECOND * each));
      std::printf("\n");
    }
  }
}

void benchInstructionSets(int rounds) {
  std::printf("\n1000 links: %s", "equal depth [ns]\n");
  std::vector<Path> paths;
  const Trees tree(1, fractalTree(1000, 3));
  for (const std::string& set : instructionSets()) {
    Path path = batched<BatchChain>(set, tree);
    const auto advance = path.advance;
    path.advance = [set, advance](int steps) {
      forceInstructionSet(set);
      advance(steps);
      forceInstructionSet("");
    };
    paths.push_back(path);
  }
  const std::vector<Cost> cost = measure(paths, rounds);
  for (std::size_t i = 0; i < paths.size(); ++i)
    std::printf("%-10s %8.2f\n", paths[i].name.c_str(), cost[i].median);
}

}  // namespace
}  // namespace vegetation_sim::physics

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  vegetation_sim::physics::benchPaths(rounds);
  vegetation_sim::physics::benchForests(rounds);
  vegetation_sim::physics::benchInstructionSets(rounds);
  return 0;
}
