// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "trees/work_precision.h"

namespace vegetation_sim::bench {

constexpr std::array<double, 3> TARGETS{1e-1, 1e-2, 1e-3};  ///< relative error of tips

/// Results of one engine for one tree and load.
struct Row {
  std::string engine;
  bool peer{false}, fast{false};
  std::array<Answer, TARGETS.size()> answers;
  /// Time of a step of one tree at each answer, mean of the loaded third and the free rest [s].
  std::array<double, TARGETS.size()> step_seconds{};
  std::vector<Point> points;

  /// Returns the processor time of a simulated second at TARGETS[k] [s].
  double cost(std::size_t k) const { return answers[k].steps / INTERVAL * step_seconds[k]; }
};

/// One tree and load with all engines, and the convergence of their references.
struct Cell {
  std::string tree, load;
  int branches{0};
  double converged{0.0};
  std::vector<Row> rows;
};

/// A peer's cost over ours. `bound`: the peer's cost is a lower bound, so the ratio is one too.
struct Ratio {
  double value{0.0};
  bool bound{false};
  std::string peer;
};
/// Returns the ratio of the best peer, or of the one named; zero if there is none.
Ratio ratioOf(const Cell& cell, const Row& own, std::size_t target, const std::string& peer = "");

/// Prints a table of the cell.
void print(const Cell& cell);
/// Prints the smallest and the geometric mean of the ratios of each of our engines to each peer and
/// to the best, and the parts that integrator, dynamics and vectors have in them.
void printSummary(const std::vector<Cell>& cells);
/// Write one line per point and one per target.
void writeHead(std::FILE* file);
void write(const Cell& cell, std::FILE* file);

}  // namespace vegetation_sim::bench
