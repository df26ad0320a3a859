// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a sensor: rays into bare wood, trees with leaves, a lawn, a hay meadow and
// people, "before" through binary trees of boxes and every cell of grass, "after" through wide
// trees and the likely cells; sweeps with several threads, and instruction sets, shrubs included;
// the update of the scene to a stamp; views of the sky; images of a camera. Rays, updates, views
// and images in processor time of one thread, sweeps and the update of the trees with two threads
// in wall time.
// usage: scan_bench [ROUNDS] [--quick] [--part rays,sets,sweeps,presets,update,sky,images]

#include <algorithm>
#include <cstdio>

#include "options.h"
#include "package_folder.h"
#include "processor_time.h"
#include "reference/sensors/binary_scene.h"
#include "scenes/sensors/grove_scene.h"
#include "scenes/sensors/lidar_scene.h"
#include "sensors/camera/pixels.h"
#include "sensors/sky_view.h"
#include "sensors/sweep.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim::scan {
namespace {

const Vec3 SENSOR(10.3, 10.4, 1.2);
constexpr double REACH = 60.0;

Beams beamsOf(int rings, int columns) {
  Beams out;
  out.rings = rings;
  out.columns = columns;
  return out;
}

struct View {
  const char* name;
  const Scene* scene;
  Vec3 sensor{SENSOR};
};

struct NamedLidar {
  const char* name;
  Beams beams;
  int every;  ///< of how many tiles of columns one is cast
};

using Tiles = std::vector<std::vector<Ray>>;

Tiles tilesOf(const NamedLidar& lidar, const Vec3& sensor) {
  const Beams& beams = lidar.beams;
  const BeamTile tile = tileOf(beams);
  Tiles out;
  for (int column = 0; column < beams.columns; column += lidar.every * tile.columns)
    for (int ring = 0; ring < beams.rings; ring += tile.rings) {
      out.emplace_back();
      for (int r = ring; r < std::min(ring + tile.rings, beams.rings); ++r)
        for (int c = column; c < std::min(column + tile.columns, beams.columns); ++c)
          out.back().emplace_back(sensor, directionOf(beams, r, c));
    }
  return out;
}

std::size_t countRays(const Tiles& tiles) {
  std::size_t out = 0;
  for (const std::vector<Ray>& tile : tiles) out += tile.size();
  return out;
}

// As sweep() does.
void castTiles(const Scene& scene, const Tiles& tiles, std::vector<Hit>& out) {
  RayCaster caster(scene, REACH);
  auto next = out.begin();
  for (const std::vector<Ray>& tile : tiles) {
    const std::vector<Hit>& hits = caster.cast(tile);
    next = std::copy(hits.begin(), hits.end(), next);
  }
}

void castBefore(const BinaryScene& scene, const Tiles& tiles, std::vector<Hit>& out) {
  auto next = out.begin();
  for (const std::vector<Ray>& tile : tiles)
    for (const Ray& ray : tile) *next++ = scene.cast(ray, REACH);
}

void benchRays(const std::vector<View>& views, const std::vector<NamedLidar>& lidars, int rounds) {
  std::printf("%-22s %-11s %10s %10s %8s %8s %10s\n", "rays", "lidar", "before", "after", "ratio",
              "points", "different");
  for (const View& view : views)
    for (const NamedLidar& lidar : lidars) {
      const BinaryScene binary(*view.scene);
      const Tiles tiles = tilesOf(lidar, view.sensor);
      std::vector<Hit> before(countRays(tiles)), after(before.size());
      std::vector<bench::Candidate> candidates{
          {"before", [&] { castBefore(binary, tiles, before); }},
          {"after", [&] { castTiles(*view.scene, tiles, after); }}};
      bench::timeOnProcessor(candidates, rounds);
      int points = 0, different = 0;
      for (std::size_t i = 0; i < after.size(); ++i) {
        points += after[i].label != Label::NONE;
        different += !same(before[i], after[i]);
      }
      const auto count = static_cast<double>(after.size());
      const double slow = 1e9 * candidates[0].seconds / count;
      const double fast = 1e9 * candidates[1].seconds / count;
      std::printf("%-22s %-11s %7.0f ns %7.0f ns %8.2f %7.0f%% %10d\n", view.name, lidar.name, slow,
                  fast, slow / fast, 100.0 * points / count, different);
    }
}

void benchSets(const std::vector<View>& views, const NamedLidar& lidar, int rounds) {
  std::printf("\n%-22s %-11s %10s %10s\n", "instruction set", "scene", "a ray", "different");
  for (const View& view : views) {
    const Tiles tiles = tilesOf(lidar, view.sensor);
    const std::size_t rays = countRays(tiles);
    const std::vector<std::string> sets = instructionSets();
    std::vector<std::vector<Hit>> hits(sets.size(), std::vector<Hit>(rays));
    std::vector<bench::Candidate> candidates;
    for (std::size_t s = 0; s < sets.size(); ++s)
      candidates.push_back({sets[s], [&, s] {
                              forceInstructionSet(sets[s]);
                              castTiles(*view.scene, tiles, hits[s]);
                            }});
    bench::timeOnProcessor(candidates, rounds);
    forceInstructionSet("");
    for (std::size_t s = 0; s < sets.size(); ++s) {
      int different = 0;
      for (std::size_t i = 0; i < rays; ++i) different += !same(hits[s][i], hits[0][i]);
      std::printf("%-22s %-11s %7.0f ns %10d\n", sets[s].c_str(), view.name,
                  1e9 * candidates[s].seconds / static_cast<double>(rays), different);
    }
  }
}

void benchSweeps(const std::vector<View>& views, const std::vector<NamedLidar>& lidars,
                 int rounds) {
  std::printf("\n%-22s %-11s %12s %12s %8s\n", "sweeps", "lidar", "1 thread", "2 threads", "ratio");
  ThreadPool one(1), two(2);
  for (const View& view : views)
    for (const NamedLidar& lidar : lidars) {
      Pose sensor;
      sensor.position = view.sensor;
      const auto run = [&](ThreadPool& threads) {
        Lidar exact{lidar.beams, {}};
        exact.model.noise = 0.0;
        sweep(*view.scene, exact, sensor, {}, threads);
      };
      std::vector<bench::Candidate> candidates{{"1", [&] { run(one); }}, {"2", [&] { run(two); }}};
      bench::timeInterleaved(candidates, rounds);
      std::printf("%-22s %-11s %9.1f ms %9.1f ms %8.2f\n", view.name, lidar.name,
                  1e3 * candidates[0].least, 1e3 * candidates[1].least,
                  candidates[0].least / candidates[1].least);
    }
}

// Sweeps of the shipped presets among wood, leaves and a lawn.
void benchPresets(const View& view, int rounds) {
  std::printf("\n%-22s %12s %12s %12s\n", "presets", "1 thread", "2 threads", "period");
  ThreadPool one(1), two(2);
  for (const char* name : {"vlp16", "os1_64", "os1_128", "utm30lx"}) {
    Lidar lidar;
    Faults faults;
    const std::string file = PACKAGE_FOLDER "/config/sensors/" + std::string(name) + ".yaml";
    YamlSection section(loadYamlFile(file), file, faults);
    describe(section, lidar);
    faults.throwIfAny();
    Pose sensor;
    sensor.position = view.sensor;
    std::vector<bench::Candidate> candidates{
        {"1", [&] { sweep(*view.scene, lidar, sensor, {}, one); }},
        {"2", [&] { sweep(*view.scene, lidar, sensor, {}, two); }}};
    bench::timeInterleaved(candidates, rounds);
    std::printf("%-22s %9.1f ms %9.1f ms %9.1f ms\n", name, 1e3 * candidates[0].least,
                1e3 * candidates[1].least, 1e3 / lidar.rate);
  }
}

void benchUpdate(const forest::ForestReplica& forest, const Lawn& lawn, Grove& grove, int rounds) {
  Trees trees;
  GrassVolume grass;
  Plants plants;
  ThreadPool one(1), two(2);
  int stamp = 0;
  std::vector<bench::Candidate> candidates{
      {"trees to a stamp",
       [&] { trees.update(forest, SENSOR, REACH, START + fromSeconds(0.1 * ++stamp)); }},
      {"grass to a stamp", [&] { lawn.show(grass, forest.wind(), 0.1 * stamp); }},
      {"plants to a stamp", [&] { grove.show(plants, one, SENSOR, REACH); }}};
  bench::timeOnProcessor(candidates, rounds);
  std::printf("\n%zu trees with %zu branches, all of them moving\n", trees.all().size(),
              trees.branches());
  for (const bench::Candidate& c : candidates)
    std::printf("%-22s %10.3f ms\n", c.name.c_str(), 1e3 * c.seconds);
  const auto timeWith = [&](ThreadPool& threads) {
    return bench::Candidate{
        std::to_string(threads.size()),
        [&] { trees.update(forest, SENSOR, REACH, START + fromSeconds(0.1 * ++stamp), threads); }};
  };
  std::vector<bench::Candidate> parallel{timeWith(one), timeWith(two)};
  bench::timeInterleaved(parallel, rounds);
  std::printf("trees, wall time: 1 thread %.3f ms, 2 threads %.3f ms\n", 1e3 * parallel[0].least,
              1e3 * parallel[1].least);
}

void benchSky(const std::vector<View>& views, int rounds) {
  std::printf("\n%-22s %12s %12s\n", "view of the sky", "a place", "open share");
  ThreadPool one(1);
  for (const View& view : views) {
    double open = 0.0;
    std::vector<bench::Candidate> candidates{
        {"sky", [&] { open = viewSky(*view.scene, view.sensor, REACH, one).open_share; }}};
    bench::timeOnProcessor(candidates, rounds);
    std::printf("%-22s %9.2f ms %12.3f\n", view.name, 1e3 * candidates[0].seconds, open);
  }
}

// The camera looks along x and a little down. A quick run takes fewer pixels.
void benchImages(const std::vector<View>& views, const bench::Options& options) {
  std::printf("\n%-22s %14s %14s %14s\n", "images, a pixel", "picture", "without shadow", "others");
  ThreadPool one(1);
  LensSettings lens;
  lens.width = options.quick ? 64 : 320;
  lens.height = 3 * lens.width / 4;
  Camera shaded;
  shaded.lens = lensOf(lens);
  Camera open = shaded;
  open.shadows = Shadows::NONE;
  Pose pose;
  pose.orientation = Quat{0.995, 0.0, 0.0998, 0.0} * Quat{0.5, -0.5, 0.5, -0.5};
  for (const View& view : views) {
    pose.position = view.sensor;
    const auto take = [&](const char* name, const Camera& camera, const Wanted& wanted) {
      return bench::Candidate{
          name, [&, wanted] { takeImages(*view.scene, camera, pose, {}, wanted, one); }};
    };
    std::vector<bench::Candidate> candidates{
        take("picture", shaded, {true, false, false, false}),
        take("without shadow", open, {true, false, false, false}),
        take("others", shaded, {false, true, true, true})};
    bench::timeOnProcessor(candidates, std::min(options.rounds, 5));
    std::printf("%-22s", view.name);
    for (const bench::Candidate& c : candidates)
      std::printf(" %11.0f ns", 1e9 * c.seconds / (lens.width * lens.height));
    std::printf("\n");
  }
}

/// All scenes of the bench.
class Scenes {
 public:
  explicit Scenes(int side)
      : forest_(movingForest(forest::gridLayout(side, 5.0), wind_)),
        bare_forest_(movingForest(bareLayout(side), wind_)) {
    lawn_.treadLane();
    bare_.trees.update(bare_forest_, SENSOR, REACH, START + fromSeconds(1.0));
    leaves_.trees.update(forest_, SENSOR, REACH, START + fromSeconds(1.0));
    both_.trees = leaves_.trees;
    for (Scene* scene : {&meadow_, &both_}) lawn_.show(scene->grass, wind_, 1.0);
    // A hay meadow of several species, seen by a low robot.
    hay_.layout.map = std::make_shared<const grass::FeatureMap>(
        grass::FeatureMap::load(std::string(PACKAGE_FOLDER) + "/config/meadow/meadow.yaml"));
    hay_.show(field_.grass, wind_, 1.0);
    addPeople();
    ThreadPool alone;
    grove_.show(shrubs_.plants, alone, SENSOR, REACH);
  }
  std::vector<View> views() const {
    return {{"wood", &bare_},
            {"wood and leaves", &leaves_},
            {"lawn", &meadow_},
            {"wood, leaves, lawn", &both_},
            {"hay, low sensor", &field_, Vec3(0.3, 0.4, 0.7)},
            {"people", &square_}};
  }
  /// With shrubs too, of which the reference tests every leaf: 1 ms a ray.
  std::vector<View> viewsOfAll() const {
    std::vector<View> out = views();
    out.push_back({"shrubs", &shrubs_});
    return out;
  }
  const forest::ForestReplica& forest() const { return forest_; }
  const Lawn& lawn() const { return lawn_; }
  Grove& grove() { return grove_; }

