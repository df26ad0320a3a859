// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the governor (N7): cost and error of ever more trees on one budget and the time of the
// choice; a still forest without viewer; one held branch among thousands of trees; predicted errors
// of the trees of the shipped scenarios against measured ones.
// usage: governor_bench [ROUNDS] [--quick | --full] [--part NAME,..] [--csv FILE]
#include <algorithm>
#include <cstdio>
#include <map>

#include "frame/posed_tree.h"
#include "frame/scene.h"
#include "options.h"
#include "processor_time.h"
#include "scenes/forest/prediction_scene.h"
#include "table.h"

namespace vegetation_sim::bench {
namespace {

using namespace forest;

constexpr double BUDGET = 1.0;  // [ms] per frame
constexpr int RATE = 30;        // ticks per second [Hz]

/// A square of trees in a breeze, and a viewer in its middle.
struct Scene {
  Scene(int side, bool watched, bool windy)
      : watched(watched), forest(gridLayout(side, 9.0), flatTerrain(), settings()) {
    if (windy) forest.setWind(wind::Field({makeBreeze(1, Vec3(5.0, 1.0, 0.0))}, 3));
    viewer.position = Vec3(4.5 * (side - 1), 4.5 * (side - 1), 3.0);
  }
  static Settings settings() {
    Settings out;
    out.budget.frame_time = BUDGET;
    return out;
  }
  void advance() {
    if (watched) forest.setViewers({viewer});
    forest.advance(grid.timeOf(tick++));
    forest.updateView(tick % RATE == 0);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) advance();
  }
  /// Returns the processor time of a tick [s].
  double timeTicks(int ticks) {
    const double start = processorTime();
    run(ticks);
    return (processorTime() - start) / ticks;
  }

