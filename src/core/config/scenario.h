// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

/// One scene in one file. Each node reads its own section. The sections of other nodes are allowed
/// and ignored; any other top-level key is a fault.
class Scenario {
 public:
  /// @throws InvalidInput naming the file if it is missing, too large or no YAML.
  static Scenario load(const std::string& file);
  /// Does the same from text; `name` stands for the file in faults.
  static Scenario parse(const std::string& text, const std::string& name);

  /// Returns the top level, for frame_id, seed and terrain.
  YamlSection& top() { return top_; }
  /// Returns the map under a top-level key, or an empty one if it is absent.
  YamlSection section(const char* name) { return top_.section(name); }
  bool has(const std::string& name) const { return top_.has(name); }
  Faults& faults() { return *faults_; }

  /// @throws InvalidInput with all faults that readers of the sections found, and unknown keys.
  void finish();

 private:
  Scenario(const YAML::Node& node, const std::string& name);

  YAML::Node node_;
  std::unique_ptr<Faults> faults_;  // on the heap, because the sections point at it
  YamlSection top_;
};

}  // namespace vegetation_sim