 private:
  // Shrubs in two rows on both sides of the sensor.
  static canopy::Layout hedges() {
    canopy::Layout out = canopy::shrubScene();
    out.kinds[0].leaves = 2600;
    out.plants.resize(12);
    for (std::size_t i = 0; i < out.plants.size(); ++i) {
      out.plants[i].seed = i + 1;
      out.plants[i].position = Vec3(5.0 + 2.0 * double(i / 2), i % 2 == 0 ? 7.0 : 13.0, 0.0);
    }
    return out;
  }
  static forest::Layout bareLayout(int side) {
    forest::Layout out = forest::gridLayout(side, 5.0);
    for (forest::Species& species : out.species)
      for (forest::LimbRule& limb : species.limbs) limb.leaves = 0.0;
    return out;
  }
  void addPeople() {
    std::vector<People::Person> people;
    for (std::uint32_t i = 0; i < 100; ++i) {
      crowd::Walker walker;
      walker.id = i + 1;
      walker.position = {3.0 * (i % 10) - 3.2, 3.0 * (i / 10) - 3.1};
      people.push_back({walker.id, crowd::skeletonOf(walker, terrain::HeightMap())});
    }
    square_.people.set(people);
  }

  const wind::Field wind_{breezeOf(Vec3(4, 2, 0))};
  const forest::ForestReplica forest_, bare_forest_;
  Lawn lawn_, hay_;
  Grove grove_{hedges()};
  Scene bare_, leaves_, meadow_, both_, field_, square_, shrubs_;
};

void run(const bench::Options& options) {
  Scenes scenes(options.quick ? 4 : 12);
  const std::vector<NamedLidar> lidars{
      {"16 x 900", beamsOf(16, 900), options.quick ? 10 : 1},
      {"128 x 2048", beamsOf(128, 2048), options.quick ? 100 : 16}};
  if (options.wants("rays")) benchRays(scenes.views(), lidars, options.rounds);
  if (options.wants("sets")) benchSets(scenes.viewsOfAll(), lidars[0], options.rounds);
  if (options.wants("sweeps"))
    benchSweeps(scenes.viewsOfAll(), lidars, std::min(options.rounds, 5));
  if (options.wants("presets")) benchPresets(scenes.viewsOfAll()[3], std::min(options.rounds, 5));
  if (options.wants("update"))
    benchUpdate(scenes.forest(), scenes.lawn(), scenes.grove(), options.rounds);
  if (options.wants("sky")) benchSky(scenes.viewsOfAll(), options.rounds);
  if (options.wants("images")) benchImages(scenes.viewsOfAll(), options);
}

}  // namespace
}  // namespace vegetation_sim::scan

int main(int argc, char** argv) {
  try {
    vegetation_sim::scan::run(vegetation_sim::bench::readOptions(
        argc, argv, {"rays", "sets", "sweeps", "presets", "update", "sky", "images"}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_bench: %s\n", error.what());
    return 2;
  }
}
