// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures grass: blades per second, plain and batched, against the memory bandwidth; treading per
// node and per frame of a crowd; frames of a square kilometre.
// usage: grass_bench [ROUNDS] [--part blades,ribbons,walkers,strokes,kilometre]

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "grass/mesh/grass_geometry.h"
#include "options.h"
#include "processor_time.h"
#include "reference/grass/blade_plain.h"
#include "reference/grass/ribbons_plain.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/wind/field.h"

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
  std::memset(static_cast<void*>(out.get()), 1, bytes);  // written once, so that no page is new
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
  bench::timeOnProcessor(candidates, rounds);
  const double blades = static_cast<double>(count) * EACH;
  std::printf("%-22s %10s %12s %8s %12s\n", "", "ns/blade", "M blades/s", "ratio", "of memory");
  for (const Candidate& c : candidates)
    std::printf("%-22s %10.2f %12.1f %8.1f %12.2f\n", c.name.c_str(), c.seconds / blades * 1e9,
                blades / c.seconds * 1e-6, candidates[1].seconds / c.seconds,
                candidates[0].seconds / c.seconds);
}

// Measures blades of one tile after the other, posed and drawn as ribbons of five segments.
void benchRibbons(int rounds) {
  const FeatureMap map;
  const std::vector<Tile> tiles = makeTiles(terrain::HeightMap());
  const Blocks blocks = makeBlocks(sizeof(BladeBlock) * EACH / BLOCK);
  TileMotion motion;
  motion.wind_x = {2.f, 3.f, 2.5f, 1.f};
  const GrassLight light;
  constexpr std::size_t TILES = 64;
  GrassMesh mesh;
  std::vector<Candidate> candidates;
  const auto add = [&](const std::string& name, const std::string& set, bool lit, bool plain) {
    candidates.push_back({name + (lit ? ", lit" : ""), [&, set, lit, plain] {
                            forceInstructionSet(set);
                            RibbonStyle style;
                            style.light = lit ? &light : nullptr;
                            for (std::size_t i = 0; i < TILES; ++i) {
                              mesh.clear();
                              poseBlades(tiles[i], motion, EACH, blocks.get());
                              (plain ? appendRibbonsPlain : appendRibbons)(
                                  map, tiles[i], blocks.get(), EACH, style, mesh);
                            }
                            forceInstructionSet("");
                          }});
  };
  for (const bool lit : {false, true}) {
    add("plain ribbons", "", lit, true);
    for (const std::string& set : instructionSets()) add(set, set, lit, false);
  }
  bench::timeOnProcessor(candidates, rounds);
  std::printf("\nBlades posed and drawn with %d segments\n%-22s %10s\n", LINKS, "", "ns/blade");
  for (const Candidate& c : candidates)
    std::printf("%-22s %10.2f\n", c.name.c_str(), c.seconds / (TILES * EACH) * 1e9);
}

// ---- treading --------------------------------------------------------------------------------

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;

MapLaw lawOf(int tiles) {
  MapLaw law;
  law.columns = law.rows = tiles + 1;
  return law;
}

// Walkers on circles of their own, 1.4 m/s, one step of 1/60 s per frame.
struct Walkers {
  int count;
  double extent;
  TreadLaw law;
  int frame{0};
  std::vector<Point> places{};
  void move() {
    places.clear();
    for (int i = 0; i < count; ++i) {
      const Random random(static_cast<std::uint64_t>(i));
      const SinCos turn = sinCos(1.4 / 3.0 * frame / 60.0 + random.uniform(2, 0.0, 6.0));
      places.push_back({random.uniform(0, 5.0, extent - 5.0) + 3.0 * turn.cos,
                        random.uniform(1, 5.0, extent - 5.0) + 3.0 * turn.sin});
    }
    ++frame;
  }
  int tread(TreadMap& map) const {
    int touched = 0;
    const Nanoseconds stamp = START + fromSeconds(frame / 60.0);
    for (int i = 0; i < count; ++i)
      touched +=
          map.tread(static_cast<std::uint32_t>(i), law, places[static_cast<std::size_t>(i)], stamp);
    return touched;
  }
};

