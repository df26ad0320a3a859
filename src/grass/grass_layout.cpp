// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/grass_layout.h"

#include <filesystem>

namespace vegetation_sim::grass {
namespace {

// Reads the map from a file of its own or from the keys of the section.
std::shared_ptr<const FeatureMap> readMap(YamlSection& section, const std::string& folder,
                                          Faults& faults) {
  std::string file;
  section.text("map", file);
  const std::size_t before = faults.list().size();
  MapInput input;
  if (file.empty()) input = readMapInput(section, folder);
  if (faults.list().size() > before) return std::make_shared<const FeatureMap>();
  try {
    return std::make_shared<const FeatureMap>(
        file.empty() ? FeatureMap(std::move(input))
                     : FeatureMap::load((std::filesystem::path(folder) / file).string()));
  } catch (const InvalidInput& error) {
    section.fault(error.what());
    return std::make_shared<const FeatureMap>();
  }
}

}  // namespace

std::uint64_t Layout::hash() const {
  Hash hash;
  for (const std::uint64_t value :
       {map->hash(), seed, terrain_hash, static_cast<std::uint64_t>(blade_model)})
    hash.add(value);
  hash.add(tread_spacing);
  FieldHasher hasher(hash);
  TreadLaw law = tread;
  describe(hasher, law);
  return hash.value();
}

Scene readScene(YamlSection& section, const std::string& folder, std::uint64_t seed,
                Faults& faults) {
  Scene out;
  out.layout.seed = seed;
  section.choice("blade_model", out.layout.blade_model, {"arc", "paper"});
  YamlSection tread = section.section("tread");
  describe(tread, out.layout.tread);
  tread.finish();
  YamlSection treading = section.section("treading");
  describe(treading, out.treading);
  treading.finish();
  out.layout.map = readMap(section, folder, faults);
  check(out.layout.tread, section.path() + ": tread: ", faults);
  return out;
}

}  // namespace vegetation_sim::grass
