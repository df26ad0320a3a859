// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/yaml.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <type_traits>

#include "core/config/files.h"

namespace vegetation_sim {
namespace {

constexpr std::uintmax_t LARGEST_FILE = 4u << 20;
// Limit of the separators , : [ { ? and line ends of a text in a message: a parsed value takes some
// hundred bytes.
constexpr std::size_t MOST_MARKS = 200000;
// Limit of values within values; yaml-cpp 0.6 has none and its stack ends.
constexpr std::size_t MOST_DEPTH = 100;

// Each value has a mark before or after it, so this is a bound of the number of values.
std::size_t countMarks(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return std::strchr(",:[{?\n", c) != nullptr; }));
}

// Returns a bound of how deep values lie within values by brackets, or by dashes in one line. Those
// that lie deep by indentation alone take the square of their depth in bytes.
std::size_t boundDepth(const std::string& text) {
  std::size_t open = 0, dashes = 0, out = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (c == '\n') dashes = 0;
    if ((c == '-' || c == '?') && i + 1 < text.size() && std::isspace(text[i + 1])) ++dashes;
    out = std::max(out, open + dashes);
  }
  return out;
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return inQuotes(node.Scalar());
  return node.IsMap() ? "a map" : node.IsSequence() ? "a list" : "nothing";
}

YAML::Node parse(const std::string& text, const std::string& name) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InvalidInput(name + ": not YAML: " + error.what());
  }
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
    // yaml-cpp 0.6 reads negative numbers as unsigned ones.
    if (std::is_unsigned_v<T> && node.IsScalar() && node.Scalar().find('-') != std::string::npos)
      throw YAML::BadConversion(node.Mark());
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
  fault(name, "= " + inQuotes(word) + " is none of " + allowed);
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

std::vector<YamlSection> YamlSection::sections(const char* name, std::size_t most) {
  asked_.insert(name);
  std::vector<YamlSection> out;
  if (!has(name)) return out;
  const YAML::Node list = node_[name];
  if (!list.IsSequence()) {
    fault(name, "= " + shown(list) + " is not a list");
    return out;
  }
  if (list.size() > most) {
    fault(name, "has " + std::to_string(list.size()) + " entries, more than the " +
                    std::to_string(most) + " allowed");
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
      fault(shortened(entry.first.Scalar()), "is given twice");
  std::string known;
  for (const auto& name : asked_) known += (known.empty() ? "" : ", ") + name;
  for (const auto& entry : node_) {
    if (faults_->isFull()) return;  // a text of a message may have any number of keys
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "(not a word)";
    if (asked_.count(key)) continue;
    fault(shortened(key), "is not a known key; known are " + known);
  }
}

bool keepLimits(const char* what, const std::vector<NamedText>& texts, Faults& faults) {
  bool out = true;
  std::size_t sum = 0;
  const auto add = [&](const std::string& fault) {
    faults.add(what + fault);
    out = false;
  };
  for (const auto& [name, text] : texts) {
    sum += text.size();
    if (name.size() > LONGEST_YAML_NAME)
      add(" " + inQuotes(name) + ": name has " + std::to_string(name.size()) +
          " letters, more than the " + std::to_string(LONGEST_YAML_NAME) + " allowed");
  }
  if (sum > LARGEST_YAML_TEXT)
    add(": rules have " + std::to_string(sum) + " bytes together, more than the " +
        std::to_string(LARGEST_YAML_TEXT) + " allowed");
  return out;
}

YAML::Node parseYaml(const std::string& text, const std::string& name) {
  if (text.size() > LARGEST_YAML_TEXT)
    throw InvalidInput(name + ": " + std::to_string(text.size()) + " bytes, more than the " +
                       std::to_string(LARGEST_YAML_TEXT) + " allowed");
  if (const std::size_t marks = countMarks(text); marks > MOST_MARKS)
    throw InvalidInput(name + ": " + std::to_string(marks) +
                       " signs that separate values, more than the " + std::to_string(MOST_MARKS) +
                       " allowed");
  if (const std::size_t depth = boundDepth(text); depth > MOST_DEPTH)
    throw InvalidInput(name + ": values lie " + std::to_string(depth) + " deep, more than the " +
                       std::to_string(MOST_DEPTH) + " allowed");
  return parse(text, name);
}

YAML::Node loadYamlFile(const std::string& file) {
  return parse(readFile(file, LARGEST_FILE), file);
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
