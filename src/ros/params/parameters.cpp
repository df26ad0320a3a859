// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {
namespace {

std::string shown(const XmlRpc::XmlRpcValue& value) {
  std::ostringstream out;
  value.write(out);
  return out.str();
}

// Whole numbers are numbers too.
bool isNumber(const XmlRpc::XmlRpcValue& value) {
  return value.getType() == XmlRpc::XmlRpcValue::TypeDouble ||
         value.getType() == XmlRpc::XmlRpcValue::TypeInt;
}

double toNumber(XmlRpc::XmlRpcValue value) {
  return value.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                         : static_cast<double>(value);
}

// 20.0 is as good as 20.
bool isWhole(const XmlRpc::XmlRpcValue& value) {
  return isNumber(value) && toNumber(value) == std::floor(toNumber(value));
}

Range limitToInt(Range range) {
  using Limits = std::numeric_limits<int>;
  return {std::max<double>(range.low, Limits::min()), std::min<double>(range.high, Limits::max())};
}

YAML::Node toYaml(XmlRpc::XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeArray: {
      YAML::Node out(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) out.push_back(toYaml(value[i]));
      return out;
    }
    case XmlRpc::XmlRpcValue::TypeStruct: {
      YAML::Node out(YAML::NodeType::Map);
      for (auto& entry : value) out[entry.first] = toYaml(entry.second);
      return out;
    }
    case XmlRpc::XmlRpcValue::TypeDouble: {
      YAML::Emitter text;
      text << YAML::DoublePrecision(17) << static_cast<double>(value);
      return YAML::Load(text.c_str());
    }
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    default:
      return YAML::Node();
  }
}

// Adds the entries of a list, and text as the map {frame: text}. Anything else stays an entry,
// which the reader rejects.
void appendEntries(const YAML::Node& list, YAML::Node& out) {
  if (!list.IsSequence()) return out.push_back(list);
  for (const YAML::Node& entry : list) {
    if (!entry.IsScalar()) {
      out.push_back(entry);
      continue;
    }
    YAML::Node map(YAML::NodeType::Map);
    map["frame"] = entry.Scalar();
    out.push_back(map);
  }
}

}  // namespace

Parameters::Parameters(const ros::NodeHandle& private_handle) : handle_(private_handle) {
  allow("diagnostic_period");  // diagnostic_updater reads it
}

void Parameters::fault(const std::string& name, const std::string& problem) {
  faults_.add(handle_.resolveName(name) + " " + problem);
}

bool Parameters::find(const char* name, XmlRpc::XmlRpcValue& value) {
  asked_.insert(name);
  return handle_.getParam(name, value);
}

void Parameters::wrongType(const char* name, const XmlRpc::XmlRpcValue& value, const char* wanted) {
  faults_.add(handle_.resolveName(name) + " = " + shown(value) + " is not " + wanted);
}

bool Parameters::inRange(const std::string& name, double value, const char* unit, Range range) {
  const std::string fault = rangeFault(handle_.resolveName(name), value, unit, range);
  if (!fault.empty()) faults_.add(fault);
  return fault.empty();
}

void Parameters::number(const char* name, double& value, const char* unit, Range range) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (!isNumber(found)) return wrongType(name, found, "a number");
  if (inRange(name, toNumber(found), unit, limitToInt(range))) value = toNumber(found);
}

void Parameters::integer(const char* name, int& value, const char* unit, Range range) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (!isWhole(found)) return wrongType(name, found, "a whole number");
  if (inRange(name, toNumber(found), unit, limitToInt(range)))
    value = static_cast<int>(toNumber(found));
}

void Parameters::vector(const char* name, Vec3& value, const char* unit, Range range) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (found.getType() != XmlRpc::XmlRpcValue::TypeArray || found.size() != 3)
    return wrongType(name, found, "a list of three numbers");
  Vec3 read;
  for (int i = 0; i < 3; ++i) {
    if (!isNumber(found[i])) return wrongType(name, found, "a list of three numbers");
    read[i] = toNumber(found[i]);
    if (!inRange(std::string(name) + "_" + "xyz"[i], read[i], unit, range)) return;
  }
  value = read;
}

