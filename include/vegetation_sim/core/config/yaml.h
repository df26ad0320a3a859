// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {

/// Limits of all YAML texts of a message together, and of the name of each [bytes].
constexpr std::size_t LARGEST_YAML_TEXT = 1u << 20, LONGEST_YAML_NAME = 256;

/// A YAML text in a message.
struct NamedText {
  const std::string& name;
  const std::string& text;
};
/// Returns whether the sizes of texts and names keep the limits; to be called before any is parsed.
/// Adds a fault otherwise. @param what the texts are of.
bool keepLimits(const char* what, const std::vector<NamedText>& texts, Faults& faults);

/// One map of a YAML file, read strictly: a wrong type, a value out of range and, after finish(), a
/// key that was never read are faults that name file, key, value and allowed range. A key that is
/// absent leaves the default. Visits a `describe` function as well as single keys.
class YamlSection : public FieldVisitor {
 public:
  /// @param path is shown in faults, as in "forest.yaml: trees[2]".
  YamlSection(const YAML::Node& node, std::string path, Faults& faults);

  bool has(const std::string& key) const;
  const std::string& path() const { return path_; }

  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char* name, Vec3& value, const char* unit, Range range) override;
  using FieldVisitor::choice;
  void choice(const char* name, int& value, const std::vector<std::string>& names) override;
  void text(const char* name, std::string& value);
  void flag(const char* name, bool& value);
  void seed(const char* name, std::uint64_t& value);

  /// Returns the map under `name`, or an empty one if it is absent. Adds a fault if it is no map.
  YamlSection section(const char* name);
  /// Returns the maps in the list under `name`, or none if it is absent. Adds a fault if there are
  /// more than `most`.
  std::vector<YamlSection> sections(const char* name, std::size_t most = 100000);

  /// Adds a fault of the caller about the value of `name`.
  void fault(const std::string& name, const std::string& problem);
  /// Adds a fault of the caller about the whole map.
  void fault(const std::string& problem);
  /// Reports the keys that were never read.
  void finish();

 private:
  template <class T>
  bool read(const char* name, const char* type, T& value);

  YAML::Node node_;
  std::string path_;
  Faults* faults_;
  std::set<std::string> asked_;
};

/// Parses a file. @throws InvalidInput naming the file if it is missing, larger than 4 MiB or no
/// YAML.
YAML::Node loadYamlFile(const std::string& file);
/// Parses text; `name` stands for it in the error. @throws InvalidInput
YAML::Node parseYaml(const std::string& text, const std::string& name);

/// Writes every visited field as `key: value`, numbers with 17 digits so that they survive exactly.
class YamlFieldWriter : public FieldVisitor {
 public:
  explicit YamlFieldWriter(YAML::Emitter& out) : out_(out) {}
  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char* name, Vec3& value, const char* unit, Range range) override;
  void choice(const char* name, int& value, const std::vector<std::string>& names) override;

 private:
  YAML::Emitter& out_;
};

}  // namespace vegetation_sim
