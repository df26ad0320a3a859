// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/status_board.h"

#include "rviz/grass/grass_visual.h"

namespace vegetation_sim::view {

void StatusBoard::show(rviz::StatusProperty::Level level, const std::string& name,
                       const std::string& text) {
  std::string& shown = shown_[name];
  const std::string wanted = std::to_string(level) + text;
  if (shown == wanted) return;
  shown = wanted;
  display_.setStatusStd(level, name, text);
}

void StatusBoard::show(const std::string& name, const InputStatus& status) {
  show(status.good ? rviz::StatusProperty::Ok : rviz::StatusProperty::Warn, name, status.text);
}

std::string describe(const ForestReport& report) {
  std::string out = std::to_string(report.trees) + " of " + std::to_string(report.wanted) +
                    " trees, " + std::to_string(report.moving) + " moving; " +
                    std::to_string(report.triangles) +
                    " triangles in the picture; trees per level 0 to " +
                    std::to_string(forest::GEOMETRY_LEVELS - 1) + ":";
  for (const std::size_t count : report.per_level) out += " " + std::to_string(count);
  return out;
}

std::string describeMotion(const forest::ForestReplica& replica, const TreeSet& tree_set) {
  std::array<std::size_t, forest::MODAL_LEVEL + 1> trees{};
  std::size_t physical = 0;
  for (const auto& tree : tree_set.trees()) {
    ++trees[static_cast<std::size_t>(replica.levels().of(tree->id()).level)];
    physical += replica.promoted(tree->id()).branches.empty() ? 0 : 1;
  }
  std::string out = std::to_string(trees.front()) + " trees at rest, moving to depth 1 to " +
                    std::to_string(forest::MAX_DEPTHS) + ":";
  for (std::size_t depth = 1; depth < forest::MODAL_LEVEL; ++depth)
    out += " " + std::to_string(trees[depth]);
  return out + "; in modes: " + std::to_string(trees[forest::MODAL_LEVEL]) +
         "; with physical branches: " + std::to_string(physical);
}

std::string describe(const GrassReport& report) {
  return std::to_string(report.blades) + " blades on " + std::to_string(report.bladed) + " of " +
         std::to_string(report.tiles) + " tiles, strips on " + std::to_string(report.stripped) +
         "; " + std::to_string(report.triangles) + " triangles; " + std::to_string(report.trodden) +
         " blocks of trodden ground";
}

}  // namespace vegetation_sim::view
