// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/yaml.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace vegetation_sim {
namespace {

constexpr std::uintmax_t LARGEST_FILE = 4u << 20;

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return node.IsMap() ? "a map" : node.IsSequence() ? "a list" : "nothing";
}

}  // namespace

YamlSection::YamlSection(const YAML::Node& node, std::string path, Faults& faults)
    : node_(node), path_(std::move(path)), faults_(&faults) {
  if (node_.IsDefined() && !node_.IsNull() && !node_.IsMap()) {
    faults_->add(path_ + ": " + shown(node_) + " is not a map of keys");
    node_ = YAML::Node();
  }
}

bool YamlSection::has(const std::string& key) const {
  return node_.IsMap() && static_cast<const YAML::Node&>(node_)[key].IsDefined();
}

void YamlSection::fault(const std::string& name, const std::string& problem) {
  faults_->add(path_ + ": " + name + " " + problem);
}

void YamlSection::fault(const std::string& problem) {
  faults_->add(path_ + ": " + problem);
}

template <class T>
bool YamlSection::read(const char* name, const char* type, T& value) {
  asked_.insert(name);
  if (!has(name)) return false;
  const YAML::Node node = node_[name];
  try {
    value = node.as<T>();
    return true;
  } catch (const YAML::Exception&) {
    fault(name, "= " + shown(node) + " is not " + type);
    return false;
  }
}

void YamlSection::number(const char* name, double& value, const char* unit, Range range) {
  double read_value;
  if (!read(name, "a number", read_value)) return;
  const std::string problem = rangeFault(path_ + ": " + name, read_value, unit, range);
  if (problem.empty())
    value = read_value;
  else
    faults_->add(problem);
}

void YamlSection::integer(const char* name, int& value, const char* unit, Range range) {
  int read_value;
  if (!read(name, "a whole number", read_value)) return;
  const std::string problem = rangeFault(path_ + ": " + name, read_value, unit, range);
  if (problem.empty())
    value = read_value;
  else
    faults_->add(problem);
}

void YamlSection::vector(const char* name, Vec3& value, const char* unit, Range range) {
  std::vector<double> list;
  if (!read(name, "a list of three numbers", list)) return;
  if (list.size() != 3)
    return fault(name, "has " + std::to_string(list.size()) + " numbers; 3 are expected");
  const Vec3 read_value(list[0], list[1], list[2]);
  for (int i = 0; i < 3; ++i) {
    const std::string problem =
        rangeFault(path_ + ": " + name + "[" + std::to_string(i) + "]", read_value[i], unit, range);
    if (!problem.empty()) return faults_->add(problem);
  }
  value = read_value;
}

void YamlSection::choice(const char* name, int& value, const std::vector<std::string>& names) {
  std::string word;
  if (!read(name, "a word", word)) return;
  std::string allowed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) {
      value = static_cast<int>(i);
      return;
    }
    allowed += (i ? ", " : "") + names[i];
  }
  fault(name, "= '" + word + "' is none of " + allowed);
}

void YamlSection::text(const char* name, std::string& value) {
  read(name, "text", value);
}

void YamlSection::flag(const char* name, bool& value) {
  read(name, "true or false", value);
}

void YamlSection::seed(const char* name, std::uint64_t& value) {
  read(name, "a whole number from 0 to 2^64 - 1", value);
}

YamlSection YamlSection::section(const char* name) {
  asked_.insert(name);
  return YamlSection(has(name) ? node_[name] : YAML::Node(), path_ + ": " + name, *faults_);
}

std::vector<YamlSection> YamlSection::sections(const char* name) {
  asked_.insert(name);
  std::vector<YamlSection> out;
  if (!has(name)) return out;
  const YAML::Node list = node_[name];
  if (!list.IsSequence()) {
    fault(name, "= " + shown(list) + " is not a list");
    return out;
  }
  for (std::size_t i = 0; i < list.size(); ++i)
    out.emplace_back(list[i], path_ + ": " + name + "[" + std::to_string(i) + "]", *faults_);
  return out;
}

void YamlSection::finish() {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_)
    if (entry.first.IsScalar() && !seen.insert(entry.first.Scalar()).second)
      fault(entry.first.Scalar(), "is given twice");
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "(not a word)";
    if (asked_.count(key)) continue;
    std::string known;
    for (const auto& name : asked_) known += (known.empty() ? "" : ", ") + name;
    fault(key, "is not a known key; known are " + known);
  }
}

YAML::Node parseYaml(const std::string& text, const std::string& name) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InvalidInput(name + ": not YAML: " + error.what());
  }
}

YAML::Node loadYamlFile(const std::string& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InvalidInput(file + ": cannot be read: " + error.message());
  if (size > LARGEST_FILE)
    throw InvalidInput(file + ": " + std::to_string(size) +
                       " bytes, more than the 4194304 allowed");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InvalidInput(file + ": cannot be read");
  return parseYaml(text.str(), file);
}

void YamlFieldWriter::number(const char* name, double& value, const char*, Range) {
  out_ << YAML::Key << name << YAML::Value << YAML::DoublePrecision(17) << value;
}

void YamlFieldWriter::integer(const char* name, int& value, const char*, Range) {
  out_ << YAML::Key << name << YAML::Value << value;
}

void YamlFieldWriter::vector(const char* name, Vec3& value, const char*, Range) {
  out_ << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginSeq
       << YAML::DoublePrecision(17) << value.x() << value.y() << value.z() << YAML::EndSeq;
}

void YamlFieldWriter::choice(const char* name, int& value, const std::vector<std::string>& names) {
  out_ << YAML::Key << name << YAML::Value << names.at(static_cast<std::size_t>(value));
}

}  // namespace vegetation_sim
