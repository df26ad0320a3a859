// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures error against processor time of the trees and of the grass of whole shipped scenarios,
// by the tolerance. The error of trees is that of the tips of branches in the picture relative to
// trees whose joints are all physical; 99 % of trees and instants are below it. The error of grass
// is the largest length that the models of its tiles omit; it is left out where all are textures.
// usage: scene_bench [--quick | --full] [--part SCENARIO,..] [--csv FILE]

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "frame/forest_frame.h"
#include "frame/meadow_frame.h"
#include "options.h"
#include "scenes/forest/prediction_scene.h"
#include "table.h"

namespace vegetation_sim::bench {
namespace {

const std::vector<double> FACTORS{0.25, 1.0, 4.0, 16.0};  // of the default tolerances

template <class Frame>
double medianTime(Frame& frame, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    Laps laps;
    frame.frame(laps);
    times.push_back(laps.sum());
  }
  std::nth_element(times.begin(), times.begin() + count / 2, times.end());
  return times[static_cast<std::size_t>(count / 2)];
}

double highErrorOf(const forest::Prediction::Looks& looks) {
  std::vector<double> errors;
  for (const auto& [tree, each] : looks)
    for (const forest::Prediction::Look& look : each) errors.push_back(look.measured);
  if (errors.empty()) return 0.0;
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

class Report {
 public:
  Report(const Options& options, Table& table) : options_(options), table_(table) {}

  void measureTrees(const Scene& scene) {
    std::vector<forest::Settings> settings;
    for (const double factor : FACTORS) {
      settings.emplace_back();
      settings.back().tolerance *= factor;
    }
    // The first settings are the finest: every tree that moves with them is measured.
    forest::Prediction truth(*scene.forest, scene.terrain, scene.wind, frameViewpoint(scene),
                             FRAME_START, 0.5, settings);
    const auto looks = truth.lookWithAll(options_.full ? 4 : options_.quick ? 1 : 2);
    for (std::size_t k = 0; k < settings.size(); ++k) {
      forest::ForestFrame frame(scene, settings[k]);
      add(scene, "trees", settings[k].tolerance, medianTime(frame, frames()), highErrorOf(looks[k]),
          FACTORS[k]);
    }
  }
  void measureGrass(const Scene& scene) {
    for (const double factor : FACTORS) {
      grass::MeadowSettings settings;
      settings.tolerance *= factor;
      grass::MeadowFrame frame(scene, settings);
      const double seconds = medianTime(frame, frames());
      if (frame.omission() > 0.0)  // else no tile is more than a texture
        add(scene, "grass", settings.tolerance, seconds, frame.omission(), factor);
    }
  }

 private:
  int frames() const { return options_.full ? 40 : options_.quick ? 5 : 20; }
  void add(const Scene& scene, const std::string& part, double tolerance, double seconds,
           double error, double factor) {
    std::printf("%-14s %-6s tolerance %6.2f pixel: %7.3f ms, %8.3f pixel\n", scene.name.c_str(),
                part.c_str(), tolerance, 1e3 * seconds, error);
    table_.row(scene.name, part, tolerance, 1e3 * seconds, error, factor == 1.0 ? 1 : 0);
  }

  const Options& options_;
  Table& table_;
};

}  // namespace
}  // namespace vegetation_sim::bench

int main(int argc, char** argv) {
  using namespace vegetation_sim::bench;
  try {
    const Options options = readOptions(argc, argv, scenarioNames());
    Table table(options.csv, "scenario,part,tolerance,ms,error,chosen");
    Report report(options, table);
    for (const std::string& name : options.parts) {
      const Scene scene = loadScene(name);
      if (scene.forest) report.measureTrees(scene);
      if (scene.grass) report.measureGrass(scene);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
