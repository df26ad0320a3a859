// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The snapshot of trodden grass as bytes.
#include "core/archive/archive.h"
#include "grass/tread_simulation.h"

namespace vegetation_sim::grass {
namespace {

constexpr std::size_t LONGEST_NAME = 4096;
constexpr std::size_t NODE_BYTES = 24;
constexpr std::size_t BLOCK_BYTES = 16 + NODE_BYTES * TreadBlock::SIDE * TreadBlock::SIDE;
constexpr std::size_t CUT_BLOCK_BYTES = 8 + 12 * CutBlock::SIDE * CutBlock::SIDE;
constexpr std::size_t SOURCE_BYTES = 190, WINDOW_BYTES = 60;
constexpr std::size_t MOST_BLOCKS = 1u << 24, MOST_DOSES = 1u << 24;
constexpr int FARTHEST_NODE = 1 << 28;
constexpr int PITCH = 8;  // columns of a window, as TreadBand::PITCH

/// The blocks of the map, which bound those of a state.
struct BlockRange {
  int rows, columns;
};

void archive(Archive& a, TreadInput& input) {
  a.text("source", input.source, LONGEST_NAME);
  a.integer("source action", input.action, TreadAction::MOVE, TreadAction::STROKE);
  a.vector("source start", input.start);
  a.vector("source position", input.position);
  a.number("source height_gate", input.height_gate);
  bool has_velocity = input.velocity.has_value();
  a.flag("source has velocity", has_velocity);
  if (has_velocity && !input.velocity) input.velocity = Vec3(Vec3::Zero());
  if (has_velocity) a.vector("source velocity", *input.velocity);
  a.fields("source law", input.law);
  a.text("source body_frame", input.body_frame, LONGEST_NAME);
}

void archive(Archive& a, TreadSourceState& source) {
  a.integer("source id", source.id);
  archive(a, source.last);
  a.stamp("source updated", source.updated);
  a.stamp("source pressed", source.pressed);
  a.flag("source down", source.down);
  a.vector("source speed", source.velocity);
  a.vector("source before", source.before);
  a.stamp("source before_stamp", source.before_stamp);
  a.integer("source column", source.column, -1, FARTHEST_NODE);
  a.integer("source row", source.row, -1, FARTHEST_NODE);
}

void archive(Archive& a, TreadBlock& block) {
  a.stamp("block until", block.until);
  for (TreadNode& node : block.nodes) {
    a.number("node tilt", node.tilt, {0.0, 3.2});
    a.number("node x", node.x, {-1.01, 1.01});
    a.number("node y", node.y, {-1.01, 1.01});
    a.number("node recovery", node.recovery, {0.0, 1.01 * PERMANENT_RECOVERY});
    a.stamp("node stamp", node.stamp);
  }
}

void archive(Archive& a, const char* name, Point& point) {
  a.number(name, point.x);
  a.number(name, point.y);
}

void archive(Archive& a, TreadSource& source) {
  archive(a, "track position", source.position);
  archive(a, "track direction", source.along);
  a.flag("track has_moved", source.has_moved);
  a.stamp("track stamp", source.stamp);
  a.integer("window column", source.first_column, -FARTHEST_NODE, FARTHEST_NODE);
  a.integer("window row", source.first_row, -FARTHEST_NODE, FARTHEST_NODE);
  a.integer("window columns", source.columns, 0, FARTHEST_NODE);
  a.integer("window rows", source.rows, 0, FARTHEST_NODE);
  a.numbers("doses", source.doses, MOST_DOSES);
  const auto area = static_cast<std::int64_t>(source.columns) * source.rows;
  if (area != static_cast<std::int64_t>(source.doses.size()) || source.columns % PITCH != 0)
    Archive::reject("doses = " + std::to_string(source.doses.size()),
                    "do not fill a window of " + std::to_string(source.columns) + " x " +
                        std::to_string(source.rows));
}

void archive(Archive& a, const BlockRange& range, TreadState& state) {
  a.map(
      "blocks", state.blocks, MOST_BLOCKS, BLOCK_BYTES,
      [&](std::pair<int, int>& place) {
        a.integer("block row", place.first, 0, range.rows - 1);
        a.integer("block column", place.second, 0, range.columns - 1);
      },
      [&a](const auto&, TreadBlock& block) { archive(a, block); });
  a.map(
      "tracks", state.sources, TreadSimulation::MOST_SOURCES, WINDOW_BYTES,
      [&a](std::uint32_t& id) { a.integer("track", id); },
      [&a](std::uint32_t, TreadSource& source) { archive(a, source); });
  TreadCounts& counts = state.counts;
  for (std::uint64_t* count :
       {&counts.strokes, &counts.invalid, &counts.jumps, &counts.outside, &counts.no_memory})
    a.integer("count", *count);
}

void archive(Archive& a, CutBlock& block) {
  for (CutNode& node : block.nodes) {
    a.number("cut height", node.height, {0.0, double{UNCUT}});
    a.number("swath", node.swath, {0.0, 1e9});
  }
}

void archive(Archive& a, const BlockRange& range, CutState& cuts) {
  a.map(
      "cut blocks", cuts.blocks, MOST_BLOCKS, CUT_BLOCK_BYTES,
      [&](std::pair<int, int>& place) {
        a.integer("cut block row", place.first, 0, range.rows - 1);
        a.integer("cut block column", place.second, 0, range.columns - 1);
      },
      [&a](const auto&, CutBlock& block) { archive(a, block); });
  a.integer("count", cuts.no_memory);
}

void archive(Archive& a, const BlockRange& range, TreadSnapshot& snapshot) {
  a.stamp("stamp", snapshot.stamp);
  a.integer<std::uint32_t>("next id", snapshot.next_id, 1);
  a.map(
      "sources", snapshot.sources, TreadSimulation::MOST_SOURCES, SOURCE_BYTES,
      [&a](std::string& name) { a.text("source", name, LONGEST_NAME); },
      [&a](const std::string&, TreadSourceState& source) { archive(a, source); });
  archive(a, range, snapshot.tread);
  archive(a, range, snapshot.cuts);
  if (!a.reads()) return;
  for (const auto& [name, source] : snapshot.sources)
    if (source.id >= snapshot.next_id)
      Archive::reject("source id = " + std::to_string(source.id),
                      "is not below the next id, " + std::to_string(snapshot.next_id));
}

BlockRange rangeOf(const MapLaw& law, double spacing) {
  const auto blocks = [&](int nodes) {
    const double fine = (nodes - 1) * law.resolution / spacing + 1.0;
    return static_cast<int>(fine + 0.5) / TreadBlock::SIDE + 1;
  };
  return {blocks(law.rows), blocks(law.columns)};
}

}  // namespace

std::string TreadSimulation::archived() const {
  Archive a;
  TreadSnapshot copy = snapshot();
  archive(a, rangeOf(layout_.map->law(), tread_.spacing()), copy);
  return a.takeBytes();
}

TreadSnapshot TreadSimulation::readArchived(std::string bytes, Nanoseconds shift) const {
  Archive a = Archive::reading(std::move(bytes), shift);
  TreadSnapshot out;
  archive(a, rangeOf(layout_.map->law(), tread_.spacing()), out);
  a.finish();
  return out;
}

}  // namespace vegetation_sim::grass
