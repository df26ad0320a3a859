// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures grass: blades per second, plain and batched, against what the memory takes.
// usage: grass_bench [ROUNDS]

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "interleaved.h"
#include "vegetation_sim/common/instruction_set.h"
#include "vegetation_sim/grass/blade_batch.h"

namespace vegetation_sim::grass {
namespace {

using bench::Candidate;

constexpr std::size_t LARGE = 288u << 20;  ///< [bytes] far beyond any cache

struct Free {
  void operator()(void* p) const { std::free(p); }
};
using Blocks = std::unique_ptr<BladeBlock[], Free>;

Blocks makeBlocks(std::size_t bytes) {
  Blocks out(static_cast<BladeBlock*>(std::aligned_alloc(64, bytes)));
  std::memset(static_cast<void*>(out.get()), 1, bytes);  // touched, so that no page is new
  return out;
}

std::vector<Tile> makeTiles(const terrain::HeightMap& terrain) {
  MapInput input;
  input.law.columns = input.law.rows = 33;
  input.density.value = 1024.0;
  const FeatureMap map(input);
  std::vector<Tile> tiles;
  for (int row = 0; row < map.tileRows(); ++row)
    for (int column = 0; column < map.tileColumns(); ++column) {
      tiles.push_back(makeTile(map, terrain, 5, column, row));
      tiles.back().density = {800.f, 1000.f, 1200.f, 1096.f};
    }
  return tiles;
}

constexpr int EACH = 4096;  ///< blades in a tile

void benchBlades(int rounds) {
  const std::vector<Tile> tiles = makeTiles(terrain::HeightMap());
  const Blocks large = makeBlocks(LARGE), small = makeBlocks(sizeof(BladeBlock) * EACH / BLOCK);
  const std::size_t per_tile = EACH / BLOCK, room = LARGE / sizeof(BladeBlock) / per_tile;
  const std::size_t count = std::min(tiles.size(), room);
  TileMotion motion;
  motion.wind_x = {2.f, 3.f, 2.5f, 1.f};
  motion.wind_y = {0.f, 1.f, -1.f, 0.5f};
  const double bytes = static_cast<double>(count) * per_tile * sizeof(BladeBlock);
  std::vector<Candidate> candidates{
      {"memory: memset",
       [&] { std::memset(static_cast<void*>(large.get()), 2, static_cast<std::size_t>(bytes)); }},
      {"plain, to memory", [&] {
         for (std::size_t i = 0; i < count; ++i)
           poseBladesPlain(tiles[i], motion, EACH, large.get() + i * per_tile);
       }}};
  for (const std::string& set : instructionSets())
    for (const bool streamed : {true, false}) {
      candidates.push_back({set + (streamed ? ", to memory" : ", in cache"), [&, set, streamed] {
                              forceInstructionSet(set);
                              for (std::size_t i = 0; i < count; ++i)
                                if (streamed)
                                  poseBlades(tiles[i], motion, EACH, large.get() + i * per_tile,
                                             Store::STREAMED);
                                else
                                  poseBlades(tiles[i], motion, EACH, small.get());
                              forceInstructionSet("");
                            }});
    }
  timeInterleaved(candidates, rounds);
  const double blades = static_cast<double>(count) * EACH;
  std::printf("%-22s %10s %12s %8s %12s\n", "", "ns/blade", "M blades/s", "ratio", "of memory");
  for (const Candidate& c : candidates)
    std::printf("%-22s %10.2f %12.1f %8.1f %12.2f\n", c.name.c_str(), c.seconds / blades * 1e9,
                blades / c.seconds * 1e-6, candidates[1].seconds / c.seconds,
                candidates[0].seconds / c.seconds);
}

}  // namespace
}  // namespace vegetation_sim::grass

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  vegetation_sim::grass::benchBlades(rounds);
  return 0;
}
