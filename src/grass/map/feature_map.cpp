// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/map/feature_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/config/base_file.h"
#include "core/math/growth_stage.h"
#include "grass/map/map_layers.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::grass {
namespace {

// Visits the layers of a map with their rules; the mix of each species comes last.
template <class Input, class Visit>
void forEachLayer(Input& input, const std::string& context, Visit&& visit) {
  visit(input.height, HEIGHT_RULE, context);
  visit(input.density, DENSITY_RULE, context);
  visit(input.colour, COLOUR_RULE, context);
  visit(input.shape, SHAPE_RULE, context);
  for (auto& entry : input.species)
    visit(entry.mix, MIX_RULE, context + "species " + inQuotes(entry.species.name) + ": ");
}

void checkSpecies(MapInput& input, const std::string& context, Faults& faults) {
  std::set<std::string> names;
  for (SpeciesInput& entry : input.species) {
    FieldChecker checker(context + "species " + inQuotes(entry.species.name) + ": ", faults);
    describe(checker, entry.species);
    if (!names.insert(entry.species.name).second)
      faults.add(context + "species " + inQuotes(entry.species.name) + " is defined twice");
  }
  if (input.species.size() > MAX_SPECIES)
    faults.add(context + std::to_string(input.species.size()) + " species, allowed are 1 to " +
               std::to_string(MAX_SPECIES));
}

void checkBlades(const MapInput& input, const std::string& context, Faults& faults) {
  const double area = input.law.resolution * input.law.resolution;
  const double blades = area * largestOf(input.density);
  if (blades >= MAX_BLADES)
    faults.add(context + "density and resolution make " + std::to_string(blades) +
               " blades in a tile, allowed are fewer than " + std::to_string(MAX_BLADES));
}

std::uint64_t hashOf(MapInput& input) {
  Hash hash;
  FieldHasher hasher(hash);
  describe(hasher, input.law);
  for (SpeciesInput& entry : input.species) {
    hash.add(entry.species.name);
    describe(hasher, entry.species);
  }
  forEachLayer(input, "", [&](const LayerInput& layer, const LayerRule&, const std::string&) {
    for (const double value : {layer.value, layer.black, layer.white}) hash.add(value);
    hash.add(static_cast<std::uint64_t>(layer.image.white));
    for (const auto s : layer.image.samples) hash.add(static_cast<std::uint64_t>(s));
  });
  return hash.value();
}

// Takes the number of nodes from the first image.
void takeSize(MapInput& input) {
  bool taken = false;
  forEachLayer(input, "", [&](const LayerInput& layer, const LayerRule&, const std::string&) {
    if (taken || layer.image.samples.empty()) return;
    input.law.columns = layer.image.columns;
    input.law.rows = layer.image.rows;
    taken = true;
  });
}

void readSpecies(YamlSection& yaml, const std::string& folder, MapInput& input) {
  for (YamlSection& entry : yaml.sections("species")) {
    SpeciesInput species;
    readBase(entry, folder + "/../grasses", [&](YamlSection& base) {
      base.text("name", species.species.name);
      describe(base, species.species);
    });
    if (!entry.has("name") && !entry.has("base")) entry.fault("name", "is missing");
    entry.text("name", species.species.name);
    describe(entry, species.species);
    double stage = GROWN;
    entry.number("stage", stage, "", {SEEDLING, GROWN});
    species.species = applyStage(species.species, stage);
    readLayer(entry, MIX_RULE, folder, species.mix);
    entry.finish();
    input.species.push_back(std::move(species));
  }
}

}  // namespace

void describe(FieldVisitor& v, MapLaw& law) {
  v.number("resolution", law.resolution, "m", {0.1, 100.0});
  v.number("origin_x", law.origin_x, "m", {-1e6, 1e6});
  v.number("origin_y", law.origin_y, "m", {-1e6, 1e6});
  v.integer("columns", law.columns, "", {2, terrain::LONGEST_SIDE});
  v.integer("rows", law.rows, "", {2, terrain::LONGEST_SIDE});
}

MapInput readMapInput(YamlSection& yaml, const std::string& folder) {
  MapInput input;
  describe(yaml, input.law);
  readSpecies(yaml, folder, input);
  forEachLayer(input, "", [&](LayerInput& layer, const LayerRule& rule, const std::string& owner) {
    if (owner.empty()) readLayer(yaml, rule, folder, layer);
  });
  return input;
}

FeatureMap::FeatureMap(MapInput input) : input_(std::move(input)) {
  if (input_.species.empty()) input_.species.emplace_back();
  takeSize(input_);
  Faults faults;
  FieldChecker checker("grass: ", faults);
  describe(checker, input_.law);
  forEachLayer(input_, "grass: ",
               [&](const LayerInput& layer, const LayerRule& rule, const std::string& context) {
                 checkLayer(layer, rule, context, input_.law, faults);
               });
  checkSpecies(input_, "grass: ", faults);
  faults.throwIfAny();
  checkBlades(input_, "grass: ", faults);
  faults.throwIfAny();
  double factor = 0.0;
  for (const SpeciesInput& entry : input_.species) factor = std::max(factor, entry.species.height);
  tallest_ = factor * largestOf(input_.height);
  hash_ = hashOf(input_);
}

FeatureMap FeatureMap::load(const std::string& file) {
  Faults faults;
  YamlSection yaml(loadYamlFile(file), file, faults);
  MapInput input = readMapInput(yaml, std::filesystem::path(file).parent_path().string());
  yaml.finish();
  faults.throwIfAny();
  try {
    return FeatureMap(std::move(input));
  } catch (const InvalidInput& error) {
    throw InvalidInput(file + ": " + error.what());
  }
}

Features FeatureMap::node(int column, int row) const {
  Features out;
  out.height = valueAt(input_.height, column, row);
  out.density = valueAt(input_.density, column, row);
  out.colour = valueAt(input_.colour, column, row);
  out.shape = valueAt(input_.shape, column, row);
  for (std::size_t s = 0; s < input_.species.size(); ++s)
    out.mix[s] = valueAt(input_.species[s].mix, column, row);
  return out;
}

TileMeans FeatureMap::meansOf(int tile_column, int tile_row) const {
  TileMeans out;
  for (int corner = 0; corner < 4; ++corner) {
    const int column = tile_column + corner % 2, row = tile_row + corner / 2;
    out.height += 0.25 * valueAt(input_.height, column, row);
    out.density += 0.25 * valueAt(input_.density, column, row);
  }
  return out;
}

Features FeatureMap::at(double x, double y) const {
  const MapLaw& law = input_.law;
  const double u = (x - law.origin_x) / law.resolution, v = (y - law.origin_y) / law.resolution;
  if (!(u >= 0.0 && v >= 0.0 && u <= tileColumns() && v <= tileRows())) return {};
  const int c = std::min(static_cast<int>(u), tileColumns() - 1);
  const int r = std::min(static_cast<int>(v), tileRows() - 1);
  const double p = u - c, q = v - r;
  const double weights[] = {(1.0 - p) * (1.0 - q), p * (1.0 - q), (1.0 - p) * q, p * q};
  Features out;
  for (int corner = 0; corner < 4; ++corner) {
    const Features f = node(c + corner % 2, r + corner / 2);
    out.height += weights[corner] * f.height;
    out.density += weights[corner] * f.density;
    out.colour += weights[corner] * f.colour;
    out.shape += weights[corner] * f.shape;
    for (std::size_t s = 0; s < input_.species.size(); ++s)
      out.mix[s] += weights[corner] * f.mix[s];
  }
  return out;
}

}  // namespace vegetation_sim::grass
