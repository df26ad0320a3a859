// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/forest_layout.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr double FARTHEST_TREE = 1e7;  // [m]

enum SeedDraw : std::uint64_t { SPECIES, X, Y, YAW, SCALE, GROWTH };

void checkNumber(const std::string& name, double value, const char* unit, Range range,
                 Faults& faults) {
  const std::string fault = rangeFault(name, value, unit, range);
  if (!fault.empty()) faults.add(fault);
}

void checkSeed(const TreeSeed& seed, const std::string& name, std::size_t species, Faults& faults) {
  if (seed.species >= species)
    faults.add(name + ": species = " + std::to_string(seed.species) + " is outside 0 to " +
               std::to_string(static_cast<long>(species) - 1));
  for (int i = 0; i < 3; ++i)
    checkNumber(name + ": position." + "xyz"[i], seed.position[i], "m",
                {-FARTHEST_TREE, FARTHEST_TREE}, faults);
  checkNumber(name + ": yaw", seed.yaw, "rad", {-1000.0, 1000.0}, faults);
  checkNumber(name + ": scale", seed.scale, "", {0.05, 20.0}, faults);
}

std::uint32_t cellsASide(const Tile& tile) {
  return static_cast<std::uint32_t>(std::ceil(std::sqrt(std::max(1u, tile.count))));
}

void checkTile(const Tile& tile, const std::string& name, std::size_t species, Faults& faults) {
  checkNumber(name + ": x", tile.x, "m", {-FARTHEST_TREE, FARTHEST_TREE}, faults);
  checkNumber(name + ": y", tile.y, "m", {-FARTHEST_TREE, FARTHEST_TREE}, faults);
  checkNumber(name + ": size", tile.size, "m", {0.1, 1e5}, faults);
  if (tile.mix.size() != species)
    faults.add(name + ": mix has " + std::to_string(tile.mix.size()) + " weights for " +
               std::to_string(species) + " species");
  double sum = 0.0;
  for (const float weight : tile.mix) {
    checkNumber(name + ": mix", weight, "", {0.0, 1e6}, faults);
    sum += weight;
  }
  if (!(sum > 0.0)) faults.add(name + ": mix has no positive weight");
}

std::uint16_t pickSpecies(const std::vector<float>& mix, double u) {
  double sum = 0.0;
  for (const float weight : mix) sum += weight;
  double left = u * sum;
  for (std::size_t i = 0; i + 1 < mix.size(); ++i) {
    left -= mix[i];
    if (left < 0.0) return static_cast<std::uint16_t>(i);
  }
  return static_cast<std::uint16_t>(mix.size() - 1);
}

}  // namespace

void describe(FieldVisitor& v, MotionLaw& law) {
  v.choice("joint_model", law.joint_model, {"swing", "paper"});
  v.choice("gain", law.gain, {"compliance", "paper"});
  v.choice("drag", law.drag, {"linear", "quadratic"});
  v.number("transition", law.transition, "s", {0.01, 60.0});
  v.choice("transition_shape", law.transition_shape, {"smooth", "linear"});
}

std::uint32_t Layout::treeCount() const {
  return tiles.empty() ? static_cast<std::uint32_t>(trees.size())
                       : tiles.back().first_tree + tiles.back().count;
}

std::uint64_t Layout::hash() const {
  Hash out;
  for (const Species& s : species) out.add(forest::hash(s));
  FieldHasher hasher(out);
  MotionLaw law = motion;
  describe(hasher, law);
  out.add(terrain_hash);  // the content, not the path of the file
  for (const TreeSeed& seed : trees) {
    out.add(seed.seed);
    out.add(static_cast<std::uint64_t>(seed.species));
    out.add(seed.position);
    out.add(seed.yaw);
    out.add(seed.scale);
  }
  for (const Tile& tile : tiles) {
    out.add(static_cast<std::uint64_t>(tile.first_tree));
    out.add(static_cast<std::uint64_t>(tile.count));
    out.add(tile.seed);
    out.add(tile.x);
    out.add(tile.y);
    out.add(tile.size);
    for (const float weight : tile.mix) out.add(static_cast<double>(weight));
  }
  return out.value();
}

