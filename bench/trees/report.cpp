// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/report.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::bench {
namespace {

const char* markOf(Answer::Kind kind) {
  const char* const marks[] = {" ", "~", ">", "never"};
  return marks[static_cast<int>(kind)];
}

// Prints the ratios of a peer, or of the best one, to an engine.
void printRatios(const std::vector<Cell>& cells, const std::string& engine,
                 const std::string& peer) {
  std::printf("%-26s %-26s", engine.c_str(), peer.empty() ? "best peer" : peer.c_str());
  for (std::size_t k = 0; k < TARGETS.size(); ++k) {
    double logs = 0.0, least = 0.0;
    int count = 0, bounds = 0;
    for (const Cell& cell : cells)
      for (const Row& row : cell.rows) {
        if (row.engine != engine) continue;
        const Ratio ratio = ratioOf(cell, row, k, peer);
        if (ratio.value <= 0.0) continue;
        least = count == 0 ? ratio.value : std::min(least, ratio.value);
        logs += std::log(ratio.value);
        ++count;
        bounds += ratio.bound;
      }
    if (count == 0)
      std::printf(" | %.0e %29s", TARGETS[k], "never");
    else
      std::printf(" | %.0e %7.2f %8.1f %4d (%3d)  ", TARGETS[k], least, std::exp(logs / count),
                  count, bounds);
  }
  std::printf("\n");
}

}  // namespace

Ratio ratioOf(const Cell& cell, const Row& own, std::size_t target, const std::string& peer) {
  Ratio out;
  double best = 0.0;
  for (const Row& row : cell.rows) {
    if (peer.empty() ? !row.peer : row.engine != peer) continue;
    if (row.answers[target].kind == Answer::Kind::NEVER || (best > 0.0 && row.cost(target) >= best))
      continue;
    best = row.cost(target);
    out = {best / own.cost(target), row.answers[target].kind == Answer::Kind::AT_LEAST, row.engine};
  }
  return out;
}

void print(const Cell& cell) {
  std::printf("\n%s, %d branches, %s; reference converged to %.0e\n", cell.tree.c_str(),
              cell.branches, cell.load.c_str(), cell.converged);
  std::printf("%-26s %14s %10s", "", "ns/branch-step", "unstable");
  for (std::size_t k = 0; k < TARGETS.size(); ++k)
    std::printf(" | %5s %11s %9s", "", "step [ms]", "ms/s");
  std::printf("\n");
  for (const Row& row : cell.rows) {
    int unstable = 0;
    for (const Point& point : row.points)
      if (std::isinf(point.error)) unstable = std::max(unstable, point.steps);
    char edge[20] = "-";
    if (unstable > 0) std::snprintf(edge, sizeof edge, "%.2f ms", 1e3 * INTERVAL / unstable);
    std::printf("%-26s %14.1f %10s", row.engine.c_str(),
                row.step_seconds.back() / cell.branches * 1e9, edge);
    for (std::size_t k = 0; k < TARGETS.size(); ++k)
      std::printf(" | %.0e %s%10.3f %9.3g", TARGETS[k], markOf(row.answers[k].kind),
                  1e3 * INTERVAL / row.answers[k].steps, 1e3 * row.cost(k));
    std::printf("\n");
  }
  for (const Row& row : cell.rows) {
    if (!row.fast) continue;
    std::printf("%-26s", row.engine.c_str());
    for (std::size_t k = 0; k < TARGETS.size(); ++k) {
      const Ratio ratio = ratioOf(cell, row, k);
      if (ratio.value > 0.0)
        std::printf("  at %.0e %s%.1f times %s", TARGETS[k], ratio.bound ? ">" : "", ratio.value,
                    ratio.peer.c_str());
    }
    std::printf("\n");
  }
  std::fflush(stdout);
}

void printSummary(const std::vector<Cell>& cells) {
  std::vector<std::string> peers, own;
  const auto keep = [](std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  };
  for (const Cell& cell : cells)
    for (const Row& row : cell.rows) {
      if (row.peer) keep(peers, row.engine);
      if (row.fast) keep(own, row.engine);
    }
  peers.emplace_back();
  std::printf("\ntimes faster at equal error: least, geometric mean, cells (lower bounds)\n");
  for (const std::string& engine : own)
    for (const std::string& peer : peers) printRatios(cells, engine, peer);
  std::printf("\nparts of it: geometric means\n");
  printRatios(cells, "MuJoCo, our midpoint", "MuJoCo, Euler");
  printRatios(cells, "midpoint, plain double", "MuJoCo, our midpoint");
  printRatios(cells, "midpoint, SIMD, one tree", "midpoint, plain double");
}

void writeHead(std::FILE* file) {
  std::fprintf(file,
               "tree,branches,load,engine,kind,error,steps_per_second,ms_per_simulated_second,"
               "instants,note\n");
}

void write(const Cell& cell, std::FILE* file) {
  for (const Row& row : cell.rows) {
    const auto line = [&](double error, double steps, double each, int instants, const char* note) {
      std::fprintf(file, "%s,%d,%s,\"%s\",%s,%.6g,%.6g,%.6g,%d,%s\n", cell.tree.c_str(),
                   cell.branches, cell.load.c_str(), row.engine.c_str(),
                   row.peer   ? "peer"
                   : row.fast ? "fast"
                              : "own",
                   error, steps / INTERVAL, 1e3 * steps / INTERVAL * each, instants, note);
    };
    for (const Point& point : row.points) {
      std::size_t k = 0;  // the time of a step was measured at the answers
      while (k + 1 < TARGETS.size() && point.steps > row.answers[k].steps) ++k;
      line(point.error, point.steps, row.step_seconds[k], point.instants, "run");
    }
    for (std::size_t k = 0; k < TARGETS.size(); ++k) {
      const Answer& answer = row.answers[k];
      const char* const notes[] = {"found", "between", "at_least", "never"};
      line(TARGETS[k], answer.steps, row.step_seconds[k], INTERVALS,
           notes[static_cast<int>(answer.kind)]);
    }
  }
  std::fflush(file);
}

}  // namespace vegetation_sim::bench
