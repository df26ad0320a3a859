// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures trodden ground by the spacing of its nodes, under a walker and under a wheel on straight
// tracks in many directions: processor time of a step of 1/60 s, memory per trodden area, and how
// far the tips of blades are from those over nodes 4 mm apart, in height and in all.
// usage: tread_bench [ROUNDS] [--quick | --full] [--part walker,wheel] [--csv FILE]

#include <cstdio>

#include "options.h"
#include "processor_time.h"
#include "table.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/grass/blades/blade_batch.h"
#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {
namespace {

using bench::Options;

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;
constexpr int TILES = 10;             // along each side of the map
constexpr double WAY = 6.0;           // length of a track [m]
constexpr int FINEST = 512;           // cells along a tile of 2 m
constexpr double SCALE = 4.0;         // of the reference
constexpr double HEIGHT = 0.3;        // of the grass [m]
constexpr double WRONG = 0.1;         // distance of a tip that one sees [m]
constexpr double FRAME = 1.0 / 60.0;  // [s]

struct Source {
  std::string name;
  TreadLaw law;
  double speed;  ///< [m/s]
};

/// As in the scenarios crowd and meadow_robot.
std::vector<Source> sources() {
  Source walker{"walker", {}, 1.4}, wheel{"wheel", {}, 1.0};
  walker.law = {0.16, 0.45, 0.12, 1.0, PERMANENT_RECOVERY};
  wheel.law = {0.10, 0.19, 0.08, 1.0, PERMANENT_RECOVERY};
  return {walker, wheel};
}

struct Track {
  Point from, along;

  Point at(double way) const { return {from.x + way * along.x, from.y + way * along.y}; }
  double distanceTo(const Point& p) const {
    const double x = p.x - from.x, y = p.y - from.y;
    const double way = std::clamp(x * along.x + y * along.y, 0.0, WAY);
    return distanceBetween(p, at(way));
  }
};

/// Returns a track from near the middle of the map in a random direction.
Track trackOf(std::uint64_t number) {
  const Random random(number);
  const SinCos turn = sinCosTurns(random.uniform(0));
  return {{random.uniform(1, 9.0, 11.0), random.uniform(2, 9.0, 11.0)}, {turn.cos, turn.sin}};
}

/// The grass of the map, all blades upright without a wind.
class Lawn {
 public:
  Lawn() : map_(input()) {}
  static MapLaw law(double scale = 1.0) {
    MapLaw out;
    out.resolution *= scale;
    out.origin_x *= scale;
    out.origin_y *= scale;
    out.columns = out.rows = TILES + 1;
    return out;
  }
  /// Returns root and tip of each blade, tile by tile [m].
  std::vector<std::pair<Vec3, Vec3>> blades(const TreadMap& tread) const {
    std::vector<std::pair<Vec3, Vec3>> out;
    for (int row = 0; row < TILES; ++row)
      for (int column = 0; column < TILES; ++column) {
        const Tile tile = makeTile(map_, terrain_, 1, column, row);
        std::vector<BladeBlock> blocks(static_cast<std::size_t>(blocksFor(tile.blades)));
        CrushPatch crush;
        tread.patch(column, row, START + 60 * NANOSECONDS_PER_SECOND, crush);
        TileMotion motion;
        if (crush.cells > 0) motion.crush = &crush;
        poseBlades(tile, motion, tile.blades, blocks.data());
        for (int i = 0; i < tile.blades; ++i) {
          const BladeBlock& block = blocks[static_cast<std::size_t>(i / BLOCK)];
          const Vec3 corner(tile.x, tile.y, tile.z);
          out.emplace_back(corner + pointOf(block, 0, i % BLOCK),
                           corner + pointOf(block, POINTS - 1, i % BLOCK));
        }
      }
    return out;
  }

 private:
  static MapInput input() {
    MapInput out;
    out.law = law();
    out.density.value = 1000.0;
    out.height.value = HEIGHT;
    return out;
  }
  static Vec3 pointOf(const BladeBlock& block, int point, int blade) {
    return {block.x[point][blade], block.y[point][blade], block.z[point][blade]};
  }

