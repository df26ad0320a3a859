// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/grass_conversions.h"

#include <algorithm>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_BLOCKS = 1u << 20;
const char* const BLADE_MODELS[] = {"arc", "paper"};
constexpr std::uint16_t BYTE = 255;

GrassLayer toMsg(const grass::LayerInput& layer) {
  GrassLayer out;
  out.value = layer.value;
  out.black = layer.black;
  out.white = layer.white;
  if (layer.image.samples.empty()) return out;
  out.columns = static_cast<std::uint32_t>(layer.image.columns);
  out.rows = static_cast<std::uint32_t>(layer.image.rows);
  out.brightest = layer.image.white;
  const bool wide = layer.image.white > BYTE;
  out.samples.reserve(layer.image.samples.size() * (wide ? 2 : 1));
  for (const std::uint16_t sample : layer.image.samples) {
    out.samples.push_back(static_cast<std::uint8_t>(sample & BYTE));
    if (wide) out.samples.push_back(static_cast<std::uint8_t>(sample >> 8));
  }
  return out;
}

grass::LayerInput layerFromMsg(const std::string& name, const GrassLayer& message, Faults& faults) {
  grass::LayerInput out{message.value, {}, message.black, message.white};
  if (message.columns == 0 && message.samples.empty()) return out;
  const std::size_t width = message.brightest > BYTE ? 2 : 1;
  const std::uint64_t wanted = std::uint64_t{message.columns} * message.rows * width;
  const auto longest = static_cast<std::uint32_t>(terrain::LONGEST_SIDE);
  if (message.columns > longest || message.rows > longest || wanted != message.samples.size()) {
    faults.add("layout: " + name + ": " + std::to_string(message.samples.size()) + " bytes for " +
               std::to_string(message.columns) + " x " + std::to_string(message.rows) +
               " samples of " + std::to_string(width));
    return out;
  }
  out.image = {
      static_cast<int>(message.columns), static_cast<int>(message.rows), message.brightest, {}};
  for (std::size_t i = 0; i < message.samples.size(); i += width)
    out.image.samples.push_back(static_cast<std::uint16_t>(
        message.samples[i] | (width > 1 ? message.samples[i + 1] << 8 : 0)));
  return out;
}

grass::SpeciesInput speciesFromMsg(const GrassSpecies& message, Faults& faults) {
  grass::SpeciesInput out;
  out.species.name = message.name;
  const std::string name = "species " + inQuotes(message.name);
  try {
    YamlSection section(parseYaml(message.rules, name), "layout: " + name, faults);
    describe(section, out.species);
    section.finish();
  } catch (const InvalidInput& error) {
    faults.add(std::string("layout: ") + error.what());
  }
  out.mix = layerFromMsg(name + ": mix", message.mix, faults);
  return out;
}

grass::BladeModel bladeModelOf(const std::string& name, Faults& faults) {
  for (int i = 0; i < 2; ++i)
    if (name == BLADE_MODELS[i]) return static_cast<grass::BladeModel>(i);
  faults.add("layout: blade_model = " + inQuotes(name) + " is none of arc, paper");
  return {};
}

grass::MapInput mapFromMsg(const GrassLayout& message, Faults& faults) {
  grass::MapInput out;
  const auto side = [](std::uint32_t count) {
    return static_cast<int>(std::min<std::uint32_t>(count, 1u << 20));
  };
  out.law = {message.resolution, message.origin_x, message.origin_y, side(message.columns),
             side(message.rows)};
  out.height = layerFromMsg("height", message.height, faults);
  out.density = layerFromMsg("density", message.density, faults);
  out.colour = layerFromMsg("colour", message.colour, faults);
  out.shape = layerFromMsg("shape", message.shape, faults);
  std::vector<NamedText> rules;
  for (const GrassSpecies& species : message.species)
    rules.push_back({species.name, species.rules});
  if (message.species.size() > grass::MAX_SPECIES)
    faults.add("layout: " + std::to_string(message.species.size()) + " species, allowed are " +
               std::to_string(grass::MAX_SPECIES));
  else if (keepLimits("layout: species", rules, faults))
    for (const GrassSpecies& species : message.species)
      out.species.push_back(speciesFromMsg(species, faults));
  return out;
}

GrassSpecies toMsg(const grass::SpeciesInput& input) {
  GrassSpecies out;
  out.name = input.species.name;
  YAML::Emitter text;
  text << YAML::Flow << YAML::BeginMap;
  YamlFieldWriter writer(text);
  grass::Species copy = input.species;
  describe(writer, copy);
  text << YAML::EndMap;
  out.rules = text.c_str();
  out.mix = toMsg(input.mix);
  return out;
}

}  // namespace

GrassLayout toMsg(const grass::Layout& layout) {
  const grass::MapInput& map = layout.map->input();
  GrassLayout out;
  out.hash = layout.hash();
  out.seed = layout.seed;
  out.resolution = map.law.resolution;
  out.origin_x = map.law.origin_x;
  out.origin_y = map.law.origin_y;
  out.columns = static_cast<std::uint32_t>(map.law.columns);
  out.rows = static_cast<std::uint32_t>(map.law.rows);
  out.height = toMsg(map.height);
  out.density = toMsg(map.density);
  out.colour = toMsg(map.colour);
  out.shape = toMsg(map.shape);
  for (const grass::SpeciesInput& species : map.species) out.species.push_back(toMsg(species));
  out.terrain = layout.terrain;
  out.terrain_hash = layout.terrain_hash;
  out.blade_model = BLADE_MODELS[static_cast<int>(layout.blade_model)];
  out.tread_spacing = layout.tread_spacing;
  out.tread = toMsg(layout.tread);
  return out;
}

