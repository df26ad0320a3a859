// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/map/map_layers.h"

#include <algorithm>
#include <filesystem>

namespace vegetation_sim::grass {
namespace {

double scaled(const LayerInput& layer, std::uint16_t sample) {
  return layer.black +
         (layer.white - layer.black) * (sample / static_cast<double>(layer.image.white));
}

}  // namespace

double valueAt(const LayerInput& layer, int column, int row) {
  const terrain::GreyImage& image = layer.image;
  if (image.samples.empty()) return layer.value;
  const std::size_t line = static_cast<std::size_t>(image.rows - 1 - row);
  return scaled(layer, image.samples[line * image.columns + static_cast<std::size_t>(column)]);
}

double largestOf(const LayerInput& layer) {
  const auto& samples = layer.image.samples;
  if (samples.empty()) return layer.value;
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  return std::max(scaled(layer, *low), scaled(layer, *high));
}

void checkLayer(const LayerInput& layer, const LayerRule& rule, const std::string& context,
                const MapLaw& law, Faults& faults) {
  const std::string name = context + rule.name;
  const auto check = [&](const char* key, double value) {
    const std::string fault = rangeFault(name + ": " + key, value, rule.unit, rule.range);
    if (!fault.empty()) faults.add(fault);
  };
  const terrain::GreyImage& image = layer.image;
  if (image.samples.empty()) return check("value", layer.value);
  check("black", layer.black);
  check("white", layer.white);
  if (image.white < 1) faults.add(name + ": image has no largest sample");
  const auto size = static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows);
  if (image.columns != law.columns || image.rows != law.rows || image.samples.size() != size)
    faults.add(name + ": image is " + std::to_string(image.columns) + " x " +
               std::to_string(image.rows) + " with " + std::to_string(image.samples.size()) +
               " samples where the map has " + std::to_string(law.columns) + " x " +
               std::to_string(law.rows) + " nodes");
}

void readLayer(YamlSection& map, const LayerRule& rule, const std::string& folder,
               LayerInput& layer) {
  YamlSection section = map.section(rule.name);
  std::string image;
  section.text("image", image);
  section.number("value", layer.value, rule.unit, rule.range);
  section.number("black", layer.black, rule.unit, rule.range);
  section.number("white", layer.white, rule.unit, rule.range);
  section.finish();
  if (image.empty()) {
    for (const char* key : {"black", "white"})
      if (section.has(key)) section.fault(key, "is given without image");
    return;
  }
  if (section.has("value")) section.fault("value", "and image are both given; only one is allowed");
  try {
    layer.image = terrain::loadGreyImage((std::filesystem::path(folder) / image).string());
  } catch (const InvalidInput& error) {
    section.fault(error.what());
  }
}

}  // namespace vegetation_sim::grass
