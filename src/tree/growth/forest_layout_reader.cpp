// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <map>
#include <utility>

#include "core/math/growth_stage.h"
#include "terrain/plant_rows.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim::forest {
namespace {

constexpr Range ANYWHERE{-1e7, 1e7};
constexpr int MOST_TILES = 65536;
constexpr std::size_t MOST_DESIGNED = 1024;  // species with factors of single trees
constexpr double OF_THE_FILE = -1.0;         // a strength that is not given

class LayoutReader {
 public:
  LayoutReader(YamlSection section, std::string folder, const terrain::HeightMap& ground,
               std::uint64_t seed, Faults& faults)
      : section_(std::move(section)),
        folder_(std::move(folder)),
        ground_(ground),
        seed_(seed),
        faults_(faults) {}

  Layout read() {
    readSpeciesList();
    YamlSection motion = section_.section("motion");
    describe(motion, out_.motion);
    motion.finish();
    for (YamlSection& tree : section_.sections("trees")) out_.trees.push_back(readTree(tree));
    for (YamlSection& rows : section_.sections("rows")) readRows(rows);
    for (YamlSection& tile : section_.sections("tiles")) readTile(tile);
    section_.finish();
    Faults of_the_whole;
    if (faults_.empty()) check(out_, of_the_whole);
    for (const std::string& fault : of_the_whole.list()) section_.fault(fault);
    return std::move(out_);
  }

 private:
  void readSpeciesList() {
    for (YamlSection& entry : section_.sections("species")) {
      std::string name, file;
      entry.text("name", name);
      entry.text("file", file);
      double stage = GROWN;
      entry.number("stage", stage, "", {SEEDLING, GROWN});
      double strength = OF_THE_FILE;
      entry.number("strength", strength, "Pa", {0.0, 1e12});
      entry.finish();
      if (file.empty()) file = "../species/" + name + ".yaml";
      const auto path = (std::filesystem::path(folder_) / file).lexically_normal();
      try {
        Species species = applyStage(loadSpecies(path.string()), stage);
        if (!name.empty()) species.name = name;
        if (strength != OF_THE_FILE) species.strength = strength;
        number_[species.name] = static_cast<std::uint16_t>(out_.species.size());
        out_.species.push_back(std::move(species));
      } catch (const InvalidInput& error) {
        faults_.add(entry.path() + ": " + error.what());
      }
    }
  }

  std::uint16_t speciesNumber(YamlSection& section, const std::string& name) {
    const auto found = number_.find(name);
    if (found != number_.end()) return found->second;
    std::string known;
    for (const auto& entry : number_) known += (known.empty() ? "" : ", ") + entry.first;
    section.fault("species", "= " + inQuotes(name) + " is none of " + known);
    return 0;
  }

  std::uint64_t nextSeed() { return Random(seed_).bits(drawn_++); }

  TreeSeed readTree(YamlSection& section) {
    TreeSeed tree;
    tree.seed = nextSeed();
    std::string name;
    section.text("species", name);
    tree.species = speciesNumber(section, name);
    section.seed("seed", tree.seed);
    section.vector("position", tree.position, "m", ANYWHERE);
    section.number("yaw", tree.yaw, "rad", {-1000.0, 1000.0});
    section.number("scale", tree.scale, "", {0.05, 20.0});
    TreeFactors factors;
    describe(section, factors);
    section.finish();
    tree.species = designedSpecies(section, tree.species, factors);
    return tree;
  }

  // Returns the species of a tree with its own factors, which trees whose factors are equal to six
  // digits share. A scenario cannot name it.
  std::uint16_t designedSpecies(YamlSection& section, std::uint16_t species,
                                const TreeFactors& factors) {
    const bool plain = factors.stiffness == 1.0 && factors.damping == 1.0 && factors.wind == 1.0;
    if (plain || species >= out_.species.size()) return species;
    Species own = applyFactors(out_.species[species], factors);
    const auto [entry, is_new] = designed_.try_emplace(own.name, species);
    if (!is_new) return entry->second;
    if (designed_.size() > MOST_DESIGNED) {
      section.fault("stiffness, damping, wind",
                    "are the factors of more than " + std::to_string(MOST_DESIGNED) + " kinds");
      return species;
    }
    entry->second = static_cast<std::uint16_t>(out_.species.size());
    out_.species.push_back(std::move(own));
    return entry->second;
  }

  void readRows(YamlSection& section) {
    std::uint64_t seed = nextSeed();
    std::string name;
    section.text("species", name);
    const std::uint16_t species = speciesNumber(section, name);
    section.seed("seed", seed);
    const terrain::RowLaw law = terrain::readRowLaw(section);
    section.finish();
    if (!faults_.empty()) return;
    const int room = terrain::MOST_ROW_PLANTS - planted_;
    for (const terrain::RowPlant& plant : terrain::placeInRows(law, ground_, seed, room, section)) {
      out_.trees.push_back({plant.seed, species, plant.position, plant.yaw, plant.scale});
      ++planted_;
    }
  }

  // A tile may be split into rows x columns of equal ones, so that a forest is one entry.
  void readTile(YamlSection& section) {
    Tile tile;
    int count = 0, rows = 1, columns = 1;
    tile.seed = nextSeed();
    section.seed("seed", tile.seed);
    section.number("x", tile.x, "m", ANYWHERE);
    section.number("y", tile.y, "m", ANYWHERE);
    section.number("size", tile.size, "m", {0.1, 1e5});
    section.integer("count", count, "", {0, 1 << 24});
    section.integer("rows", rows, "", {1, 4096});
    section.integer("columns", columns, "", {1, 4096});
    tile.mix = readMix(section.section("mix"));
    section.finish();
    const double tiles = static_cast<double>(rows) * columns;
    if (tiles > MOST_TILES || tiles * count + out_.treeCount() > MOST_TREES)
      return faults_.add(section.path() + ": " + std::to_string(rows) + " rows x " +
                         std::to_string(columns) + " columns x " + std::to_string(count) +
                         " trees pass the " + std::to_string(MOST_TILES) + " tiles or " +
                         std::to_string(MOST_TREES) + " trees allowed");
    const Tile first = tile;
    for (int i = 0; i < rows * columns; ++i) {
      tile.first_tree = out_.treeCount();
      tile.count = static_cast<std::uint32_t>(count);
      const int column = i % columns, row = i / columns;
      tile.x = first.x + first.size * column;
      tile.y = first.y + first.size * row;
      tile.seed = Random(first.seed).bits(static_cast<std::uint64_t>(i));
      out_.tiles.push_back(tile);
    }
  }

  std::vector<float> readMix(YamlSection section) {
    std::vector<float> mix(out_.species.size(), 0.f);
    for (const auto& entry : number_) {
      double weight = 0.0;
      section.number(entry.first.c_str(), weight, "", {0.0, 1e6});
      mix[entry.second] = static_cast<float>(weight);
    }
    section.finish();
    return mix;
  }

  YamlSection section_;
  std::string folder_;
  const terrain::HeightMap& ground_;
  std::uint64_t seed_;
  Faults& faults_;
  Layout out_;
  std::map<std::string, std::uint16_t> number_;  // species by name
  std::map<std::string, std::uint16_t> designed_;
  std::uint64_t drawn_{0};
  int planted_{0};  // in rows
};

}  // namespace

Layout readLayout(YamlSection section, const std::string& folder, const terrain::HeightMap& ground,
                  std::uint64_t seed, Faults& faults) {
  return LayoutReader(std::move(section), folder, ground, seed, faults).read();
}

}  // namespace vegetation_sim::forest
