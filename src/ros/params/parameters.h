// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {

/// Strict reader of a node's private parameters: a wrong type, a value out of range and, after
/// finish(), a key that was not read are faults that name key, value and allowed range. A key
/// that is absent leaves the default. Visits a `describe` function as well as single keys.
class Parameters : public FieldVisitor {
 public:
  explicit Parameters(const ros::NodeHandle& private_handle);

  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char* name, Vec3& value, const char* unit, Range range) override;
  using FieldVisitor::choice;
  void choice(const char* name, int& value, const std::vector<std::string>& names) override;
  void text(const char* name, std::string& value);
  /// The name of a tf frame; an empty one is a fault unless it may be.
  void frame(const char* name, std::string& value, bool may_be_empty = false);
  /// A list of at most `most` names of tf frames, none of them twice, or a map of such lists.
  void frames(const char* name, std::vector<std::string>& values, std::size_t most);
  void flag(const char* name, bool& value);
  void integers(const char* name, std::vector<int>& values, Range range);

  /// A list of maps, as a map with `name` as its one key, for the strict reader of files. It may be
  /// a map of such lists, and an entry that is text is the map {frame: text}. False: it is absent.
  bool list(const char* name, YAML::Node& map);
  /// A map, for the strict reader of files. False: it is absent.
  bool map(const char* name, YAML::Node& map);
  /// A whole number from 0, or text of digits for what an XML-RPC integer cannot hold.
  void seed(const char* name, std::uint64_t& value);

  /// Makes a key legal that is read elsewhere.
  void allow(const std::string& name) { asked_.insert(name); }
  /// Adds a fault about the value of `name`.
  void fault(const std::string& name, const std::string& problem);
  Faults& faults() { return faults_; }
  /// @throws InvalidInput with all faults, unknown keys among them.
  void finish();

 private:
  bool find(const char* name, XmlRpc::XmlRpcValue& value);
  void wrongType(const char* name, const XmlRpc::XmlRpcValue& value, const char* wanted);
  bool inRange(const std::string& name, double value, const char* unit, Range range);

  ros::NodeHandle handle_;
  std::set<std::string> asked_;
  Faults faults_;
};

}  // namespace vegetation_sim
