// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "grass/map/tile_owners.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::grass {
namespace {

double flatDistance(const Vec3& a, const Vec3& b) {
  const double x = b.x() - a.x(), y = b.y() - a.y();
  return std::sqrt(x * x + y * y);
}

int blockOf(double coordinate, double origin, double spacing) {
  const double node = (coordinate - origin) / spacing;
  return static_cast<int>(
      std::floor(std::min(1e8, std::max(-1e8, node)) / double{TreadBlock::SIDE}));
}

}  // namespace

TreadSimulation::TreadSimulation(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain,
                                 const TreadSettings& treading, TreadMap& tread)
    : layout_(std::move(layout)),
      layout_hash_(layout_.hash()),
      terrain_(std::move(terrain)),
      treading_(treading),
      tread_(tread) {}

void TreadSimulation::setTreadLaw(const TreadLaw& law) {
  layout_.tread = law;
  layout_hash_ = layout_.hash();
}

TreadSourceState& TreadSimulation::sourceOf(const TreadInput& input) {
  const auto found = sources_.find(input.source);
  if (found != sources_.end()) return found->second;
  if (sources_.size() >= MOST_SOURCES)
    throw InvalidInput("source " + inQuotes(input.source) + " is one more than the " +
                       std::to_string(MOST_SOURCES) + " allowed at once");
  TreadSourceState& source = sources_[input.source];
  source.id = next_id_++;
  return source;
}

// Marks the blocks that a segment may have changed.
void TreadSimulation::touch(const Vec3& from, const Vec3& to, double reach) {
  const MapLaw& law = layout_.map->law();
  const double spacing = tread_.spacing();
  const auto column = [&](double x) { return blockOf(x, law.origin_x, spacing); };
  const auto row = [&](double y) { return blockOf(y, law.origin_y, spacing); };
  const double side = TreadBlock::SIDE * spacing;
  const int last_row = std::min(row(std::max(from.y(), to.y()) + reach),
                                static_cast<int>((law.rows - 1) * law.resolution / side) + 1);
  const int last_column = std::min(column(std::max(from.x(), to.x()) + reach),
                                   static_cast<int>((law.columns - 1) * law.resolution / side) + 1);
  for (int r = std::max(0, row(std::min(from.y(), to.y()) - reach)); r <= last_row; ++r)
    for (int c = std::max(0, column(std::min(from.x(), to.x()) - reach)); c <= last_column; ++c)
      if (tread_.owners().ownsBlock(r, c, tread_.cells())) touched_.insert({r, c});
}

void TreadSimulation::press(TreadSourceState& source, const Vec3& to, Nanoseconds stamp) {
  Vec3 from = source.down ? source.last.position : to;
  if (flatDistance(from, to) > treading_.longest_stroke) from = to;  // a jump
  touch(from, to, source.last.law.reach);
  tread_.tread(source.id, source.last.law, {to.x(), to.y()}, stamp);
  enter(source, from, to);
  source.last.position = to;
  source.down = true;
  source.pressed = stamp;
}

// Records every tile on the way.
void TreadSimulation::enter(TreadSourceState& source, const Vec3& from, const Vec3& to) {
  const MapLaw& law = layout_.map->law();
  const int steps =
      1 + static_cast<int>(std::min(1e4, flatDistance(from, to) / law.resolution * 4.0));
  for (int i = 1; i <= steps; ++i) {
    const Vec3 p = from + (static_cast<double>(i) / steps) * (to - from);
    const double u = std::floor((p.x() - law.origin_x) / law.resolution);
    const double v = std::floor((p.y() - law.origin_y) / law.resolution);
    const bool on = u >= 0.0 && v >= 0.0 && u < law.columns - 1.0 && v < law.rows - 1.0;
    const int column = on ? static_cast<int>(u) : -1, row = on ? static_cast<int>(v) : -1;
    const Shard& shard = tread_.owners().shard();
    if (on && (column != source.column || row != source.row) &&
        (shard.count == 1 || tread_.owners().ownerOf(column, row) == shard.index))
      entered_.push_back({source.last.source, column, row});
    source.column = column;
    source.row = row;
  }
}

