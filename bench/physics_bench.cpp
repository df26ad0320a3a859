// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a simulated second of a tree at equal accuracy, by our integrators and by
// other engines.
// usage: physics_bench [--quick] [--branches N,..] [--trees NAME,..] [--loads gust,pull]
// [--engines PART,..] [--cap SECONDS] [--window SECONDS] [--tolerance ERROR] [--rounds N]
// [--threads N] [--csv FILE] [--cache FOLDER]
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "package_folder.h"
#include "trees/report.h"
#include "trees/scaling.h"

namespace vegetation_sim::bench {
namespace {

struct Options {
  std::vector<std::string> trees{"fractal", "oak"}, loads{"gust", "pull"};
  std::vector<std::string> branches{"100", "1000", "10000"};
  std::vector<std::string> engines;  ///< parts of names; empty for all
  std::string csv, cache;
  double cap{60.0};                     ///< limit of one run [s]
  double tolerance{1e-8};               ///< tolerance of references
  double window{INTERVALS * INTERVAL};  ///< time over which motions are compared [s]
  int rounds{7};
  int threads{1};  ///< if more, a tree on each of them is measured too
};

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> out;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) out.push_back(word);
  return out;
}

Options readOptions(int argc, char** argv) {
  Options out;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--quick") {
      out.branches = {"100"};
      out.cap = 3.0;
      out.rounds = 5;
      continue;
    }
    if (i + 1 >= argc) throw std::invalid_argument(key + ": unknown, or its value is missing");
    const std::string value = argv[++i];
    if (key == "--trees")
      out.trees = split(value);
    else if (key == "--loads")
      out.loads = split(value);
    else if (key == "--branches")
      out.branches = split(value);
    else if (key == "--engines")
      out.engines = split(value);
    else if (key == "--csv")
      out.csv = value;
    else if (key == "--cache")
      out.cache = value;
    else if (key == "--cap")
      out.cap = std::stod(value);
    else if (key == "--window")
      out.window = std::stod(value);
    else if (key == "--tolerance")
      out.tolerance = std::stod(value);
    else if (key == "--threads")
      out.threads = std::clamp(std::stoi(value), 1, 64);
    else if (key == "--rounds")
      out.rounds = std::stoi(value);
    else
      throw std::invalid_argument(key + ": unknown");
  }
  return out;
}

std::vector<Maker> allEngines() {
  std::vector<Maker> out = ownEngines();
  for (const Maker& maker : positionEngines()) out.push_back(maker);
#ifdef WITH_BULLET
  for (const Maker& maker : bulletEngines()) out.push_back(maker);
#endif
#ifdef WITH_DART
  for (const Maker& maker : dartEngines()) out.push_back(maker);
#endif
#ifdef WITH_MUJOCO
  for (const Maker& maker : mujocoEngines()) out.push_back(maker);
#endif
#ifdef WITH_SIMBODY
  for (const Maker& maker : simbodyEngines()) out.push_back(maker);
#endif
  return out;
}

TestTree treeOf(const std::string& name, int branches) {
  if (name == "fractal") return fractalTree(branches);
  return speciesTree(std::string(PACKAGE_FOLDER) + "/config/species/" + name + ".yaml", branches);
}

struct Rival {
  Maker maker;
  std::unique_ptr<Engine> engine;
};

// Returns the seconds of a step of one tree, with `steps` of them per interval, with or without
// load.
double timeStep(const Rival& rival, double steps, bool loaded) {
  const double h = INTERVAL / std::max(1.0, steps), start = processorTime();
  double spent = 0.0;
  int done = 0;
  for (; done < 2 || spent < 0.01; spent = processorTime() - start) {
    for (int i = 0; i < 2; ++i, ++done)
      rival.engine->step(loaded ? LOADED_INTERVALS / 2 : INTERVALS - 1, loaded ? 0.5 : 2.95, h);
  }
  return spent / done;
}

// Rivals take turns, so that slow phases of a shared machine affect all of them alike.
void timeInterleaved(const std::vector<Rival>& rivals, int rounds, int intervals,
                     std::vector<Row>& rows) {
  const double share = std::min(1.0, 1.0 * LOADED_INTERVALS / intervals);
  std::vector<std::vector<double>> times(rivals.size() * TARGETS.size());
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::size_t rival = i / TARGETS.size();
      const double steps = rows[rival].answers[i % TARGETS.size()].steps;
      rivals[rival].engine->rest();
      const double loaded = timeStep(rivals[rival], steps, true);
      const double free = timeStep(rivals[rival], steps, false);
      if (round >= 0) times[i].push_back(share * loaded + (1.0 - share) * free);
    }
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    rows[i / TARGETS.size()].step_seconds[i % TARGETS.size()] = times[i][times[i].size() / 2];
  }
}

