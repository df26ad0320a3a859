// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/species.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/math/growth_stage.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

/// Clamps each field into its range.
class FieldClamper : public FieldVisitor {
 public:
  void number(const char*, double& value, const char*, Range range) override {
    value = std::min(range.high, std::max(range.low, value));
  }
  void integer(const char*, int&, const char*, Range) override {}
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char*, int&, const std::vector<std::string>&) override {}
};

}  // namespace

void describe(FieldVisitor& v, Species& s) {
  v.number("height", s.height, "m", {0.1, 100.0});
  v.number("height_variation", s.height_variation, "", {0.0, 0.9});
  v.number("trunk_radius", s.trunk_radius, "m", {0.001, 5.0});
  v.number("twig_radius", s.twig_radius, "m", {1e-4, 1.0});
  v.number("slenderness", s.slenderness, "", {5.0, 5000.0});
  v.number("lean", s.lean, "rad", {0.0, 1.0});
  v.number("angle_thin", s.angle_thin, "rad", {0.0, 2.8});
  v.number("angle_thick", s.angle_thick, "rad", {0.0, 2.8});
  v.number("noise", s.noise, "", {0.0, 3.0});
  v.number("youngs_modulus", s.youngs_modulus, "Pa", {1e6, 1e12});
  v.number("density", s.density, "kg/m^3", {50.0, 3000.0});
  v.number("damping_ratio", s.damping_ratio, "", {0.0, 2.0});
  v.number("drag_coefficient", s.drag_coefficient, "", {0.0, 5.0});
  v.number("reference_speed", s.reference_speed, "m/s", {0.1, 100.0});
  v.number("leaf_size", s.leaf_size, "m", {0.001, 5.0});
  v.number("leaf_area", s.leaf_area, "m^2", {0.0, 10.0});
  v.number("leaf_mass", s.leaf_mass, "kg", {0.0, 10.0});
  v.number("flutter", s.flutter, "rad", {0.0, 1.5});
  v.choice("leaf_shape", s.leaf_shape, {"broad", "needle", "small", "long"});
  v.vector("leaf_colour", s.leaf_colour, "", {0.0, 1.0});
  v.vector("leaf_colour_young", s.leaf_colour_young, "", {0.0, 1.0});
  v.vector("bark_colour", s.bark_colour, "", {0.0, 1.0});
  v.vector("twig_colour", s.twig_colour, "", {0.0, 1.0});
}

void describeHabit(FieldVisitor& v, Species& s) {
  v.number("turn", s.turn, "rad", {0.0, PI});
}

void describeStrength(FieldVisitor& v, Species& s) {
  v.number("strength", s.strength, "Pa", {0.0, 1e12});
}

void describeFluid(FieldVisitor& v, Species& s) {
  v.number("fluid_density", s.fluid_density, "kg/m^3", {0.1, 2000.0});
}

void describe(FieldVisitor& v, Design& d) {
  v.number("size", d.size, "", {0.2, 3.0});
  v.number("children", d.children, "", {0.2, 3.0});
  v.number("leaves", d.leaves, "", {0.0, 3.0});
  v.number("angle", d.angle, "", {0.2, 2.0});
  v.number("noise", d.noise, "", {0.0, 3.0});
}

void describe(FieldVisitor& v, TreeFactors& f) {
  v.number("stiffness", f.stiffness, "", {0.01, 100.0});
  v.number("damping", f.damping, "", {0.0, 20.0});
  v.number("wind", f.wind, "", {0.0, 20.0});
}

double largestAngle(const Species& s, double relative_diameter) {
  return s.angle_thin + (s.angle_thick - s.angle_thin) * saturate(relative_diameter);
}

double sizeBound(const Species& species) {
  double chain = 1.0, sum = 1.0;
  for (std::size_t depth = 1; depth < species.limbs.size(); ++depth) {
    const LimbRule& rule = species.limbs[depth];
    chain *= rule.length * (1.0 + rule.length_variation);
    sum += chain;
  }
  return species.height * (1.0 + species.height_variation) * sum;
}

double expectedBranches(const Species& species) {
  double limbs = 1.0, branches = 0.0;
  for (int depth = 0; depth < species.depths(); ++depth) {
    const LimbRule& rule = species.limbs[static_cast<std::size_t>(depth)];
    if (depth > 0) limbs *= rule.children;
    branches += limbs * rule.segments;
  }
  return branches;
}

void check(Species species, Faults& faults) {
  const std::string context = "species " + shortened(species.name) + ": ";
  if (species.name.empty()) faults.add("species: name is empty");
  if (species.name.size() > LONGEST_YAML_NAME)
    faults.add(context + "name has " + std::to_string(species.name.size()) +
               " letters, more than the " + std::to_string(LONGEST_YAML_NAME) + " allowed");
  if (species.limbs.empty() || species.depths() > MAX_DEPTHS) {
    faults.add(context + "limbs has " + std::to_string(species.limbs.size()) +
               " rules, outside 1 to " + std::to_string(MAX_DEPTHS));
    return;
  }
  FieldChecker checker(context, faults);
  describe(checker, species);
  describeHabit(checker, species);
  describeStrength(checker, species);
  describeFluid(checker, species);
  for (std::size_t i = 0; i < species.limbs.size(); ++i) {
    LimbRule& rule = species.limbs[i];
    const std::string where = context + "limbs[" + std::to_string(i) + "]: ";
    FieldChecker limb_checker(where, faults);
    describe(limb_checker, rule);
    if (rule.end < rule.start) faults.add(where + "end is below start");
  }
  if (species.angle_thick > species.angle_thin)
    faults.add(context + "angle_thick is above angle_thin");
  if (!faults.empty()) return;
  if (expectedBranches(species) > MAX_BRANCHES)
    faults.add(context + "grows " + std::to_string(static_cast<long>(expectedBranches(species))) +
               " branches, more than the " + std::to_string(MAX_BRANCHES) + " allowed");
}