void Parameters::choice(const char* name, int& value, const std::vector<std::string>& names) {
  std::string word;
  text(name, word);
  if (word.empty()) return;
  std::string allowed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) {
      value = static_cast<int>(i);
      return;
    }
    allowed += (i ? ", " : "") + names[i];
  }
  faults_.add(handle_.resolveName(name) + " = " + inQuotes(word) + " is none of " + allowed);
}

void Parameters::text(const char* name, std::string& value) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (found.getType() != XmlRpc::XmlRpcValue::TypeString) return wrongType(name, found, "text");
  value = static_cast<std::string>(found);
}

void Parameters::frame(const char* name, std::string& value, bool may_be_empty) {
  text(name, value);
  if (value.empty() && !may_be_empty) fault(name, "= '' is empty");
  if (!value.empty() && value[0] == '/') fault(name, "= " + inQuotes(value) + " begins with '/'");
}

void Parameters::frames(const char* name, std::vector<std::string>& values, std::size_t most) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  std::vector<XmlRpc::XmlRpcValue> lists{found};
  if (found.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    lists.clear();
    for (const auto& robot : found) lists.push_back(robot.second);
  }
  std::set<std::string> read;
  for (XmlRpc::XmlRpcValue& list : lists) {
    if (list.getType() != XmlRpc::XmlRpcValue::TypeArray)
      return wrongType(name, found, "a list of frames");
    for (int i = 0; i < list.size(); ++i) {
      if (list[i].getType() != XmlRpc::XmlRpcValue::TypeString)
        return wrongType(name, found, "a list of frames");
      const std::string frame = static_cast<std::string>(list[i]);
      if (frame.empty() || frame[0] == '/')
        fault(name, "has " + inQuotes(frame) + ", which is empty or begins with '/'");
      if (!read.insert(frame).second) fault(name, "has " + inQuotes(frame) + " twice");
      values.push_back(frame);
    }
  }
  if (values.size() > most)
    fault(name,
          "has " + std::to_string(values.size()) + " entries, allowed are " + std::to_string(most));
}

void Parameters::flag(const char* name, bool& value) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (found.getType() != XmlRpc::XmlRpcValue::TypeBoolean)
    return wrongType(name, found, "true or false");
  value = static_cast<bool>(found);
}

bool Parameters::list(const char* name, YAML::Node& map) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return false;
  const YAML::Node value = toYaml(found);
  YAML::Node all(YAML::NodeType::Sequence);
  if (value.IsSequence()) appendEntries(value, all);
  if (value.IsMap())
    for (const auto& robot : value) appendEntries(robot.second, all);
  map = YAML::Node(YAML::NodeType::Map);
  map[name] = value.IsScalar() ? value : all;
  return true;
}

bool Parameters::map(const char* name, YAML::Node& map) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return false;
  if (found.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    wrongType(name, found, "a map");
    return false;
  }
  map = toYaml(found);
  return true;
}

void Parameters::seed(const char* name, std::uint64_t& value) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  std::string digits = shown(found);
  if (found.getType() == XmlRpc::XmlRpcValue::TypeString) digits = static_cast<std::string>(found);
  std::istringstream in(digits);
  std::uint64_t read;
  if (!digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos && in >> read)
    value = read;
  else
    wrongType(name, found, "a whole number from 0 to 2^64 - 1");
}

void Parameters::integers(const char* name, std::vector<int>& values, Range range) {
  XmlRpc::XmlRpcValue found;
  if (!find(name, found)) return;
  if (found.getType() != XmlRpc::XmlRpcValue::TypeArray)
    return wrongType(name, found, "a list of whole numbers");
  std::vector<int> read;
  for (int i = 0; i < found.size(); ++i) {
    if (!isWhole(found[i])) return wrongType(name, found, "a list of whole numbers");
    if (!inRange(name, toNumber(found[i]), "", limitToInt(range))) return;
    read.push_back(static_cast<int>(toNumber(found[i])));
  }
  values = read;
}

void Parameters::finish() {
  std::vector<std::string> names;
  handle_.getParamNames(names);
  const std::string prefix = handle_.getNamespace() + "/";
  std::string known;
  for (const std::string& name : asked_) known += (known.empty() ? "" : ", ") + name;
  for (const std::string& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string key = name.substr(prefix.size());
    if (asked_.count(key.substr(0, key.find('/')))) continue;
    faults_.add(name + " is not a known parameter; known are " + known);
  }
  faults_.throwIfAny();
}

}  // namespace vegetation_sim