Cell measure(const TestTree& tree, const TestLoad& load, const std::vector<Rival>& rivals,
             const Options& options) {
  Cell out;
  out.tree = tree.name;
  out.load = load.name();
  out.branches = static_cast<int>(tree.links.size());
  const auto intervals =
      std::clamp(static_cast<int>(options.window / INTERVAL + 0.5), 1, INTERVALS);
  Reference references[2];
  for (const Bend bend : {Bend::SWING, Bend::HINGES}) {
    const auto bends_so = [&](const Rival& rival) { return rival.maker.bend == bend; };
    if (std::none_of(rivals.begin(), rivals.end(), bends_so)) continue;
    Reference& reference = references[static_cast<int>(bend)];
    reference =
        referenceOf(tree, load, bend, options.tolerance, options.cap, options.cache, intervals);
    out.converged = std::max(out.converged, reference.converged);
    std::fprintf(stderr, "%s %d %s: reference, %s, converged to %.0e with %d steps an interval\n",
                 tree.name.c_str(), out.branches, load.name(), nameOf(bend), reference.converged,
                 reference.steps);
  }
  for (const Rival& rival : rivals) {
    Row row;
    row.engine = rival.maker.name;
    row.peer = rival.maker.peer;
    row.fast = rival.maker.fast;
    Explorer explorer(*rival.engine, references[static_cast<int>(rival.maker.bend)], options.cap);
    for (std::size_t k = 0; k < TARGETS.size(); ++k)
      row.answers[k] = explorer.longestStep(TARGETS[k]);
    for (const auto& [steps, point] : explorer.points()) row.points.push_back(point);
    out.rows.push_back(row);
    std::fprintf(stderr, "%s %d %s: %s done after %.0f s\n", tree.name.c_str(), out.branches,
                 load.name(), row.engine.c_str(), processorTime());
  }
  timeInterleaved(rivals, options.rounds, intervals, out.rows);
  return out;
}

bool wanted(const std::string& name, const Options& options) {
  const auto in_name = [&](const std::string& part) { return name.find(part) != name.npos; };
  return options.engines.empty() ||
         std::any_of(options.engines.begin(), options.engines.end(), in_name);
}

std::vector<Rival> build(const TestTree& tree, const TestLoad& load, const Options& options) {
  std::vector<Rival> out;
  for (const Maker& maker : allEngines()) {
    if (!wanted(maker.name, options)) continue;
    if (static_cast<int>(tree.links.size()) > maker.most_branches) continue;
    const double start = processorTime();
    out.push_back({maker, maker.make(tree, load, options.cache)});
    std::fprintf(stderr, "%s: built in %.1f ms\n", maker.name.c_str(),
                 1e3 * (processorTime() - start));
  }
  return out;
}

void printScaling(const Cell& cell, const TestTree& tree, const TestLoad& load,
                  const std::vector<Rival>& rivals, const Options& options) {
  std::printf("trees per second with a tree on each of %d threads, times those on one:",
              options.threads);
  for (std::size_t i = 0; i < rivals.size(); ++i)
    std::printf("%s %s %.2f", i > 0 ? "," : "", rivals[i].maker.name.c_str(),
                scalingOf(rivals[i].maker, tree, load, options.cache, cell.rows[i].answers[1].steps,
                          options.threads, options.rounds));
  std::printf("\n");
}

int run(const Options& options) {
  if (!options.cache.empty()) std::filesystem::create_directories(options.cache);
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (!options.csv.empty() && !csv) throw std::runtime_error(options.csv + ": cannot be written");
  if (csv) writeHead(csv);
  std::vector<Cell> cells;
  for (const std::string& branches : options.branches) {
    for (const std::string& name : options.trees) {
      const TestTree tree = treeOf(name, std::stoi(branches));
      TestLoad load = gust(tree);
      const std::vector<Rival> rivals = build(tree, load, options);
      for (const std::string& which : options.loads) {
        load = which == "gust" ? gust(tree) : pull(tree);
        cells.push_back(measure(tree, load, rivals, options));
        print(cells.back());
        if (options.threads > 1) printScaling(cells.back(), tree, load, rivals, options);
        if (csv) write(cells.back(), csv);
      }
    }
  }
  printSummary(cells);
  if (csv) std::fclose(csv);
  return 0;
}

}  // namespace
}  // namespace vegetation_sim::bench

int main(int argc, char** argv) {
  try {
    return vegetation_sim::bench::run(vegetation_sim::bench::readOptions(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "physics_bench: %s\n", error.what());
    return 1;
  }
}
