// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/cut_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grass/tread/area_rows.h"
#include "grass/tread/tile_nodes.h"
#include "grass/tread/tread_tilt.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = CutBlock::SIDE;
constexpr std::size_t CUT_BYTES = sizeof(CutBlock) + 64;
constexpr Range CUT_PLACES{-1e7, 1e7};

// Returns the mean of min(l, longest) for lengths l that are evenly distributed over [least, most].
double meanLength(double least, double most, double longest) {
  if (longest >= most) return 0.5 * (least + most);
  if (longest <= least) return longest;
  return (0.5 * (longest * longest - least * least) + longest * (most - longest)) / (most - least);
}

std::size_t indexOf(int row, int column) {
  return static_cast<std::size_t>(row % SIDE * SIDE + column % SIDE);
}

void checkOutline(const std::vector<Point>& outline, const std::string& name, Faults& faults) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    FieldChecker checker(name + "[" + std::to_string(i) + "].", faults);
    Point p = outline[i];
    checker.number("x", p.x, "m", CUT_PLACES);
    checker.number("y", p.y, "m", CUT_PLACES);
  }
}

}  // namespace

void check(const CutArea& area, const std::string& context, Faults& faults) {
  FieldChecker checker(context, faults);
  CutArea copy = area;
  checker.number("radius", copy.radius, "m", {0.0, 1000.0});
  checker.number("height", copy.height, "m", {0.0, 5.0});
  if (!faults.empty()) return;
  const std::size_t least = area.radius > 0.0 ? 1 : 3;
  const auto checkCount = [&](const char* name, std::size_t count, std::size_t fewest) {
    if (count < fewest || count > CutArea::MOST_POINTS)
      faults.add(context + name + " has " + std::to_string(count) + " points, allowed are " +
                 std::to_string(fewest) + " to " + std::to_string(CutArea::MOST_POINTS) +
                 (fewest == 3 && count < 3 ? ", or 1 with a radius" : ""));
  };
  checkCount("outline", area.outline.size(), least);
  if (!area.swath.empty()) checkCount("swath", area.swath.size(), 3);
  if (!faults.empty()) return;
  checkOutline(area.outline, context + "outline", faults);
  checkOutline(area.swath, context + "swath", faults);
}

double massBelow(const FeatureMap& map, const Features& features, double longest) {
  double sum = 0.0, shares = 0.0;
  for (std::size_t k = 0; k < map.species().size(); ++k) {
    const Species& kind = map.species()[k].species;
    const double most = features.height * kind.height;
    sum +=
        features.mix[k] * kind.width * meanLength(most * (1.0 - kind.height_spread), most, longest);
    shares += features.mix[k];
  }
  return shares > 0.0 ? LEAF_MASS * features.density * sum / shares : 0.0;
}

CutMap::CutMap(const MapLaw& law, int cells, double memory_cap)
    : law_(law),
      cells_(cells),
      last_column_((law.columns - 1) * cells),
      last_row_((law.rows - 1) * cells),
      spacing_(law.resolution / cells),
      memory_cap_(memory_cap) {}

std::size_t CutMap::bytes() const {
  return state_.blocks.size() * CUT_BYTES;
}

void CutMap::restore(CutState state) {
  state_ = std::move(state);
  changed_.clear();
}

// Returns null if there is no memory.
CutNode* CutMap::nodeAt(const std::pair<int, int>& place) {
  const std::pair<int, int> key{place.first / SIDE, place.second / SIDE};
  auto found = state_.blocks.find(key);
  if (found == state_.blocks.end()) {
    if (static_cast<double>(bytes() + CUT_BYTES) > memory_cap_) return nullptr;
    found = state_.blocks.emplace(key, CutBlock()).first;
  }
  return &found->second.nodes[indexOf(place.first, place.second)];
}

// Returns a node that the caller changes, or null.
CutNode* CutMap::changeAt(const std::pair<int, int>& place) {
  CutNode* const node = nodeAt(place);
  if (node)
    changed_[{place.first / SIDE, place.second / SIDE}].set(indexOf(place.first, place.second));
  else
    ++state_.no_memory;
  return node;
}

CutNode CutMap::nodeOf(int row, int column) const {
  const auto found = state_.blocks.find({row / SIDE, column / SIDE});
  return found == state_.blocks.end() ? CutNode() : found->second.nodes[indexOf(row, column)];
}

double CutMap::workOf(const std::vector<Point>& outline, double radius) const {
  if (outline.empty()) return 0.0;
  const AreaBounds bounds = boundsOf(outline, radius);
  const auto span = [&](double low, double high, double origin, int last) {
    const double first = std::max(0.0, (low - origin) / spacing_);
    return std::max(0.0, std::min(static_cast<double>(last), (high - origin) / spacing_) - first) +
           1.0;
  };
  const double rows = span(bounds.low.y, bounds.high.y, law_.origin_y, last_row_);
  const double columns = span(bounds.low.x, bounds.high.x, law_.origin_x, last_column_);
  return rows * (columns + static_cast<double>(outline.size()));
}

