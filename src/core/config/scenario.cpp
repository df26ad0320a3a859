// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/scenario.h"

#include <algorithm>
#include <array>

namespace vegetation_sim {
namespace {

const std::array<const char*, 10> KNOWN_KEYS = {"frame_id", "seed",  "terrain", "wind",  "forest",
                                                "physics",  "grass", "canopy",  "crowd", "viewer"};

std::string knownKeys() {
  std::string out;
  for (const char* key : KNOWN_KEYS) out += (out.empty() ? "" : ", ") + std::string(key);
  return out;
}

bool isKnown(const std::string& key) {
  return std::find(KNOWN_KEYS.begin(), KNOWN_KEYS.end(), key) != KNOWN_KEYS.end();
}

}  // namespace

Scenario::Scenario(const YAML::Node& node, const std::string& name)
    : node_(node), faults_(std::make_unique<Faults>()), top_(node, name, *faults_) {}

Scenario Scenario::load(const std::string& file) {
  return Scenario(loadYamlFile(file), file);
}

Scenario Scenario::parse(const std::string& text, const std::string& name) {
  return Scenario(parseYaml(text, name), name);
}

void Scenario::finish() {
  if (node_.IsMap()) {
    for (const auto& entry : node_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "(not a word)";
      if (!isKnown(key)) top_.fault(key, "is not a known key; known are " + knownKeys());
    }
  }
  faults_->throwIfAny();
}

}  // namespace vegetation_sim