void benchWalkers(int rounds) {
  std::printf("\n1 000 walkers, 1.4 m/s, 60 frames a second\n");
  std::printf("%-26s %10s %14s %14s %10s\n", "", "ms/frame", "nodes/frame", "ns/node", "MB");
  for (const bool fine : {false, true}) {
    TreadSettings settings;
    settings.spacing = fine ? 0.05 : 0.25;
    settings.memory_cap = 1e9;
    TreadMap map(lawOf(100), settings);
    Walkers walkers{1000, 200.0, TreadLaw()};
    if (!fine) walkers.law.radius = 0.25, walkers.law.reach = 0.6;
    int touched = 0;
    std::vector<double> times;
    for (int i = 0; i < 120 + 10 * rounds; ++i) {
      walkers.move();
      const double start = bench::processorTime();
      touched = walkers.tread(map);
      // by then all the ground is trodden
      if (i >= 120) times.push_back(bench::processorTime() - start);
    }
    std::sort(times.begin(), times.end());
    const double frame = times[times.size() / 2];
    std::printf("nodes %.2f m, reach %.2f m   %10.3f %14d %14.1f %10.1f\n", settings.spacing,
                walkers.law.reach, frame * 1e3, touched, frame / touched * 1e9,
                static_cast<double>(map.bytes()) * 1e-6);
  }
}

// Measures nodes alone: strokes are so long that their own cost does not count.
void benchStrokes(int rounds) {
  std::printf("\nStrokes of 4 m, nodes 0.05 m, reach 1 m\n");
  TreadMap map(lawOf(100), TreadSettings());
  TreadLaw wide;
  wide.reach = 1.0;
  wide.radius = 0.4;
  int touched = 0, k = 0;
  std::vector<Candidate> candidates;
  for (const std::string& set : instructionSets())
    candidates.push_back({set, [&, set] {
                            forceInstructionSet(set);
                            touched = 0;
                            for (int i = 0; i < 40; ++i, ++k)
                              touched += map.tread(1, wide, {100.0 + (k % 2 ? 2.0 : -2.0), 100.0},
                                                   START + fromSeconds(k));
                            forceInstructionSet("");
                          }});
  bench::timeOnProcessor(candidates, 10 * rounds);
  for (const Candidate& c : candidates)
    std::printf("%-22s %10.1f ns/node, %d nodes\n", c.name.c_str(), c.seconds / touched * 1e9,
                touched);
}

// ---- a square kilometre -----------------------------------------------------------------------

