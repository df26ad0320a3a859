// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/terrain/height_map.h"
#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::forest {

/// The permanent data of one tree (S1-04).
struct TreeSeed {
  std::uint64_t seed{0};        ///< key of all random numbers of the tree
  std::uint16_t species{0};     ///< index into Layout::species
  Vec3 position{Vec3::Zero()};  ///< foot of the trunk, z above the terrain [m]
  double yaw{0.0};              ///< [rad]
  double scale{1.0};            ///< over the species' size, 0.05 to 20
};
static_assert(sizeof(TreeSeed) == 56, "S1-05: a unique tree takes less than 1 kB");

/// A square of forest by rule: tree i is a pure function of this record and i.
struct Tile {
  std::uint32_t first_tree{0}, count{0};
  std::uint64_t seed{0};
  double x{0.0}, y{0.0};   ///< south-west corner [m]
  double size{10.0};       ///< edge [m]
  std::vector<float> mix;  ///< relative weight of each species
};

/// `paper`: Rz(th) Ry(ph) of paper 1, fig. 1; `swing`: rest rotation, then an isotropic bend (E4).
enum class JointModel : int { SWING = 0, PAPER = 1 };
/// Angle per wind: static compliance of the sub-tree, or L z / m as printed (equations 1 and 2).
enum class Gain : int { COMPLIANCE = 0, PAPER = 1 };
/// Force per wind: proportional to the speed (superposition is exact), or to its square.
enum class Drag : int { LINEAR = 0, QUADRATIC = 1 };
enum class TransitionShape : int { SMOOTH = 0, LINEAR = 1 };

/// Bounds of the scale of trees in tiles.
constexpr double SMALLEST_TILED_SCALE = 0.7, LARGEST_TILED_SCALE = 1.3;
/// Maximum number of trees of a layout.
constexpr std::uint32_t MOST_TREES = 1u << 24;

/// How every tree of a layout moves. Replicas share it.
struct MotionLaw {
  JointModel joint_model{JointModel::SWING};
  Gain gain{Gain::COMPLIANCE};
  Drag drag{Drag::LINEAR};
  double transition{1.0};  ///< duration of a change of level (S1-45) [s]
  TransitionShape transition_shape{TransitionShape::SMOOTH};
};
void describe(FieldVisitor& visitor, MotionLaw& law);

/// A forest, from which every tree can be rebuilt.
struct Layout {
  std::vector<Species> species;
  MotionLaw motion;
  std::string terrain;  ///< file of the height map; empty: flat
  std::uint64_t terrain_hash{
      0};  ///< of its samples, so that replicas check that they stand on the same terrain
  std::vector<TreeSeed> trees;  ///< ids 0, 1, 2 ...
  std::vector<Tile> tiles;      ///< their ids follow

  std::uint32_t treeCount() const;
  std::uint64_t hash() const;
};

/// Adds a fault for each value out of range, unknown species, gap in ids, and for more than
/// MOST_TREES trees.
void check(const Layout& layout, Faults& faults);

/// Returns the seed of a tree. @throws std::out_of_range for an unknown id.
TreeSeed seedOf(const Layout& layout, std::uint32_t tree);
TreeSeed seedInTile(const Tile& tile, std::uint32_t index);
/// Returns the trees of a tile that may stand within `radius` of a point, sorted. A tile has one
/// tree in each cell of a square grid, row by row, so other cells are not visited.
std::vector<std::uint32_t> findTreesInTile(const Tile& tile, const Vec3& point, double radius);

/// Returns the ids of all trees that may reach into a ball, sorted. It compares bounds of sizes
/// only.
std::vector<std::uint32_t> findTreesNear(const Layout& layout, const terrain::HeightMap& terrain,
                                         const Vec3& centre, double radius);

/// Returns the foot of a tree in the world [m]: the position of its seed on the terrain.
Vec3 footOf(const TreeSeed& seed, const terrain::HeightMap& terrain);

/// Reads the `forest` section of a scenario. File names are relative to `folder`; rows along a
/// slope are spaced on `ground`.
Layout readLayout(YamlSection section, const std::string& folder, const terrain::HeightMap& ground,
                  std::uint64_t seed, Faults& faults);

}  // namespace vegetation_sim::forest