void TreadSimulation::lift(TreadSourceState& source) {
  tread_.lift(source.id);
  source.down = false;
  source.velocity = Vec3::Zero();
  source.column = source.row = -1;
}

// Moves a source that is on the ground.
std::string TreadSimulation::move(TreadSourceState& source, const TreadInput& input,
                                  Nanoseconds stamp) {
  std::string problem;
  const std::uint64_t jumps = tread_.state().counts.jumps;
  const double way = flatDistance(source.last.position, input.position);
  const double seconds = secondsBetween(source.pressed, stamp);
  if (stamp > source.updated) {
    source.before = source.last.position;
    source.before_stamp = source.updated;
  }
  const double passed = secondsBetween(source.before_stamp, stamp);
  const Vec3 mean =
      passed > 0.0 ? Vec3((input.position - source.before) / passed) : Vec3(Vec3::Zero());
  source.velocity = input.velocity.value_or(mean);
  const Vec3 from = source.last.position;
  source.last = input;
  source.last.position = from;
  press(source, input.position, stamp);
  if (tread_.state().counts.jumps == jumps) return problem;
  source.velocity = input.velocity.value_or(Vec3::Zero());
  return "source " + inQuotes(input.source) + " jumped by " + std::to_string(way) + " m in " +
         std::to_string(seconds) + " s and left no track, allowed are longest_stroke = " +
         std::to_string(treading_.longest_stroke) +
         " m and top_speed = " + std::to_string(treading_.top_speed) + " m/s";
}

std::string TreadSimulation::apply(const TreadInput& input, Nanoseconds stamp) {
  const TreadAction action = input.action;
  if (action == TreadAction::LIFT && !sources_.count(input.source)) return "";
  if (action == TreadAction::STROKE) checkStroke(input);
  TreadSourceState& source = sourceOf(input);
  const Vec3& p = input.position;
  const bool high =
      action != TreadAction::LIFT && p.z() - terrain_->height(p.x(), p.y()) > input.height_gate;
  std::string problem;
  if (action != TreadAction::MOVE || high) lift(source);
  if (action == TreadAction::STROKE) {
    source.last = input;
    const StrokeSteps steps = stepsOf(input);
    const Vec3 from = input.start, way = p - from;
    for (double i = steps.first; i <= steps.last; ++i)
      press(source, from + (i / steps.count) * way, stamp);
    lift(source);
  } else if (action != TreadAction::LIFT && !high) {
    if (source.down) {
      problem = move(source, input, stamp);
    } else {
      source.last = input;
      source.velocity = input.velocity.value_or(Vec3::Zero());
      press(source, p, stamp);
      source.before = p;
      source.before_stamp = stamp;
    }
  } else {
    source.last = input;
  }
  source.updated = stamp;
  if (!source.down && action != TreadAction::MOVE) sources_.erase(input.source);
  return problem;
}

void TreadSimulation::raise(const Point& centre, double radius) {
  Faults faults;
  FieldChecker checker("clear: ", faults);
  Vec3 place(centre.x, centre.y, 0.0);
  checker.vector("centre", place, "m", {-1e7, 1e7});
  checker.number("radius", radius, "m", {0.0, 1e4});
  faults.throwIfAny();
  tread_.raise(centre, radius);
}

void TreadSimulation::raiseAll() {
  TreadState state;
  state.counts = tread_.state().counts;
  tread_.restore(std::move(state));
  for (auto& [name, source] : sources_) source.down = false;
}

std::vector<Entering> TreadSimulation::advance(Nanoseconds stamp) {
  for (auto entry = sources_.begin(); entry != sources_.end();) {
    TreadSourceState& source = entry->second;
    if (secondsBetween(source.updated, stamp) > LEASE) {
      lift(source);
      entry = sources_.erase(entry);
      continue;
    }
    if (source.down && secondsBetween(source.pressed, stamp) >= RENEWAL)
      press(source, source.last.position, stamp);
    ++entry;
  }
  if (stamp / NANOSECONDS_PER_SECOND != stamp_ / NANOSECONDS_PER_SECOND) tread_.prune(stamp);
  stamp_ = stamp;
  return std::exchange(entered_, {});
}