Species applyDesign(const Species& species, const Design& design) {
  Species out = species;
  out.height *= design.size;
  out.trunk_radius *= design.size;
  out.noise *= design.noise;
  for (std::size_t depth = 0; depth < out.limbs.size(); ++depth) {
    LimbRule& rule = out.limbs[depth];
    if (depth > 0) rule.children *= design.children;
    rule.leaves *= design.leaves;
    rule.angle_low *= design.angle;
    rule.angle_high *= design.angle;
  }
  FieldClamper clamper;
  describe(clamper, out);
  for (LimbRule& rule : out.limbs) describe(clamper, rule);
  // Reduces the number of children instead of rejecting a slider value; terminates, because without
  // laterals a trunk remains.
  const double limit = 0.8 * MAX_BRANCHES;
  while (expectedBranches(out) > limit)
    for (LimbRule& rule : out.limbs) rule.children *= 0.95;
  return out;
}

Species applyFactors(const Species& species, const TreeFactors& factors) {
  Species out = species;
  out.youngs_modulus *= factors.stiffness;
  out.damping_ratio *= factors.damping;
  out.drag_coefficient *= factors.wind;
  std::ostringstream name;
  name << species.name << " (stiffness " << factors.stiffness << ", damping " << factors.damping
       << ", wind " << factors.wind << ")";
  out.name = name.str();
  return out;
}

Species applyStage(const Species& species, double stage) {
  if (!(stage < GROWN)) return species;
  const GrowthFactors factors = growthFactors(stage);
  Species out = species;
  out.height *= factors.height;
  out.trunk_radius *= factors.thickness;
  out.twig_radius *= factors.thickness;
  out.leaf_size *= factors.leaf;
  out.leaf_area *= factors.leaf * factors.leaf;
  out.leaf_mass *= factors.leaf * factors.leaf;
  for (std::size_t depth = 0; depth < out.limbs.size(); ++depth) {
    if (depth > 0) out.limbs[depth].children *= factors.count;
    out.limbs[depth].leaves *= factors.count;
  }
  FieldClamper clamper;
  describe(clamper, out);
  return out;
}

Species readSpecies(YamlSection section) {
  Species species;
  section.text("name", species.name);
  describe(section, species);
  describeHabit(section, species);
  describeStrength(section, species);
  describeFluid(section, species);
  std::vector<YamlSection> limbs = section.sections("limbs", MAX_DEPTHS);
  if (!limbs.empty()) species.limbs.clear();
  for (YamlSection& limb : limbs) {
    LimbRule rule;
    describe(limb, rule);
    limb.finish();
    species.limbs.push_back(rule);
  }
  section.finish();
  return species;
}

std::string writeSpecies(const Species& species) {
  Species copy = species;
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "name" << YAML::Value << copy.name;
  YamlFieldWriter writer(out);
  describe(writer, copy);
  describeHabit(writer, copy);
  describeStrength(writer, copy);
  describeFluid(writer, copy);
  out << YAML::Key << "limbs" << YAML::Value << YAML::BeginSeq;
  for (LimbRule& rule : copy.limbs) {
    out << YAML::Flow << YAML::BeginMap;
    describe(writer, rule);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

Species parseSpecies(const std::string& yaml, const std::string& name) {
  Faults faults;
  Species species = readSpecies(YamlSection(parseYaml(yaml, name), name, faults));
  if (faults.empty()) check(species, faults);
  faults.throwIfAny();
  return species;
}

Species loadSpecies(const std::string& file) {
  Faults faults;
  Species species = readSpecies(YamlSection(loadYamlFile(file), file, faults));
  if (species.name.empty()) species.name = std::filesystem::path(file).stem().string();
  if (faults.empty()) check(species, faults);
  if (!faults.empty()) throw InvalidInput(file + ": " + faults.text());
  return species;
}

std::uint64_t hash(const Species& species) {
  Species copy = species;
  Hash out;
  FieldHasher hasher(out);
  out.add(copy.name);
  describe(hasher, copy);
  for (LimbRule& rule : copy.limbs) describe(hasher, rule);
  // A species of the usual habit, that never breaks or is in air keeps the hash that it had before
  // there were others.
  if (copy.turn != Species().turn) describeHabit(hasher, copy);
  if (copy.strength > 0.0) describeStrength(hasher, copy);
  if (copy.fluid_density != AIR_DENSITY) describeFluid(hasher, copy);
  return out.value();
}

}  // namespace vegetation_sim::forest
