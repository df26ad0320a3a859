// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/canopy_layout.h"

#include <algorithm>
#include <cmath>

#include "canopy/canopy_layout_reader.h"

namespace vegetation_sim::canopy {
namespace {

constexpr std::size_t MOST_HISTORY = 64U << 20;  // [B]

std::string numbered(const char* name, std::size_t index) {
  return std::string(name) + "[" + std::to_string(index) + "]: ";
}

// Layouts without these keys keep the hashes that they had before there were any.
void addPushLaw(PushLaw law, Hash& hash) {
  PushLaw none;
  Hash own, without;
  FieldHasher hasher(own), other(without);
  describe(hasher, law);
  describe(other, none);
  if (own.value() != without.value()) hash.add(own.value());
}

void checkPlants(const Layout& layout, Faults& faults) {
  for (std::size_t i = 0; i < layout.plants.size(); ++i) {
    Plant plant = layout.plants[i];
    FieldChecker checker(numbered("plants", i), faults);
    checker.vector("position", plant.position, "m", PLANT_COORDINATES);
    checker.number("yaw", plant.yaw, "rad", {-1000.0, 1000.0});
    checker.number("scale", plant.scale, "", {0.05, 20.0});
    if (plant.kind >= layout.kinds.size())
      faults.add(numbered("plants", i) + "kind = " + std::to_string(plant.kind) +
                 " is unknown; there are " + std::to_string(layout.kinds.size()));
  }
}

void checkCrowns(const Layout& layout, Faults& faults) {
  for (std::size_t i = 0; i < layout.crowns.size(); ++i) {
    CrownRule crown = layout.crowns[i];
    FieldChecker checker(numbered("crowns", i), faults);
    describe(checker, crown);
    if (crown.kind >= layout.kinds.size())
      faults.add(numbered("crowns", i) + "kind = " + std::to_string(crown.kind) +
                 " is unknown; there are " + std::to_string(layout.kinds.size()));
    else if (isRead(layout.kinds[crown.kind]))
      faults.add(numbered("crowns", i) + "kind = " + inQuotes(layout.kinds[crown.kind].name) +
                 " is read from a file; a crown has leaves that grow");
  }
}

void checkSizes(const Layout& layout, Faults& faults) {
  const auto most = [&](const char* what, std::size_t count, std::size_t limit) {
    if (count > limit)
      faults.add(std::to_string(count) + " " + what + ", more than the " + std::to_string(limit) +
                 " allowed");
  };
  most("kinds", layout.kinds.size(), MOST_KINDS);
  most("plants", layout.plants.size(), MOST_PLANTS);
  if (!faults.empty()) return;
  most("leaves", layout.ownLeafCount(), MOST_LEAVES);
  most("leaves of all plants", layout.leafCount(), MOST_SHOWN_LEAVES);
  const auto cells = static_cast<std::size_t>(layout.motion.fluid.cells);
  most("bytes of history (memory * rate * cells^2 * 4)",
       static_cast<std::size_t>(historyFrames(layout.motion)) * cells * cells * 4, MOST_HISTORY);
}

std::size_t crownLeaves(const Layout& layout) {
  std::size_t out = 0;
  for (const CrownRule& crown : layout.crowns)
    if (crown.kind < layout.kinds.size())
      out += static_cast<std::size_t>(std::max(0, crown.trees)) *
             static_cast<std::size_t>(std::max(0, layout.kinds[crown.kind].leaves));
  return out;
}

}  // namespace

void describe(FieldVisitor& v, CrownRule& c) {
  v.integer("first_tree", c.first_tree, "", {0, 1 << 24});
  v.integer("trees", c.trees, "", {1, 10000});
}

void describe(FieldVisitor& v, Motion& m, const std::function<void(const char*)>& begin) {
  const auto group = [&](const char* name, auto& settings) {
    if (begin) begin(name);
    describe(v, settings);
  };
  group("plane", m.plane);
  group("fluid", m.fluid);
  group("sources", m.sources);
  group("oscillator", m.oscillator);
  group("layers", m.layers);
  group("cuts", m.cuts);
  group("warp", m.warp);
}

FluidSettings fluidOf(const Motion& motion) {
  FluidSettings out = motion.fluid;
  out.width = Plane(motion.plane).width;
  return out;
}

int historyFrames(const Motion& motion) {
  return std::max(2, static_cast<int>(std::ceil(motion.layers.memory * motion.rate)) + 1);
}

std::size_t Layout::leafCount() const {
  std::size_t out = crownLeaves(*this);
  for (const Plant& plant : plants)
    if (plant.kind < kinds.size()) out += canopy::leafCount(kinds[plant.kind]);
  return out;
}

std::size_t Layout::ownLeafCount() const {
  std::size_t out = crownLeaves(*this);
  std::vector<bool> counted(kinds.size(), false);
  for (const Plant& plant : plants) {
    if (plant.kind >= kinds.size()) continue;
    if (!isRead(kinds[plant.kind]) || !counted[plant.kind])
      out += canopy::leafCount(kinds[plant.kind]);
    counted[plant.kind] = true;
  }
  return out;
}

std::uint64_t Layout::hash() const {
  Hash hash;
  FieldHasher hasher(hash);
  Layout copy = *this;
  describe(hasher, copy.motion);
  hash.add(static_cast<std::uint64_t>(copy.motion.rate));
  for (PlantKind& kind : copy.kinds) {
    hash.add(kind.name);
    describe(hasher, kind);
    if (kind.form) hash.add(kind.form->hash);
    addPushLaw(kind.push, hash);
  }
  for (const Plant& plant : plants) {
    hash.add(plant.seed);
    hash.add(static_cast<std::uint64_t>(plant.kind));
    hash.add(plant.position);
    hash.add(plant.yaw);
    hash.add(plant.scale);
  }
  for (const CrownRule& crown : crowns) {
    hash.add(static_cast<std::uint64_t>(crown.kind));
    hash.add(static_cast<std::uint64_t>(crown.first_tree));
    hash.add(static_cast<std::uint64_t>(crown.trees));
  }
  hash.add(seed);
  return hash.value();
}

void check(const Layout& layout, Faults& faults) {
  Motion motion = layout.motion;
  FieldChecker checker("", faults);
  describe(checker, motion);
  checker.integer("rate", motion.rate, "Hz", {1, 240});
  Faults groups;
  if (faults.empty()) {
    check(fluidOf(motion), "fluid: ", groups);
    check(motion.cuts, "cuts: ", groups);
  }
  for (std::size_t i = 0; i < layout.kinds.size(); ++i) {
    PlantKind kind = layout.kinds[i];
    FieldChecker kind_checker(numbered("kinds", i), faults);
    describe(kind_checker, kind);
    describe(kind_checker, kind.push);
    if (kind.push.stiffness > 0.0 && kind.push.stiffness < LEAST_PUSH_STIFFNESS)
      kind_checker.number("push_stiffness above 0", kind.push.stiffness, "N/m^3",
                          {LEAST_PUSH_STIFFNESS, 1e6});
    if (kind.rigid.size() > LONGEST_RIGID_WORDS)
      faults.add(numbered("kinds", i) + "rigid has " + std::to_string(kind.rigid.size()) +
                 " characters, more than the " + std::to_string(LONGEST_RIGID_WORDS) + " allowed");
    if (isRead(kind) == kind.file.empty())
      faults.add(numbered("kinds", i) + "file = " + inQuotes(kind.file) +
                 "; shapes mesh and slices have one, others none");
  }
  for (const std::string& fault : groups.list()) faults.add(fault);
  checkPlants(layout, faults);
  checkCrowns(layout, faults);
  if (faults.empty()) checkSizes(layout, faults);
}

}  // namespace vegetation_sim::canopy
