// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures what each tier of a tile of grass costs and which error it leaves: segments of a blade,
// its shape, and texture, strips or blades.
// usage: grass_tile_bench [ROUNDS] [--quick | --full] [--part segments,tiles] [--csv FILE]

#include <cmath>
#include <cstdio>
#include <map>

#include "grass/mesh/grass_geometry.h"
#include "options.h"
#include "processor_time.h"
#include "reference/grass/blade_profile.h"
#include "scenes/grass/grass_fixture.h"
#include "table.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {
namespace {

using bench::Candidate;
using bench::Options;

constexpr double DENSITY = 1000.0;  // [1/m^2]
constexpr double LENGTH = 0.3;      // of a blade [m]

/// A tile of 2 m in a wind that differs from corner to corner.
struct Scene {
  FeatureMap map;
  Tile tile;
  TileMotion motion;
  int count;
  std::vector<BladeBlock> blocks;
  GrassMesh mesh;

  Scene() : tile(tileOf({float(DENSITY), float(DENSITY), float(DENSITY), float(DENSITY)})) {
    motion.wind_x = {5.f, 6.f, 4.f, 5.f};
    motion.wind_y = {0.f, 1.f, -1.f, 0.5f};
    count = tile.blades;
    blocks.resize(static_cast<std::size_t>(blocksFor(count)));
  }
  /// Poses and meshes this share of the blades.
  void blades(int segments, double share) {
    const int drawn = static_cast<int>(share * count);
    poseBlades(tile, motion, drawn, blocks.data());
    RibbonStyle style;
    style.segments = segments;
    style.width = 1.0 / share;
    appendRibbons(map, tile, blocks.data(), drawn, style, mesh);
  }
  void clear() { mesh.clear(); }
};

/// Returns the point of an arc of end angle `bend` at the share `s` of its length.
std::array<double, 2> onArc(double bend, double s) {
  const SinCos at = sinCos(bend * s);
  return {(1.0 - at.cos) / bend * LENGTH, at.sin / bend * LENGTH};
}

double distanceToSegment(const std::array<double, 2>& p, const std::array<double, 2>& a,
                         const std::array<double, 2>& b) {
  const double x = b[0] - a[0], y = b[1] - a[1];
  const double s = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
  const double t = std::min(1.0, std::max(0.0, s));
  return std::hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

/// The points of a blade that a ribbon of so many segments draws (ribbons.cpp).
const std::map<int, std::vector<int>> DRAWN{
    {1, {0, 5}}, {2, {0, 3, 5}}, {3, {0, 2, 4, 5}}, {LINKS, {0, 1, 2, 3, 4, 5}}};

/// Returns the largest distance of points of the arc from a blade of `segments`, over its length.
double shapeError(BladeModel model, int segments, double bend) {
  const Profile<double> profile = bladeProfile(LENGTH, 0.0, bend, model);
  std::vector<std::array<double, 2>> points;
  for (const int k : DRAWN.at(segments)) {
    const auto i = static_cast<std::size_t>(k);
    points.push_back({profile.reach[i], profile.rise[i]});
  }
  double worst = 0.0;
  for (int n = 0; n <= 200; ++n) {
    double nearest = 1e9;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      nearest =
          std::min(nearest, distanceToSegment(onArc(bend, n / 200.0), points[k], points[k + 1]));
    worst = std::max(worst, nearest);
  }
  return worst / LENGTH;
}

// Compares shapes at a bend of 1 rad; the cost is that of posing and meshing a blade.
void benchSegments(const Options& options, bench::Table& table) {
  Scene scene;
  std::vector<Candidate> candidates;
  const std::array<int, 4> segments{1, 2, 3, LINKS};
  for (const int n : segments)
    candidates.push_back({"segments", [&scene, n] {
                            scene.clear();
                            scene.blades(n, 1.0);
                          }});
  bench::timeOnProcessor(candidates, options.rounds);
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const auto model : {BladeModel::ARC, BladeModel::PAPER}) {
      const double error = shapeError(model, segments[i], 1.0);
      const double each = candidates[i].seconds / scene.count;
      const char* const name = model == BladeModel::ARC ? "arc" : "paper";
      std::printf("%-6s %d segments %6.1f ns/blade, off by %.2f %% of the length\n", name,
                  segments[i], 1e9 * each, 100.0 * error);
      table.row(name, segments[i], segments[i], each, error,
                int(model == BladeModel::ARC && segments[i] == LINKS));
    }
}

Vec3 tipOffset(const Scene& scene, int blade) {
  return pointOf(scene.blocks, blade, LINKS) - pointOf(scene.blocks, blade, 0);
}

// Returns the error of a tier: the mean distance [m] of a blade's tip, from its root, to that of
// its replacement.
template <class StandIn>
double meanError(const Scene& scene, const StandIn& stand_in) {
  double sum = 0.0;
  for (int i = 0; i < scene.count; ++i) sum += length(tipOffset(scene, i) - stand_in(i));
  return sum / scene.count;
}

/// The nearest drawn blade replaces those that are not drawn.
double placeError(const Scene& scene, int drawn) {
  return meanError(scene, [&](int i) {
    const Vec3 root = pointOf(scene.blocks, i, 0);
    int nearest = 0;
    double least = 1e9;
    for (int k = 0; k < drawn; ++k) {
      const double distance = length(pointOf(scene.blocks, k, 0) - root);
      if (distance < least) least = distance, nearest = k;
    }
    return tipOffset(scene, nearest);
  });
}

/// The nearest upright of a strip replaces a blade; its vertices come in pairs, bottom and top.
double stripError(const Scene& scene, const GrassMesh& mesh) {
  const auto vertex = [&](std::size_t v) {
    return Vec3(double{mesh.positions[3 * v]}, double{mesh.positions[3 * v + 1]},
                double{mesh.positions[3 * v + 2]});
  };
  return meanError(scene, [&](int i) {
    const Vec3 root = pointOf(scene.blocks, i, 0);
    Vec3 out = Vec3::Zero();
    double least = 1e9;
    for (std::size_t v = 0; v < mesh.vertexCount(); v += 2) {
      const double distance = length(vertex(v) - root);
      if (distance < least) least = distance, out = vertex(v + 1) - vertex(v);
    }
    return out;
  });
}

struct TileRung {
  const char* name;
  int segments;
  double share;
};
constexpr TileRung TIERS[] = {{"blades, least share, 1 segment", 1, LEAST_SHARE},
                              {"blades, half, 2 segments", 2, 0.5},
                              {"blades, all, 2 segments", 2, 1.0},
                              {"blades, all, 5 segments", LINKS, 1.0}};

void report(bench::Table& table, const char* name, int tier, double seconds, double error) {
  std::printf("%-30s %8.2f us a tile, %.2f mm off\n", name, 1e6 * seconds, 1e3 * error);
  table.row("tile", tier, name, seconds, error, 0);
}

// Measures a whole tile on each tier of the ladder.
void benchTiles(const Options& options, bench::Table& table) {
  Scene scene;
  GrassMesh strips;
  std::vector<Candidate> candidates{{"strips", [&] {
                                       strips.clear();
                                       appendStrips(scene.map, scene.tile, scene.motion, 1.0,
                                                    DENSITY, strips);
                                     }}};
  for (const TileRung& tier : TIERS)
    candidates.push_back({tier.name, [&scene, tier] {
                            scene.clear();
                            scene.blades(tier.segments, tier.share);
                          }});
  bench::timeOnProcessor(candidates, options.rounds);
  scene.blades(LINKS, 1.0);
  report(table, "strips", 1, candidates[0].seconds, stripError(scene, strips));
  for (std::size_t i = 0; i + 1 < candidates.size(); ++i) {
    const int drawn = static_cast<int>(TIERS[i].share * scene.count);
    const double shape = LENGTH * shapeError(BladeModel::ARC, TIERS[i].segments, 1.0);
    report(table, TIERS[i].name, static_cast<int>(i) + 2, candidates[i + 1].seconds,
           std::hypot(shape, placeError(scene, drawn)));
  }
  const double texture = meanError(scene, [](int) { return Vec3(Vec3::Zero()); });
  std::printf("a texture alone: %.1f mm off\n", 1e3 * texture);
}

void run(const Options& options) {
  bench::Table table(options.csv, bench::LADDER_COLUMNS);
  if (options.wants("segments")) benchSegments(options, table);
  if (options.wants("tiles")) benchTiles(options, table);
}

}  // namespace
}  // namespace vegetation_sim::grass

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    grass::run(bench::readOptions(argc, argv, {"segments", "tiles"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "grass_tile_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