  bool watched;
  Forest forest;
  Viewpoint viewer;
  TickGrid grid{RATE};
  std::int64_t tick{TickGrid(RATE).tickAt(1700000000LL * NANOSECONDS_PER_SECOND)};
};

/// Results over some seconds: most changes of tier of any tree per second; worst cost and error.
struct Observed {
  double changes{0.0}, least_cost{1e9}, most_cost{0.0}, error{0.0}, typical_error{0.0};
};

Observed observe(Scene& scene, int duration) {
  Observed out;
  std::map<std::uint32_t, int> levels, changes;
  for (int i = 0; i < duration * RATE; ++i) {
    scene.advance();
    const GovernorFigures& figures = scene.forest.viewChoice().figures();
    out.least_cost = std::min(out.least_cost, figures.cost);
    out.most_cost = std::max(out.most_cost, figures.cost);
    out.error = std::max(out.error, figures.largest);
    std::vector<double> errors;
    for (const Plant& plant : scene.forest.viewChoice().plants()) {
      errors.push_back(plant.error[static_cast<std::size_t>(plant.chosen)]);
      const auto known = levels.find(plant.id);
      if (known != levels.end() && known->second != plant.chosen) ++changes[plant.id];
      levels[plant.id] = plant.chosen;
    }
    if (errors.empty()) continue;
    std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
    out.typical_error = std::max(out.typical_error, errors[errors.size() / 2]);
  }
  for (const auto& entry : changes)
    out.changes = std::max(out.changes, static_cast<double>(entry.second) / duration);
  return out;
}

/// Returns the median processor time of the poses of a picture, of all moving trees on their tiers
/// [s].
double timePoses(const Scene& scene, int pictures) {
  const Nanoseconds now = scene.grid.timeOf(scene.tick - 1);
  const wind::Instant wind = scene.forest.snapshot().wind.at(now);
  std::map<std::uint32_t, PosedTree> trees;
  for (const Plant& plant : scene.forest.viewChoice().plants())
    if (plant.chosen > 0) trees.emplace(plant.id, PosedTree(scene.forest, plant.id, scene.viewer));
  std::vector<double> times;
  for (int i = 0; i < pictures; ++i) {
    const double start = processorTime();
    for (auto& [id, tree] : trees) tree.pose(scene.forest, id, wind, now);
    times.push_back(processorTime() - start);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void measureBudget(const Options& options) {
  Table table(options.csv,
              "trees,budget_ms,asked_ms,least_ms,cost_ms,error_px,median_px,changes,choice_ms,"
              "poses_ms");
  std::printf("\na breeze of 5 m/s, budget %.1f ms a frame, tolerance 1 pixel\n", BUDGET);
  std::printf(
      "| trees | asked for ms | least to most ms | largest error px | median px | held back | "
      "changes/s | choice ms | poses ms |\n");
  for (const int side : {4, 8, 16, 32, 64, 128}) {
    if (side > (options.full ? 128 : 64)) break;
    Scene scene(side, true, true);
    scene.run(90);
    const double choice = 1e3 * scene.timeTicks(options.quick ? 10 : 60);
    const Observed seen = observe(scene, options.quick ? 1 : 4);
    const GovernorFigures& f = scene.forest.viewChoice().figures();
    const double poses = 1e3 * timePoses(scene, options.quick ? 10 : 60);
    std::printf(
        "| %5d | %12.3f | %5.3f to %5.3f | %16.2f | %9.2f | %9zu | %9.2f | %9.3f | %8.3f |\n",
        side * side, f.wanted, seen.least_cost, seen.most_cost, seen.error, seen.typical_error,
        f.held_back, seen.changes, choice, poses);
    table.row(side * side, f.budget, f.wanted, seen.least_cost, seen.most_cost, seen.error,
              seen.typical_error, seen.changes, choice, poses);
  }
}

void measureStill() {
  Scene scene(64, false, false);
  scene.run(10);
  std::printf("\nstill, unwatched, 4096 trees: %.4f %% of a core\n",
              100.0 * RATE * scene.timeTicks(300));
}

void measureHand(const Options& options) {
  Scene free(64, true, true), held(64, true, true);
  for (Scene* scene : {&free, &held}) scene->run(60);
  const std::uint32_t id = 32 * 64 + 32;
  const Tree tree = growTree(held.forest.layout(), id, held.forest.terrain());
  const int branch = tree.skeleton.depth_end[2] - 1;
  Grab grab;
  grab.point = {id, branch, 0.0};
  grab.target = tree.foot + tree.skeleton.branches[static_cast<std::size_t>(branch)].rest.position +
                Vec3(0.2, 0.0, 0.0);
  held.forest.addGrab(grab);
  for (Scene* scene : {&free, &held}) scene->run(30);
  std::vector<Candidate> candidates{{"free", [&] { free.run(10); }},
                                    {"held", [&] { held.run(10); }}};
  timeOnProcessor(candidates, options.rounds);
  std::printf(
      "\na branch held of 4096 trees (%zu physical): %.3f ms a tick, %.3f ms without: %.2f x\n",
      held.forest.physicsFigures().branches, 1e2 * candidates[1].seconds,
      1e2 * candidates[0].seconds, candidates[1].seconds / candidates[0].seconds);
}

/// Counts over the trees of a scenario: how many there are, and how many samples of their errors
/// fall in which class.
struct PredictionCounts {
  int trees{0}, modal{0}, fine{0}, within{0};
  double least{1e9}, most{0.0};
  int samples{0}, held{0};
  int known{0}, missed{0};  ///< errors above the tolerance: predicted, and not predicted

  void add(const std::vector<Prediction::Look>& each) {
    const double ratio = Prediction::ratioOf(each);
    ++trees;
    modal += each.back().tier == MODAL_LEVEL;
    fine += each.back().tier == FINE_MODAL_TIER;
    within += ratio > 0.5 && ratio < 2.0;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    for (const Prediction::Look& look : each) {
      const double tolerance = Settings().tolerance;
      ++samples;
      held += look.measured <= tolerance;
      known += look.measured > tolerance && look.predicted > tolerance;
      missed += look.measured > tolerance && look.predicted <= tolerance;
    }
  }
  void print(const std::string& name, double settle) const {
    const auto share = [](int part, int all) { return 100.0 * part / all; };
    std::printf(
        "| %-12s | %4.1f | %4d | %3d | %3d | %5.1f %% | %.2f to %.2f | %5.1f %% | %4.1f %% | %4.1f "
        "%% |\n",
        name.c_str(), settle, trees, modal, fine, share(within, trees), least, most,
        share(held, samples), share(known, samples), share(missed, samples));
    std::fflush(stdout);
  }
};

void addRow(Table& table, const std::string& scenario, std::uint32_t tree,
            const std::vector<Prediction::Look>& looks) {
  double predicted = 0.0, measured = 0.0;
  for (const Prediction::Look& look : looks) {
    predicted = std::max(predicted, look.predicted);
    measured = std::max(measured, look.measured);
  }
  const int tier = looks.back().tier;
  table.row(scenario, tree,
            tier == MODAL_LEVEL       ? "modes"
            : tier == FINE_MODAL_TIER ? "fine modes"
                                      : "procedural",
            predicted, measured);
}

/// Compares the largest error of each tree over some seconds, predicted and measured against the
/// full chain. The table has them for trees after the longer time of settling.
void measurePrediction(const Options& options) {
  Table table(options.parts.size() == 1 ? options.csv : "",
              "scenario,tree,model,predicted,measured");
  std::printf(
      "\n| scenario | begun after s | trees that move | in modes | in fine ones | predicted within "
      "2 x | worst ratios | samples within the tolerance | above it: predicted | not predicted "
      "|\n");
  PredictionCounts all;
  for (const std::string& name : scenarioNames()) {
    const bench::Scene scene = loadScene(name);
    if (!scene.forest) continue;
    for (const double settle : {0.5, 10.0}) {
      if (options.quick && settle < 1.0) continue;
      Prediction prediction(*scene.forest, scene.terrain, scene.wind, frameViewpoint(scene),
                            FRAME_START, settle);
      PredictionCounts counts;
      for (const auto& [tree, each] : prediction.look(options.quick ? 3 : 10)) {
        counts.add(each);
        all.add(each);
        if (settle > 1.0) addRow(table, name, tree, each);
      }
      if (counts.trees > 0) counts.print(name, settle);
    }
  }
  all.print("all", 0.0);
}

}  // namespace
}  // namespace vegetation_sim::bench

int main(int argc, char** argv) {
  using namespace vegetation_sim::bench;
  try {
    const Options options = readOptions(argc, argv, {"budget", "still", "hand", "scenarios"});
    if (options.wants("budget")) measureBudget(options);
    if (options.wants("still")) measureStill();
    if (options.wants("hand")) measureHand(options);
    if (options.wants("scenarios")) measurePrediction(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "governor_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