void TreadSimulation::reset() {
  tread_.clear();
  sources_.clear();
  entered_.clear();
  touched_.clear();
  stamp_ = published_ = 0;
  next_id_ = 1;
  sequence_ = 0;
}

TreadUpdate TreadSimulation::keyFrameOf(const BlockFilter& includes) const {
  TreadUpdate out;
  out.stamp = stamp_;
  out.key_frame = true;
  out.layout_hash = layout_hash_;
  std::set<std::pair<int, int>> blocks;
  for (const auto& [place, block] : tread_.state().blocks)
    if (includes(place.first, place.second)) blocks.insert(place);
  out.treads = makeDelta(tread_.state(), blocks, {std::numeric_limits<Nanoseconds>::min(), stamp_});
  for (CutBlockDelta& cut : snapshotCuts(tread_.cuts().state()))
    if (includes(cut.row, cut.column) &&
        tread_.owners().ownsBlock(cut.row, cut.column, tread_.cells()))
      out.treads.cuts.push_back(std::move(cut));
  out.shard = tread_.owners().shard().index;
  out.shards = tread_.owners().shard().count;
  out.hash = hashOf(out.treads);
  return out;
}

TreadUpdate TreadSimulation::update(bool key_frame) {
  TreadUpdate out;
  out.stamp = stamp_;
  out.sequence = sequence_++;
  out.key_frame = key_frame;
  out.layout_hash = layout_hash_;
  out.treads = key_frame ? snapshotTreads(tread_.state(), stamp_)
                         : makeDelta(tread_.state(), touched_, {published_, stamp_});
  const CutMap::Nodes changed = tread_.cuts().takeChanged();
  out.treads.cuts = key_frame ? snapshotCuts(tread_.cuts().state())
                              : makeCutDelta(tread_.cuts().state(), changed);
  // All shards know all cuts, since the mass that a cut lays down depends on those before.
  const auto is_foreign = [this](const CutBlockDelta& block) {
    return !tread_.owners().ownsBlock(block.row, block.column, tread_.cells());
  };
  auto& cuts = out.treads.cuts;
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(), is_foreign), cuts.end());
  out.shard = tread_.owners().shard().index;
  out.shards = tread_.owners().shard().count;
  if (key_frame) out.hash = hashOf(out.treads);
  touched_.clear();
  published_ = stamp_;
  return out;
}

TreadSnapshot TreadSimulation::snapshot() const {
  return {stamp_, next_id_, sources_, tread_.state(), tread_.cuts().state()};
}

void TreadSimulation::restore(TreadSnapshot memory) {
  reset();
  stamp_ = published_ = memory.stamp;
  next_id_ = memory.next_id;
  sources_ = std::move(memory.sources);
  tread_.restore(std::move(memory.tread));
  tread_.cuts().restore(std::move(memory.cuts));
}

std::uint64_t TreadSnapshot::hash() const {
  Hash hash;
  const auto add = [&](auto value) { hash.add(static_cast<std::uint64_t>(value)); };
  add(stamp);
  add(next_id);
  for (const auto& [name, s] : sources) {
    hash.add(name);
    for (const auto value : {s.updated, s.pressed, s.before_stamp}) add(value);
    add(s.id);
    for (const int value :
         {static_cast<int>(s.last.action), s.column, s.row, static_cast<int>(s.down)})
      add(value);
    const Vec3 given = s.last.velocity.value_or(Vec3::Zero());
    for (const Vec3& v : {s.last.start, s.last.position, given, s.velocity, s.before}) hash.add(v);
    hash.add(s.last.height_gate);
    hash.add(s.last.body_frame);
    FieldHasher hasher(hash);
    TreadLaw law = s.last.law;
    describe(hasher, law);
  }
  add(tread.hash());
  if (!cuts.empty()) cuts.addTo(hash);
  return hash.value();
}

}  // namespace vegetation_sim::grass
