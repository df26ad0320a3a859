// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the work that nodes split among threads, on 1, 2, 4, ... threads up to the number of
// processor cores and on at least 2: wall time, because processor time is that of all threads.
// The works are a tick of physical trees, one of walkers among trunks, a sweep of a lidar and an
// image of a camera. Other programs should not run meanwhile.
// usage: thread_bench [ROUNDS] [--quick | --full] [--part trees,crowd,lidar,camera] [--csv FILE]

#include <cstdio>
#include <memory>
#include <thread>

#include "crowd/agents/crowd.h"
#include "interleaved.h"
#include "options.h"
#include "scenes/forest/physical_forest.h"
#include "scenes/sensors/lidar_scene.h"
#include "sensors/camera/pixels.h"
#include "sensors/sweep.h"
#include "table.h"

namespace vegetation_sim {
namespace {

using bench::Options;

/// Work that is split among threads.
struct Work {
  std::string name;
  std::function<void(int)> setThreads;
  std::function<void()> run;
};

/// Returns a size for each of the three extents of a run.
int sizeFor(const Options& options, int quick, int usual, int full) {
  return options.quick ? quick : options.full ? full : usual;
}

Work treesOf(const Options& options) {
  const auto forest = std::make_shared<forest::PhysicalForest>(
      256, static_cast<std::size_t>(sizeFor(options, 5000, 20000, 100000)));
  return {"trees", [forest](int threads) { forest->setThreads(threads); },
          [forest] {
            for (int i = 0; i < 5; ++i) forest->advance();
          }};
}

Work crowdOf(const Options& options) {
  const int walkers = sizeFor(options, 1000, 5000, 20000);
  const double side = std::sqrt(90.0 * walkers);
  const auto crowd =
      std::make_shared<crowd::Crowd>(3, crowd::CrowdSettings(), crowd::Area{0.0, side, 0.0, side},
                                     std::make_shared<terrain::HeightMap>());
  const Random random(11);
  std::uint64_t drawn = 0;
  const auto draw = [&] { return random.uniform(drawn++, 0.0, side); };
  std::vector<crowd::Obstacle> trunks;
  for (int i = 0; i < 10 * walkers; ++i)
    trunks.push_back(crowd::discObstacle({draw(), draw()}, 0.2));
  crowd->setObstacles(std::move(trunks));
  for (int i = 0; i < walkers; ++i) {
    crowd::Spawn spawn;
    spawn.position = {draw(), draw()};
    crowd->spawn(spawn);
  }
  const auto run = [crowd] {
    for (int i = 0; i < 5; ++i)
      crowd->advance(crowd->snapshot().stamp + NANOSECONDS_PER_SECOND / 60);
  };
  for (int i = 0; i < 10; ++i) run();  // by then walkers have left the trunks
  return {"crowd", [crowd](int threads) { crowd->setThreads(threads); }, run};
}

/// A grove on a lawn, around a sensor.
struct View {
  View() {
    scene.trees.update(forest, pose.position, REACH, scan::START + NANOSECONDS_PER_SECOND);
    lawn.show(scene.grass, wind, 1.0);
  }
  static constexpr double REACH = 60.0;
  const wind::Field wind{scan::breezeOf(Vec3(4, 2, 0))};
  const forest::ForestReplica forest{scan::movingForest(forest::gridLayout(4, 5.0), wind)};
  Pose pose{Vec3(8.3, 8.4, 1.2), Quat{1.0, 0.0, 0.0, 0.0}};
  scan::Lawn lawn;
  scan::Scene scene;
  std::unique_ptr<ThreadPool> threads;
};

Work lidarOf(const Options& options, const std::shared_ptr<View>& view) {
  scan::Lidar lidar;
  lidar.beams.rings = sizeFor(options, 16, 32, 128);
  lidar.beams.columns = sizeFor(options, 900, 1024, 2048);
  return {"lidar", [view](int threads) { view->threads = std::make_unique<ThreadPool>(threads); },
          [view, lidar] { scan::sweep(view->scene, lidar, view->pose, {}, *view->threads); }};
}

Work cameraOf(const Options& options, const std::shared_ptr<View>& view) {
  scan::LensSettings lens;
  lens.width = sizeFor(options, 64, 160, 640);
  lens.height = 3 * lens.width / 4;
  scan::Camera camera;
  camera.lens = lensOf(lens);
  Pose optical = view->pose;
  optical.orientation = Quat{0.995, 0.0, 0.0998, 0.0} * Quat{0.5, -0.5, 0.5, -0.5};
  return {"camera", [view](int threads) { view->threads = std::make_unique<ThreadPool>(threads); },
          [view, camera, optical] {
            scan::takeImages(view->scene, camera, optical, {}, {}, *view->threads);
          }};
}

std::vector<int> threadCounts(int cores) {
  std::vector<int> out{1, 2};
  for (int threads = 4; threads <= cores; threads *= 2) out.push_back(threads);
  if (cores > out.back()) out.push_back(cores);
  return out;
}

void measure(const Work& work, const Options& options, bench::Table& table) {
  using Clock = std::chrono::steady_clock;
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const std::vector<int> counts = threadCounts(cores);
  std::vector<std::vector<double>> times(counts.size());
  for (int round = -1; round < options.rounds; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i) {
      work.setThreads(counts[i]);
      const auto start = Clock::now();
      work.run();
      const std::chrono::duration<double> spent = Clock::now() - start;
      if (round >= 0) times[i].push_back(spent.count());
    }
  double alone = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    const double median = times[i][times[i].size() / 2];
    if (i == 0) alone = median;
    std::printf("%-7s %3d threads of %d cores %9.2f ms %6.2f times as fast\n", work.name.c_str(),
                counts[i], cores, 1e3 * median, alone / median);
    table.row(work.name, counts[i], cores, 1e3 * median, alone / median);
  }
}

void run(const Options& options) {
  bench::Table table(options.csv, "work,threads,cores,ms,times_faster");
  if (options.wants("trees")) measure(treesOf(options), options, table);
  if (options.wants("crowd")) measure(crowdOf(options), options, table);
  if (!options.wants("lidar") && !options.wants("camera")) return;
  const auto view = std::make_shared<View>();
  if (options.wants("lidar")) measure(lidarOf(options, view), options, table);
  if (options.wants("camera")) measure(cameraOf(options, view), options, table);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    run(bench::readOptions(argc, argv, {"trees", "crowd", "lidar", "camera"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thread_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