void check(const Layout& layout, Faults& faults) {
  if (layout.species.empty()) faults.add("layout: species is empty");
  std::set<std::string> names;
  for (const Species& species : layout.species) {
    check(species, faults);
    if (!names.insert(species.name).second)
      faults.add("layout: species " + species.name + " is given twice");
  }
  MotionLaw law = layout.motion;
  FieldChecker checker("layout: ", faults);
  describe(checker, law);
  for (std::size_t i = 0; i < layout.trees.size(); ++i)
    checkSeed(layout.trees[i], "layout: trees[" + std::to_string(i) + "]", layout.species.size(),
              faults);
  std::uint64_t next = layout.trees.size();
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    const std::string name = "layout: tiles[" + std::to_string(i) + "]";
    checkTile(tile, name, layout.species.size(), faults);
    if (tile.first_tree != next)
      faults.add(name + ": first_tree = " + std::to_string(tile.first_tree) + " should be " +
                 std::to_string(next));
    next += tile.count;
  }
  if (next > MOST_TREES)
    faults.add("layout: " + std::to_string(next) + " trees, more than the " +
               std::to_string(MOST_TREES) + " allowed");
}

TreeSeed seedInTile(const Tile& tile, std::uint32_t index) {
  // One tree per cell of a square grid, jittered inside it: no two trunks touch.
  const std::uint32_t side = cellsASide(tile);
  const double cell = tile.size / side;
  const Random random = Random(tile.seed).child(index);
  const std::uint32_t column = index % side, row = index / side;
  TreeSeed out;
  out.seed = random.bits(GROWTH);
  out.species = pickSpecies(tile.mix, random.uniform(SPECIES));
  out.position.x() = tile.x + cell * (column + random.uniform(X, 0.15, 0.85));
  out.position.y() = tile.y + cell * (row + random.uniform(Y, 0.15, 0.85));
  out.yaw = random.uniform(YAW, 0.0, 2.0 * PI);
  out.scale = random.uniform(SCALE, SMALLEST_TILED_SCALE, LARGEST_TILED_SCALE);
  return out;
}

TreeSeed seedOf(const Layout& layout, std::uint32_t tree) {
  if (tree < layout.trees.size()) return layout.trees[tree];
  // Tiles are sorted by their first tree: this finds the last one that starts at or before the
  // tree.
  std::size_t low = 0, high = layout.tiles.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (layout.tiles[middle].first_tree <= tree)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == 0 || tree - layout.tiles[low - 1].first_tree >= layout.tiles[low - 1].count)
    throw std::out_of_range("tree = " + std::to_string(tree) + " is unknown; there are " +
                            std::to_string(layout.treeCount()) + ", from 0");
  const Tile& tile = layout.tiles[low - 1];
  return seedInTile(tile, tree - tile.first_tree);
}

std::vector<std::uint32_t> findTreesInTile(const Tile& tile, const Vec3& point, double radius) {
  const std::uint32_t side = cellsASide(tile);
  const double cell = tile.size / side, x = (point.x() - tile.x) / cell,
               y = (point.y() - tile.y) / cell, r = radius / cell;
  const auto first = [&](double low) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0, double(side)));
  };
  const auto end = [&](double high) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(high) + 1.0, 0.0, double(side)));
  };
  std::vector<std::uint32_t> out;
  for (std::uint32_t row = first(y - r); row < end(y + r); ++row) {
    const double off = std::max({0.0, row - y, y - row - 1.0});  // of the row's nearer edge
    const double half = std::sqrt(std::max(0.0, r * r - off * off));
    for (std::uint32_t column = first(x - half); column < end(x + half); ++column)
      if (row * side + column < tile.count) out.push_back(row * side + column);
  }
  return out;
}

Vec3 footOf(const TreeSeed& seed, const terrain::HeightMap& terrain) {
  return seed.position + Vec3(0.0, 0.0, terrain.height(seed.position.x(), seed.position.y()));
}

}  // namespace vegetation_sim::forest
