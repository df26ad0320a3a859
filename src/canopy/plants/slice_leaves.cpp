// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/slice_leaves.h"

#include <algorithm>
#include <array>
#include <string>

#include "canopy/plants/form_hash.h"
#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr int MOST_CELLS = 4096;   // limit along a side
constexpr double LEAF_SIZE = 2.2;  // size of a leaf over that of its cell
constexpr double COVERED = 0.09;   // share of light that each covered side removes

struct Cell {
  int column, row, slice;
};

constexpr std::array<Cell, 6> SIDES_OF_A_CELL{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

void check(const SliceStack& stack, Faults& faults) {
  std::size_t cells = 1;
  for (const int size : {stack.columns, stack.rows, stack.slices}) {
    if (size < 1 || size > MOST_CELLS)
      faults.add("slices: a size of " + std::to_string(size) + " is outside 1 to " +
                 std::to_string(MOST_CELLS));
    cells *= static_cast<std::size_t>(std::max(0, std::min(size, MOST_CELLS)));
  }
  if (stack.density.size() != cells)
    faults.add("slices: " + std::to_string(stack.density.size()) + " samples, not " +
               std::to_string(cells));
  for (const double value : stack.density)
    if (!(value >= 0.0 && value <= 1.0))
      return faults.add("slices: density = " + std::to_string(value) + " is outside 0 to 1");
}

class Stack {
 public:
  Stack(const SliceStack& stack, double solid) : stack_(stack), solid_(solid) {}

  double density(const Cell& c) const {
    if (c.column < 0 || c.row < 0 || c.slice < 0 || c.column >= stack_.columns ||
        c.row >= stack_.rows || c.slice >= stack_.slices)
      return 0.0;
    return stack_
        .density[(static_cast<std::size_t>(c.slice) * stack_.rows + c.row) * stack_.columns +
                 c.column];
  }
  bool isSolid(const Cell& c) const { return density(c) >= solid_; }
  int covered(const Cell& c) const {
    int out = 0;
    for (const Cell& d : SIDES_OF_A_CELL)
      out += isSolid({c.column + d.column, c.row + d.row, c.slice + d.slice}) ? 1 : 0;
    return out;
  }
  // Slices are perpendicular to y; the first is nearest to a viewer in the direction of -y.
  Vec3 place(const Cell& c) const {
    const double cell = 1.0 / stack_.rows, width = stack_.columns * cell;
    return {(c.column + 0.5) * cell - 0.5 * width, ((c.slice + 0.5) / stack_.slices - 0.5) * width,
            1.0 - (c.row + 0.5) * cell};
  }
  Leaf leafAt(const Cell& c, const Random& random) const {
    Leaf out;
    const Vec3 outward = Vec3(place(c) - Vec3(0.0, 0.0, 0.5));
    const Vec3 jitter(random.uniform(0, -0.8, 0.8), random.uniform(1, -0.8, 0.8),
                      random.uniform(2, -0.3, 0.8));
    const double size = LEAF_SIZE / stack_.rows;
    const Vec3 way = Vec3(outward + jitter);
    const Vec3 along = way * (size / std::max(1e-9, length(way)));
    const Vec3 across = cross(along, Vec3(random.uniform(3, -1.0, 1.0), 0.3, 1.0));
    const Vec3 off(random.uniform(5, -0.5, 0.5), random.uniform(6, -0.5, 0.5),
                   random.uniform(7, -0.5, 0.5));
    const double across_slices = static_cast<double>(stack_.columns) / stack_.slices;
    out.anchor = place(c);
    out.root = out.anchor + Vec3(off.x(), off.y() * across_slices, off.z()) / stack_.rows;
    out.tip = out.root + along;
    out.side = across * (0.35 * size / std::max(1e-9, length(across)));
    out.tip_width = 0.3F;
    out.shade = static_cast<float>(saturate(density(c) * random.uniform(4, 0.5, 1.0)));
    out.light = static_cast<float>(1.0 - COVERED * covered(c));
    return out;
  }

 private:
  const SliceStack& stack_;
  double solid_;
};

}  // namespace

Form formOf(const SliceStack& slices, double solid) {
  Faults faults;
  check(slices, faults);
  faults.throwIfAny();
  const Stack stack(slices, solid);
  const Random random(0x736c696365);
  Form out;
  std::uint64_t number = 0;
  for (int slice = 0; slice < slices.slices; ++slice)
    for (int row = 0; row < slices.rows; ++row)
      for (int column = 0; column < slices.columns; ++column, ++number) {
        const Cell cell{column, row, slice};
        if (!stack.isSolid(cell) || stack.covered(cell) == 6) continue;
        if (out.leaves.size() == MOST_LEAVES)
          throw InvalidInput("slices: more than the " + std::to_string(MOST_LEAVES) +
                             " solid cells allowed");
        out.leaves.push_back(stack.leafAt(cell, random.child(number)));
      }
  if (out.leaves.empty())
    throw InvalidInput("slices: no cell has a density of " + std::to_string(solid) + " or more");
  finish(out);
  return out;
}

}  // namespace vegetation_sim::canopy
