// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/report.h"

#include <cmath>
#include <map>

namespace vegetation_sim::bench {
namespace {

const char* markOf(Answer::Kind kind) {
  const char* const marks[] = {" ", "~", ">", "never"};
  return marks[static_cast<int>(kind)];
}

}  // namespace

Ratio ratioOf(const Cell& cell, const Row& own, std::size_t target) {
  Ratio out;
  double best = 0.0;
  for (const Row& row : cell.rows) {
    if (!row.peer || row.answers[target].kind == Answer::Kind::NEVER ||
        (best > 0.0 && row.cost(target) >= best))
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
  struct Sum {
    double logs{0.0}, least{0.0};
    int count{0};
  };
  std::map<std::string, Sum> sums;
  for (const Cell& cell : cells)
    for (const Row& row : cell.rows)
      for (std::size_t k = 0; row.fast && k < TARGETS.size(); ++k) {
        const double ratio = ratioOf(cell, row, k).value;
        if (ratio <= 0.0) continue;
        Sum& sum = sums[row.engine];
        sum.least = sum.count == 0 ? ratio : std::min(sum.least, ratio);
        sum.logs += std::log(ratio);
        ++sum.count;
      }
  std::printf("\nover the best peer at equal accuracy\n");
  for (const auto& [engine, sum] : sums)
    std::printf("%-26s least %6.1f times, geometric mean %6.1f times, %d cells\n", engine.c_str(),
                sum.least, std::exp(sum.logs / sum.count), sum.count);
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
      const bool coarse = point.steps <= row.answers[0].steps;
      line(point.error, point.steps, row.step_seconds[coarse ? 0 : 1], point.instants, "run");
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
