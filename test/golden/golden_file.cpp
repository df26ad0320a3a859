// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "golden/golden_file.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim::golden {
namespace {

const char* const HEADER =
    R"(# What the shared scenes (scenes/) give after 600 steps; written by `golden_test --record FILE`.
# Every hash is chained over every 60th step:
#   state      all that the coming steps depend on
#   reference  poses and reactions in double precision
#   display    what displays and sensors rebuild: poses, meshes, blades and layers in single
#              precision, ranges of a lidar
# The hashes hold for every instruction set; instruction_sets lists those they were recorded with.
)";

bool operator!=(const scenes::Outcome& a, const scenes::Outcome& b) {
  return a.state != b.state || a.reference != b.reference || a.display != b.display ||
         a.number != b.number;
}

/// The outcome that all instruction sets agree on.
scenes::Outcome agreedOutcome(const scenes::SceneEntry& scene,
                              const std::vector<std::string>& sets) {
  scenes::Outcome first;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    forceInstructionSet(sets[i]);
    const scenes::Outcome outcome = scenes::run(scene);
    if (i == 0) first = outcome;
    if (outcome != first)
      throw std::runtime_error(std::string(scene.name) + " differs with " + sets[i]);
  }
  return first;
}

void write(std::ostream& out, const scenes::SceneEntry& scene, const Record& record) {
  out << "  " << scene.name << ":\n    covers: " << scene.covers
      << "\n    measured: " << scene.measured << "\n    number: " << record.number
      << "\n    state: " << record.state << "\n    reference: " << record.reference
      << "\n    display: " << record.display << "\n";
}

}  // namespace

std::string hexOf(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof(text), "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::string textOf(double number) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9f", number);
  return text;
}

Record recordOf(const scenes::Outcome& outcome) {
  return {textOf(outcome.number), hexOf(outcome.state), hexOf(outcome.reference),
          hexOf(outcome.display)};
}

std::map<std::string, Record> readGolden(const std::string& file) {
  std::map<std::string, Record> out;
  for (const auto& entry : loadYamlFile(file)["scenes"]) {
    const YAML::Node& scene = entry.second;
    out[entry.first.as<std::string>()] = {
        scene["number"].as<std::string>(), scene["state"].as<std::string>(),
        scene["reference"].as<std::string>(), scene["display"].as<std::string>()};
  }
  return out;
}

void recordGolden(const std::string& file) {
  const std::vector<std::string> sets = instructionSets();  // while none is forced
  std::ofstream out(file);
  out << HEADER << "instruction_sets: [";
  const char* separator = "";
  for (const std::string& set : sets) {
    out << separator << set;
    separator = ", ";
  }
  out << "]\nscenes:\n";
  for (const scenes::SceneEntry& scene : scenes::allScenes()) {
    write(out, scene, recordOf(agreedOutcome(scene, sets)));
    std::printf("recorded %s\n", scene.name);
  }
  forceInstructionSet("");
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace vegetation_sim::golden