  FeatureMap map_;
  terrain::HeightMap terrain_;
};

/// Results of all tracks.
struct Sum {
  double squares{0.0}, heights{0.0}, seconds{0.0}, bytes{0.0};
  int blades{0}, wrong{0}, steps{0};

  void add(const std::vector<std::pair<Vec3, Vec3>>& found,
           const std::vector<std::pair<Vec3, Vec3>>& truth, const Track& track, double reach) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (track.distanceTo({truth[i].first.x(), truth[i].first.y()}) > reach) continue;
      const Vec3 way = found[i].second - truth[i].second;
      const double off = length(way);
      squares += off * off;
      heights += way.z() * way.z();
      wrong += off > WRONG;
      ++blades;
    }
  }
};

/// Makes a map with so many cells along a tile. Spacings below 1 cm are not allowed, so a reference
/// has all lengths scaled, which changes no tilt.
TreadMap mapOf(int cells, double scale = 1.0) {
  TreadSettings settings;
  settings.spacing = 2.0 * scale / cells;
  settings.memory_cap = 1e10;
  return TreadMap(Lawn::law(scale), settings);
}

/// Treads a track. @return its number of steps.
int tread(TreadMap& map, const Source& source, const Track& track, double scale = 1.0) {
  const int steps = static_cast<int>(WAY / (source.speed * FRAME));
  TreadLaw law = source.law;
  for (double* length : {&law.radius, &law.reach, &law.softness}) *length *= scale;
  for (int k = 0; k <= steps; ++k) {
    const Point at = track.at(WAY * k / steps);
    map.tread(1, law, {scale * at.x, scale * at.y}, START + fromSeconds(k * FRAME));
  }
  return steps;
}

/// Returns the median processor time of the steps of a track on fresh ground [s].
double timeOf(int cells, const Source& source, const Track& track, int rounds) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    TreadMap map = mapOf(cells);
    const double start = bench::threadTime();
    tread(map, source, track);
    times.push_back(bench::threadTime() - start);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void benchSource(const Options& options, const Source& source, bench::Table& table) {
  const std::vector<int> cells = {4, 8, 16, 20, 32, 40, 80, 160};
  const Lawn lawn;
  std::vector<Sum> sums(cells.size());
  const std::uint64_t tracks = options.quick ? 2 : options.full ? 32 : 8;
  for (std::uint64_t number = 0; number < tracks; ++number) {
    const Track track = trackOf(number);
    TreadMap fine = mapOf(FINEST, SCALE);
    tread(fine, source, track, SCALE);
    const auto truth = lawn.blades(fine);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      TreadMap map = mapOf(cells[i]);
      sums[i].steps += tread(map, source, track);
      map.lift(1);
      sums[i].bytes += static_cast<double>(map.bytes());
      sums[i].add(lawn.blades(map), truth, track, source.law.reach);
      sums[i].seconds += timeOf(cells[i], source, track, std::min(options.rounds, 7));
    }
  }
  const double area = 2.0 * source.law.reach * WAY * static_cast<double>(tracks);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double spacing = 2.0 / cells[i], step = sums[i].seconds / sums[i].steps;
    const double off = std::sqrt(sums[i].squares / sums[i].blades);
    const double height = std::sqrt(sums[i].heights / sums[i].blades);
    const double wrong = double(sums[i].wrong) / sums[i].blades,
                 memory = 1e-3 * sums[i].bytes / area;
    std::printf("%-7s %7.4f m %8.2f us a step %8.2f kB/m2 %6.1f mm high %6.1f mm %6.1f %% wrong\n",
                source.name.c_str(), spacing, 1e6 * step, memory, 1e3 * height, 1e3 * off,
                100.0 * wrong);
    table.row(source.name, spacing, 1e6 * step, memory, height, off, wrong,
              int(std::fabs(spacing - TreadSettings().spacing) < 1e-9));
  }
}

}  // namespace
}  // namespace vegetation_sim::grass

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options = bench::readOptions(argc, argv, {"walker", "wheel"});
    bench::Table table(options.csv, "source,spacing,step_us,memory_kb,height,tip,wrong,chosen");
    for (const grass::Source& source : grass::sources())
      if (options.wants(source.name)) grass::benchSource(options, source, table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tread_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
