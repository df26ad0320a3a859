// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Leaves and stems of plants that bodies have pushed.
#include <cstdlib>
#include <string>

#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::canopy {
namespace {

constexpr int LARGEST_UNITS = static_cast<int>(LARGEST_LEAN / LEAN_UNIT + 1.0);

}  // namespace

void Foliage::checkBent(const std::vector<BentCell>& cells) const {
  Faults faults;
  if (cells.size() > MOST_CLUSTERS)
    faults.add("state: bent has " + std::to_string(cells.size()) + " cells, allowed are " +
               std::to_string(MOST_CLUSTERS));
  faults.throwIfAny();
  std::uint64_t least = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const BentCell& bent = cells[i];
    const std::string name = "state: bent[" + std::to_string(i) + "]";
    const std::uint64_t place = bent.plant * std::uint64_t{1U << 16U} + bent.cell;
    if (bent.plant >= layout_.plants.size()) {
      faults.add(name + ": plant = " + std::to_string(bent.plant) + " is unknown; there are " +
                 std::to_string(layout_.plants.size()));
      continue;
    }
    const Plant& plant = layout_.plants[bent.plant];
    const std::size_t count = fibresOf(layout_.kinds[plant.kind], plant).cells();
    if (bent.cell >= count)
      faults.add(name + ": cell = " + std::to_string(bent.cell) + " is unknown; there are " +
                 std::to_string(count));
    if (place < least) faults.add(name + ": plants and cells do not rise");
    least = place + 1;
    for (const int lean : {bent.x, bent.y})
      if (std::abs(lean) > LARGEST_UNITS)
        faults.add(
            rangeFault(name + ": lean", LEAN_UNIT * lean, "rad", {-LARGEST_LEAN, LARGEST_LEAN}));
  }
  faults.throwIfAny();
}

void Foliage::setBent(const std::vector<BentCell>& cells) {
  bent_.clear();
  for (const BentCell& bent : cells) {
    BentPlant& plant = bent_[bent.plant];
    if (plant.leans.empty()) {
      const Plant& rest = layout_.plants[bent.plant];
      plant.fibres = fibresOf(layout_.kinds[rest.kind], rest);
      plant.leans.resize(plant.fibres.cells());
    }
    plant.leans[bent.cell] = {LEAN_UNIT * bent.x, LEAN_UNIT * bent.y};
  }
}

// Parts below the feet of the fibres, such as a trunk, do not move.
Foliage::Turn Foliage::turnAt(const BentPlant& plant, const Vec3& anchor) {
  Turn out{plant.fibres.foot, {}};
  out.foot.x() = anchor.x();
  out.foot.y() = anchor.y();
  if (anchor.z() >= out.foot.z()) out.turn = leanTurn(leanAt(plant.fibres, plant.leans, anchor));
  return out;
}

Vec3 Foliage::bend(const Vec3& point, std::size_t plant) const {
  const auto bent = bent_.find(plant);
  return bent == bent_.end() ? point : turnAt(bent->second, point).of(point);
}

}  // namespace vegetation_sim::canopy