grass::Layout fromMsg(const GrassLayout& message) {
  Faults faults;
  grass::Layout out;
  grass::MapInput map = mapFromMsg(message, faults);
  out.seed = message.seed;
  out.terrain = message.terrain;
  out.terrain_hash = message.terrain_hash;
  out.blade_model = bladeModelOf(message.blade_model, faults);
  out.tread_spacing = message.tread_spacing;
  out.tread = fromMsg(message.tread, grass::TreadLaw(), "layout: tread: ", faults);
  check(out.tread, "layout: tread: ", faults);
  FieldChecker checker("layout: ", faults);
  checker.number("tread_spacing", out.tread_spacing, "m", {0.001, 100.0});
  faults.throwIfAny();
  out.map = std::make_shared<const grass::FeatureMap>(std::move(map));
  if (out.hash() != message.hash)
    throw InvalidInput("layout: hash = " + std::to_string(message.hash) +
                       " is not that of its content, " + std::to_string(out.hash()));
  return out;
}

GrassState toMsg(const grass::TreadUpdate& update) {
  GrassState out;
  out.header.stamp = toStamp(update.stamp);
  out.sequence = update.sequence;
  out.key_frame = update.key_frame;
  out.layout_hash = update.layout_hash;
  out.hash = update.hash;
  out.shard = update.shard;
  out.shards = update.shards;
  for (const grass::Press& press : update.treads.presses) {
    out.press_stamps.push_back(toStamp(press.stamp));
    out.press_recoveries.push_back(press.recovery);
  }
  out.blocks.reserve(update.treads.blocks.size());
  for (const grass::TreadBlockDelta& block : update.treads.blocks) {
    TroddenBlock message;
    message.row = block.row;
    message.column = block.column;
    std::copy(block.included.begin(), block.included.end(), message.included.begin());
    for (const grass::TreadNodeDelta& node : block.nodes) {
      message.tilt.push_back(node.tilt);
      message.x.push_back(node.x);
      message.y.push_back(node.y);
      message.press.push_back(node.press);
    }
    out.blocks.push_back(std::move(message));
  }
  for (const grass::CutBlockDelta& block : update.treads.cuts) {
    CutBlock message;
    message.row = block.row;
    message.column = block.column;
    std::copy(block.included.begin(), block.included.end(), message.included.begin());
    for (const grass::CutNode& node : block.nodes) {
      message.height.push_back(node.height);
      message.swath.push_back(node.swath);
    }
    out.cuts.push_back(std::move(message));
  }
  return out;
}

grass::TreadUpdate fromMsg(const GrassState& message) {
  Faults faults;
  grass::TreadUpdate out;
  out.stamp = fromMsg(message.header.stamp);
  out.sequence = message.sequence;
  out.key_frame = message.key_frame;
  out.layout_hash = message.layout_hash;
  out.hash = message.hash;
  out.shard = message.shard;
  out.shards = std::max<std::uint32_t>(1, message.shards);
  check(Shard{out.shard, out.shards}, faults);
  if (message.press_stamps.size() != message.press_recoveries.size())
    faults.add("state: " + std::to_string(message.press_stamps.size()) + " press_stamps for " +
               std::to_string(message.press_recoveries.size()) + " press_recoveries");
  for (const std::size_t blocks : {message.blocks.size(), message.cuts.size()})
    if (blocks > MOST_BLOCKS)
      faults.add("state: " + std::to_string(blocks) + " blocks, allowed are " +
                 std::to_string(MOST_BLOCKS));
  faults.throwIfAny();
  for (std::size_t i = 0; i < message.press_stamps.size(); ++i)
    out.treads.presses.push_back({fromMsg(message.press_stamps[i]), message.press_recoveries[i]});
  for (const TroddenBlock& block : message.blocks) {
    grass::TreadBlockDelta delta{block.row, block.column, {}, {}};
    std::copy(block.included.begin(), block.included.end(), delta.included.begin());
    const std::size_t count = block.tilt.size();
    if (block.x.size() != count || block.y.size() != count || block.press.size() != count)
      throw InvalidInput("state: block " + std::to_string(block.row) + ", " +
                         std::to_string(block.column) + ": its lists differ in length");
    for (std::size_t i = 0; i < count; ++i)
      delta.nodes.push_back({block.tilt[i], block.x[i], block.y[i], block.press[i]});
    out.treads.blocks.push_back(std::move(delta));
  }
  for (const CutBlock& block : message.cuts) {
    grass::CutBlockDelta delta{block.row, block.column, {}, {}};
    std::copy(block.included.begin(), block.included.end(), delta.included.begin());
    if (block.swath.size() != block.height.size())
      throw InvalidInput("state: cut block " + std::to_string(block.row) + ", " +
                         std::to_string(block.column) + ": its lists differ in length");
    for (std::size_t i = 0; i < block.height.size(); ++i)
      delta.nodes.push_back({block.height[i], block.swath[i]});
    out.treads.cuts.push_back(std::move(delta));
  }
  check(out.treads, faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
