// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/octomap_writer.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

constexpr float OCCUPIED = 2.0F;        // log odds, above the threshold of a binary octree
constexpr double HALF_CELLS = 32768.0;  // from the origin to the border of an octree

struct Wood {
  Vec3 base, axis;
  double length, base_radius, tip_radius;
};

class OctomapWriter {
 public:
  explicit OctomapWriter(const OctomapRule& rule) : rule_(rule), tree_(rule.resolution) {}

  void add(const Wood& wood) {
    // The boxes of short pieces hold few cells without wood.
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(wood.length / (8.0 * rule_.resolution))));
    for (int i = 0; i < pieces; ++i)
      addPiece(wood, wood.length * i / pieces, wood.length * (i + 1) / pieces);
  }

  std::uint64_t write(std::ostream& out) {
    const std::uint64_t cells = tree_.size() == 0 ? 0 : tree_.getNumLeafNodes();
    tree_.updateInnerOccupancy();
    tree_.prune();
    tree_.writeBinaryConst(out);
    return cells;
  }

 private:
  // Adds the cells whose middle is near enough to the axis between two places along it.
  void addPiece(const Wood& wood, double from, double to) {
    const double slope =
        wood.length > 0.0 ? (wood.tip_radius - wood.base_radius) / wood.length : 0.0;
    // Farthest place of a cell from its middle, seen along the normal of the bark.
    const double room = 0.5 * std::sqrt(3.0 * (1.0 + slope * slope)) * rule_.resolution;
    const double reach = std::max(wood.base_radius + slope * from, wood.base_radius + slope * to);
    const Vec3 a = wood.base + from * wood.axis, b = wood.base + to * wood.axis;
    const Cells low = cellsAt(a.cwiseMin(b), -reach - room);
    const Cells high = cellsAt(a.cwiseMax(b), reach + room);
    count(low, high);
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) {
          const Vec3 middle = rule_.resolution * Vec3(x + 0.5, y + 0.5, z + 0.5);
          const double along = std::clamp(dot(middle - wood.base, wood.axis), from, to);
          const double distance = length(middle - wood.base - along * wood.axis);
          if (distance <= wood.base_radius + slope * along + room) occupy(x, y, z);
        }
  }

  using Cells = std::array<int, 3>;
  Cells cellsAt(const Vec3& place, double more) const {
    Cells out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double cell = std::floor((place[static_cast<int>(i)] + more) / rule_.resolution);
      if (!(std::fabs(cell) < HALF_CELLS - 1.0))
        throw InvalidInput("the octree ends " + std::to_string(HALF_CELLS * rule_.resolution) +
                           " m from the origin, and a branch is beyond: ask for larger cells");
      out[i] = static_cast<int>(cell);
    }
    return out;
  }

  void count(const Cells& low, const Cells& high) {
    std::uint64_t cells = 1;
    for (std::size_t i = 0; i < 3; ++i) cells *= static_cast<std::uint64_t>(high[i] - low[i] + 1);
    examined_ += cells;
    if (examined_ > rule_.most_cells)
      throw InvalidInput("more than " + std::to_string(rule_.most_cells) +
                         " cells are near the branches: ask for thicker ones or larger cells");
  }

  void occupy(int x, int y, int z) {
    const auto key = [](int cell) {
      return static_cast<octomap::key_type>(cell + static_cast<int>(HALF_CELLS));
    };
    tree_.setNodeValue(octomap::OcTreeKey(key(x), key(y), key(z)), OCCUPIED, true);
  }

  const OctomapRule rule_;
  octomap::OcTree tree_;
  std::uint64_t examined_{0};
};

}  // namespace

void check(const OctomapRule& rule, Faults& faults) {
  if (!(rule.resolution >= 0.01 && rule.resolution <= 10.0))
    faults.add("resolution = " + std::to_string(rule.resolution) + " m is outside [0.01, 10]");
}

std::uint64_t writeOctomap(const Layout& layout, const terrain::HeightMap& terrain,
                           const OctomapRule& rule, std::ostream& out) {
  OctomapWriter writer(rule);
  for (std::uint32_t id = 0; id < layout.treeCount(); ++id) {
    const Tree tree = growTree(layout, id, terrain);
    for (std::size_t i = 0; i < tree.skeleton.branches.size(); ++i) {
      const Branch& branch = tree.skeleton.branches[i];
      if (i > 0 && branch.base_radius < rule.thinnest) continue;
      writer.add({tree.foot + branch.rest.position, axisZ(branch.rest.orientation), branch.length,
                  branch.base_radius, branch.tip_radius});
    }
  }
  return writer.write(out);
}

}  // namespace vegetation_sim::forest
