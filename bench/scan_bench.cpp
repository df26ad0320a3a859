// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a sensor: rays through a wood, a lawn and both, against a test of every
// branch, and the update of the scene to a stamp. Processor time of one thread.
// usage: scan_bench [ROUNDS] [--quick]

#include <cstdio>

#include "options.h"
#include "package_folder.h"
#include "processor_time.h"
#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/lidar_scene.h"
#include "sensors/sweep.h"

namespace vegetation_sim::scan {
namespace {

const Vec3 SENSOR(10.3, 10.4, 1.2);
constexpr double REACH = 60.0;

Ray rayOf(const Vec3& sensor, std::uint64_t i) {
  return {sensor, randomDirection(Random(1), i, -0.26, 0.26)};
}

struct Rays {
  const char* name;
  const Scene* scene;
  Vec3 sensor{SENSOR};
};

// A few rays that test everything represent all.
void benchRays(const std::vector<Rays>& scenes, int rounds, int rays) {
  std::printf("%-24s %12s %12s %10s %10s\n", "rays", "per second", "plain", "ratio", "points");
  for (const Rays& one : scenes) {
    int points = 0;
    const auto run = [&](auto&& castOne, int count) {
      points = 0;
      for (int i = 0; i < count; ++i)
        points +=
            castOne(*one.scene, rayOf(one.sensor, static_cast<std::uint64_t>(i)), REACH).label !=
            Label::NONE;
    };
    const int few = rays / 100;
    std::vector<bench::Candidate> candidates{{"plain", [&] { run(castPlain, few); }},
                                             {"fast", [&] { run(cast, rays); }}};
    bench::timeOnProcessor(candidates, rounds);
    const double fast = rays / candidates[1].seconds, plain = few / candidates[0].seconds;
    std::printf("%-24s %12.0f %12.0f %10.1f %9.0f%%\n", one.name, fast, plain, fast / plain,
                100.0 * points / rays);
  }
}

void benchUpdate(const forest::ForestReplica& forest, const Lawn& lawn, int rounds) {
  Trees trees;
  GrassVolume grass;
  int stamp = 0;
  std::vector<bench::Candidate> candidates{
      {"trees to a stamp",
       [&] { trees.update(forest, SENSOR, REACH, START + fromSeconds(0.1 * ++stamp)); }},
      {"grass to a stamp", [&] { lawn.show(grass, forest.wind(), 0.1 * stamp); }}};
  bench::timeOnProcessor(candidates, rounds);
  std::printf("\n%zu trees with %zu branches, all of them moving\n", trees.all().size(),
              trees.branches());
  for (const bench::Candidate& c : candidates)
    std::printf("%-24s %12.3f ms\n", c.name.c_str(), 1e3 * c.seconds);
}

void run(const bench::Options& options) {
  const int side = options.quick ? 4 : 12;
  const wind::Field wind = breezeOf(Vec3(4, 2, 0));
  const auto forest = movingForest(forest::gridLayout(side, 5.0), wind);
  Lawn lawn;
  lawn.treadLane();
  Scene wood, meadow, both;
  for (Scene* scene : {&wood, &both})
    scene->trees.update(forest, SENSOR, REACH, START + fromSeconds(1.0));
  for (Scene* scene : {&meadow, &both}) lawn.show(scene->grass, wind, 1.0);
  // A hay meadow of several species, seen by a low robot.
  Lawn hay;
  hay.layout.map = std::make_shared<const grass::FeatureMap>(
      grass::FeatureMap::load(std::string(PACKAGE_FOLDER) + "/config/meadow/meadow.yaml"));
  Scene field;
  hay.show(field.grass, wind, 1.0);
  benchRays({{"wood", &wood},
             {"lawn", &meadow},
             {"wood and lawn", &both},
             {"hay meadow, low sensor", &field, Vec3(0.3, 0.4, 0.7)}},
            options.rounds, options.quick ? 5000 : 30000);
  benchUpdate(forest, lawn, options.rounds);
}

}  // namespace
}  // namespace vegetation_sim::scan

int main(int argc, char** argv) {
  try {
    vegetation_sim::scan::run(vegetation_sim::bench::readOptions(argc, argv, {}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_bench: %s\n", error.what());
    return 2;
  }
}
