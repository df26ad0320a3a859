// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/wind_reader.h"

#include <set>
#include <string>
#include <vector>

#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

constexpr Range STARTS{0.0, 1e9};  // [s] after the start of the node

std::vector<Waypoint> readTrajectory(YamlSection& section) {
  std::vector<Waypoint> points;
  for (YamlSection& entry : section.sections("trajectory")) {
    Waypoint point;
    double t = 0.0;
    for (const char* key : {"t", "position"})
      if (!entry.has(key)) entry.fault(key, "is missing");
    entry.number("t", t, "s", STARTS);
    entry.vector("position", point.position, "m", POSITIONS);
    entry.finish();
    point.stamp = fromSeconds(t);
    points.push_back(point);
  }
  if (!section.has("position")) return points;
  if (!points.empty())
    section.fault("position", "and trajectory are both given; only one is allowed");
  Waypoint point;
  section.vector("position", point.position, "m", POSITIONS);
  return {point};
}

void readTimes(YamlSection& section, Primitive& p) {
  double start = 0.0, end = 0.0;
  section.number("start", start, "s", STARTS);
  section.number("end", end, "s", STARTS);
  p.t_on = p.epoch = fromSeconds(start);
  if (!section.has("end")) return;
  p.t_off = fromSeconds(end);
  if (p.t_off <= p.t_on) section.fault("end", "is not after start");
}

// A breeze with the defaults of flowing water [N11].
const char* const CURRENT = "current";
Primitive makeCurrent() {
  Primitive out;
  out.kind = Kind::BREEZE;
  out.velocity = Vec3(0.3, 0.0, 0.0);
  out.turbulence = 0.1;
  out.length_scale = 3.0;  // as large as the depth of shallow water
  return out;
}

// Returns false if the kind, which decides which keys are allowed, is unknown.
bool readKind(YamlSection& section, Primitive& p) {
  if (!section.has("kind")) section.fault("kind", "is missing");
  std::vector<std::string> names = kindNames();
  const auto current = static_cast<int>(names.size());
  names.emplace_back(CURRENT);
  int kind = -1;
  section.choice("kind", kind, names);
  if (kind < 0) return false;
  if (kind == current)
    p = makeCurrent();
  else
    p.kind = static_cast<Kind>(kind);
  return true;
}

// Reads all fields but the kind, which is known.
class FieldReader : public FieldVisitor {
 public:
  explicit FieldReader(YamlSection& section) : section_(section) {}
  void number(const char* name, double& value, const char* unit, Range range) override {
    section_.number(name, value, unit, range);
  }
  void integer(const char* name, int& value, const char* unit, Range range) override {
    section_.integer(name, value, unit, range);
  }
  void vector(const char* name, Vec3& value, const char* unit, Range range) override {
    section_.vector(name, value, unit, range);
  }
  void choice(const char* name, int& value, const std::vector<std::string>& names) override {
    if (std::string(name) != "kind") section_.choice(name, value, names);
  }

 private:
  YamlSection& section_;
};

Source readSource(YamlSection& section) {
  Source source;
  Primitive& p = source.primitive;
  if (!readKind(section, p)) return source;
  section.text("name", p.name);
  FieldReader fields(section);
  describe(fields, p);
  section.text("attached_frame", source.attached_frame);
  readTimes(section, p);
  p.trajectory = readTrajectory(section);
  section.finish();
  Faults faults;
  if (p.t_off == 0 || p.t_off > p.t_on) check(source, faults);
  for (const std::string& fault : faults.list()) section.fault(fault);
  return source;
}

}  // namespace

std::vector<Source> readWind(YamlSection& section, std::uint64_t& seed) {
  std::vector<Source> sources;
  std::set<std::string> names;
  section.seed("seed", seed);
  for (YamlSection& entry : section.sections("primitives")) {
    sources.push_back(readSource(entry));
    const std::string& name = sources.back().primitive.name;
    if (!name.empty() && !names.insert(name).second)
      entry.fault("name", "= " + inQuotes(name) + " is already in use");
  }
  section.finish();
  return sources;
}

}  // namespace vegetation_sim::wind
