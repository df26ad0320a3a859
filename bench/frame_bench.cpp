// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the time of a frame in the shipped scenarios, as nodes and displays spend it, without
// ROS and graphics card: levels, physics, state, poses and meshes of trees; treading, levels, wind
// and drawing of grass; air and layers of leafy masses; paths and bodies of people.
// usage: frame_bench [--quick | --full] [--part SCENARIO,..] [--csv FILE]

#include <cstdio>

#include "frame/crowd_frame.h"
#include "frame/forest_frame.h"
#include "frame/leaf_frame.h"
#include "frame/meadow_frame.h"
#include "options.h"
#include "table.h"

namespace vegetation_sim::bench {
namespace {

/// Returns frames of one scenario with all its parts.
std::vector<Laps> framesOf(const Scene& scene, int count) {
  std::unique_ptr<forest::ForestFrame> trees;
  std::unique_ptr<grass::MeadowFrame> meadow;
  if (scene.forest) trees = std::make_unique<forest::ForestFrame>(scene);
  if (scene.grass) meadow = std::make_unique<grass::MeadowFrame>(scene);
  std::unique_ptr<canopy::LeafFrame> leaves;
  std::unique_ptr<crowd::CrowdFrame> people;
  if (scene.canopy) leaves = std::make_unique<canopy::LeafFrame>(scene);
  if (scene.crowd) people = std::make_unique<crowd::CrowdFrame>(scene);
  std::vector<Laps> out;
  for (int i = 0; i < count; ++i) {
    out.emplace_back();
    if (trees) trees->frame(out.back());
    if (meadow) meadow->frame(out.back());
    if (leaves) leaves->frame(out.back());
    if (people) people->frame(out.back());
  }
  return out;
}

void run(const Scene& scene, const Options& options, Table& table) {
  const std::vector<Laps> frames = framesOf(scene, options.quick ? 60 : 300);
  std::printf("%s\n", scene.name.c_str());
  const auto report = [&](const std::string& part, const auto& of) {
    std::vector<double> times;
    for (const Laps& frame : frames) times.push_back(of(frame));
    std::sort(times.begin(), times.end());
    const double median = times[times.size() / 2], high = times[times.size() * 99 / 100];
    std::printf("  %-18s %8.3f ms, 99 %% of frames below %8.3f ms\n", part.c_str(), 1e3 * median,
                1e3 * high);
    table.row(scene.name, part, 1e3 * median, 1e3 * high);
  };
  for (std::size_t k = 0; k < frames[0].parts().size(); ++k)
    report(frames[0].parts()[k].first, [k](const Laps& f) { return f.parts()[k].second; });
  report("frame", [](const Laps& f) { return f.sum(); });
}

}  // namespace
}  // namespace vegetation_sim::bench

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim::bench;
    const Options options = readOptions(argc, argv, scenarioNames());
    Table table(options.csv, "scenario,part,ms,ms_99");
    for (const std::string& name : options.parts) run(loadScene(name), options, table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "frame_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