double megabytesInUse() {
  std::ifstream status("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  status >> pages >> resident;
  return resident * 4096e-6;
}

wind::Field breeze() {
  wind::Primitive p;
  p.id = 1;
  p.name = "breeze";
  p.kind = wind::Kind::BREEZE;
  return wind::Field({p}, 3);
}

struct Frame {
  double milliseconds{0.0};
  std::size_t blades{0}, strips{0};
};

Frame drawFrame(MeadowLod& meadow, const TreadMap& tread, const wind::Field& wind,
                const Viewpoint& viewer, Nanoseconds stamp, BladeBlock* blocks, GrassMesh& strips) {
  const double start = bench::processorTime();
  Frame out;
  meadow.setViewpoints({viewer});
  meadow.advance(stamp);
  const auto views = meadow.viewOf(viewer, stamp);
  NodeWind air(meadow.map(), meadow.terrain());
  std::vector<TilePlace> tiles;
  for (const TileView& view : views) tiles.push_back({view.column, view.row});
  air.update(wind.at(stamp), {}, MeadowLod::windowOf(views), &tiles);
  CrushPatch patch;
  strips.clear();
  strips.origin = viewer.position;
  for (const TileView& view : views) {
    TileMotion motion;
    const Tile tile = meadow.tileAt(view, air, tread, stamp, patch, motion);
    if (view.morph.blades) {
      const int count = static_cast<int>(tile.blades * view.share);
      poseBlades(tile, motion, count, blocks);
      out.blades += static_cast<std::size_t>(count);
    }
    if (view.morph.strip > 0.0) {
      appendStrips(meadow.map(), tile, motion, view.morph.strip, 1000.0, strips);
      ++out.strips;
    }
  }
  out.milliseconds = 1e3 * (bench::processorTime() - start);
  return out;
}

// Returns room for the strips of so many tiles, written once, as a viewer keeps it from frame to
// frame.
GrassMesh makeMesh(std::size_t tiles) {
  const std::size_t corners = 4 * (STRIP_CELLS + 1) * 2 * tiles;
  GrassMesh out;
  out.positions.assign(3 * corners, 1.f);
  out.texture.assign(2 * corners, 1.f);
  out.colours.assign(4 * corners, 1);
  out.indices.assign(3 * 4 * STRIP_CELLS * 2 * tiles, 1);
  return out;
}

// The viewer moves at 3 m/s with 60 frames per second, or at ten times that with a jump in the
// middle.
Viewpoint viewerAt(int frame, bool jumps) {
  Viewpoint viewer;
  viewer.cone_cosine = 0.8;
  viewer.position = !jumps        ? Vec3(300.0 + 0.05 * frame, 500.0, 1.6)
                    : frame < 150 ? Vec3(300.0 + 0.5 * frame, 500.0, 1.6)
                                  : Vec3(700.0 - 0.5 * frame, 300.0, 6.0);
  return viewer;
}

void benchKilometre(bool jumps) {
  MapInput input;
  input.law.columns = input.law.rows = 501;
  input.density.value = 1000.0;
  MeadowSettings settings;
  settings.most_blades = 3e5;
  const double before = megabytesInUse();
  MeadowLod meadow(std::make_shared<FeatureMap>(input), std::make_shared<terrain::HeightMap>(), 7,
                   settings);
  const TreadMap tread(input.law, TreadSettings());
  const wind::Field wind = breeze();
  const Blocks blocks = makeBlocks(sizeof(BladeBlock) * blocksFor(8192));
  GrassMesh strips = makeMesh(16384);
  std::vector<double> times;
  std::size_t blades = 0, tiles = 0;
  for (int k = 0; k < 300; ++k) {
    const Frame frame = drawFrame(meadow, tread, wind, viewerAt(k, jumps),
                                  START + fromSeconds(k / 60.0), blocks.get(), strips);
    times.push_back(frame.milliseconds);
    blades = std::max(blades, frame.blades);
    tiles = std::max(tiles, frame.strips);
  }
  std::sort(times.begin(), times.end());
  std::printf("\n1 km2 at 1 000 blades per m2, a viewer at %s, levels + wind + blades + strips\n",
              jumps ? "30 m/s with a jump" : "3 m/s");
  std::printf(
      "ms/frame from the first on: median %.2f, 99 %% %.2f, largest %.2f; %zu blades, %zu tiles of "
      "strips\n",
      times[times.size() / 2], times[times.size() * 99 / 100], times.back(), blades, tiles);
  std::printf("memory of the process %.0f MB more than before; state %.2f MB\n",
              megabytesInUse() - before,
              static_cast<double>(meadow.bytes() + tread.bytes()) * 1e-6);
}

}  // namespace
}  // namespace vegetation_sim::grass

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options =
        bench::readOptions(argc, argv, {"blades", "ribbons", "walkers", "strokes", "kilometre"});
    if (options.wants("blades")) grass::benchBlades(options.rounds);
    if (options.wants("ribbons")) grass::benchRibbons(options.rounds);
    if (options.wants("walkers")) grass::benchWalkers(options.rounds);
    if (options.wants("strokes")) grass::benchStrokes(options.rounds);
    if (options.wants("kilometre"))
      for (const bool jumps : {false, true}) grass::benchKilometre(jumps);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "grass_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