double CutMap::workOf(const CutArea& area) const {
  return std::floor(workOf(area.outline, area.radius) + workOf(area.swath, 0.0));
}

void CutMap::checkWork(const CutArea& area) const {
  const double work = std::max(workOf(area.outline, area.radius), workOf(area.swath, 0.0));
  if (work > MOST_WORK)
    throw InvalidInput("cut: " + std::to_string(static_cast<std::int64_t>(work)) +
                       " nodes and corners of rows to visit, allowed are " +
                       std::to_string(static_cast<std::int64_t>(MOST_WORK)));
}

// Lists the nodes in an area, row by row. A node at the lower end of a range belongs to it, one at
// the upper end does not, so that neighbouring areas share none.
CutMap::Places CutMap::placesIn(const std::vector<Point>& outline, double radius) const {
  Places out;
  const AreaBounds bounds = boundsOf(outline, radius);
  const auto above = [&](double x, double origin) {
    return -floorOf(-((x - origin) / spacing_));  // rounds up
  };
  const int first = std::max(0, above(bounds.low.y, law_.origin_y));
  const int last = std::min(last_row_, floorOf((bounds.high.y - law_.origin_y) / spacing_));
  for (int row = first; row <= last; ++row)
    for (const auto& range : rangesAt(law_.origin_y + row * spacing_, outline, radius)) {
      const int end = std::min(last_column_ + 1, above(range.second, law_.origin_x));
      for (int column = std::max(0, above(range.first, law_.origin_x)); column < end; ++column)
        out.push_back({row, column});
    }
  return out;
}

// Lays a mass per area, summed over nodes, evenly on nodes. @return false if none has memory.
bool CutMap::lay(const Places& places, double mass) {
  std::vector<CutNode*> nodes;
  for (const auto& place : places)
    if (CutNode* const node = changeAt(place)) nodes.push_back(node);
  for (CutNode* const node : nodes) node->swath += mass / static_cast<double>(nodes.size());
  return !nodes.empty();
}

double CutMap::cut(const FeatureMap& map, const CutArea& area) {
  checkWork(area);
  const auto height = static_cast<float>(area.height);
  double removed = 0.0;  // [kg/m^2], summed over nodes
  Places places;         // where something is removed
  for (const auto& place : placesIn(area.outline, area.radius)) {
    const float before = nodeOf(place.first, place.second).height;
    if (before <= height) continue;
    const Features here =
        map.at(law_.origin_x + place.second * spacing_, law_.origin_y + place.first * spacing_);
    const double mass = massBelow(map, here, double{before}) - massBelow(map, here, double{height});
    CutNode* const node = mass > 0.0 ? changeAt(place) : nullptr;
    if (!node) continue;
    node->height = height;
    removed += mass;
    places.push_back(place);
  }
  if (places.empty()) return 0.0;
  if (area.swath.empty() || !lay(placesIn(area.swath, 0.0), removed)) lay(places, removed);
  return removed * spacing_ * spacing_;
}

CutNode CutMap::at(const Point& place) const {
  if (state_.blocks.empty()) return {};
  const double u = std::floor((place.x - law_.origin_x) / spacing_ + 0.5);
  const double v = std::floor((place.y - law_.origin_y) / spacing_ + 0.5);
  if (!(u >= 0.0 && v >= 0.0 && u <= last_column_ && v <= last_row_)) return {};
  return nodeOf(static_cast<int>(v), static_cast<int>(u));
}

void CutMap::patch(int tile_column, int tile_row, CrushPatch& out) const {
  out.cut.clear();
  out.swath.clear();
  const auto side = static_cast<std::size_t>(cells_ + 1);
  visitTileNodes(
      state_.blocks, tile_column, tile_row, cells_,
      [&](const CutBlock&) {
        if (!out.cut.empty()) return true;
        out.cut.assign(side * side, UNCUT);
        out.swath.assign(side * side, 0.f);
        return true;
      },
      [&](const CutNode& node, std::size_t to) {
        out.cut[to] = node.height;
        out.swath[to] = static_cast<float>(node.swath);
      });
  if (out.cut.empty() || out.cells > 0) return;
  out.cells = cells_;
  for (std::vector<float>* layer : {&out.tilt, &out.tx, &out.ty}) layer->assign(side * side, 0.f);
}

bool CutMap::put(int row, int column, const CutNode& node) {
  if (row < 0 || column < 0 || row > last_row_ || column > last_column_) return false;
  CutNode* const own = nodeAt({row, column});
  if (own) *own = node;
  return own != nullptr;
}

void CutState::addTo(Hash& hash) const {
  for (const auto& [place, block] : blocks) {
    hash.add(static_cast<std::uint64_t>(place.first));
    hash.add(static_cast<std::uint64_t>(place.second));
    for (const CutNode& node : block.nodes) {
      hash.add(double{node.height});
      hash.add(node.swath);
    }
  }
  hash.add(no_memory);
}

}  // namespace vegetation_sim::grass
