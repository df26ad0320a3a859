// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/broken_branch.h"

#include <algorithm>
#include <cmath>

#include "core/archive/archive.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::forest {
namespace {

constexpr double FARTHEST = 2e7;  // [m]
constexpr double NORM_ERROR = 0.001;

void limitLength(Vec3& vector, double most) {
  const double size = length(vector);
  if (size > most) vector *= most / size;
}

}  // namespace

void limitMotion(BrokenBranch& broken) {
  limitLength(broken.velocity, FASTEST_PIECE);
  limitLength(broken.spin, FASTEST_PIECE_SPIN);
}

std::size_t countBroken(const BrokenTrees& trees) {
  std::size_t out = 0;
  for (const auto& entry : trees) out += entry.second.size();
  return out;
}

void addTo(Hash& hash, const BrokenBranch& piece) {
  hash.add(static_cast<std::uint64_t>(piece.branch));
  hash.add(static_cast<std::uint64_t>(piece.stamp));
  hash.add(static_cast<std::uint64_t>(piece.cut));
  hash.add(piece.pose.position);
  const Quat& q = piece.pose.orientation;
  for (const double part : {q.w, q.x, q.y, q.z}) hash.add(part);
  hash.add(piece.velocity);
  hash.add(piece.spin);
}

void addTo(Hash& hash, const BrokenTrees& trees) {
  for (const auto& [tree, pieces] : trees)
    for (const BrokenBranch& piece : pieces) {
      hash.add(static_cast<std::uint64_t>(tree));
      addTo(hash, piece);
    }
}

void check(const BrokenBranch& broken, const std::string& name, Faults& faults) {
  FieldChecker checker(name, faults);
  BrokenBranch copy = broken;
  checker.integer("branch", copy.branch, "", {1, MAX_BRANCHES - 1});
  checker.vector("position", copy.pose.position, "m", {-FARTHEST, FARTHEST});
  checker.vector("velocity", copy.velocity, "m/s", {-FASTEST_PIECE, FASTEST_PIECE});
  checker.vector("spin", copy.spin, "rad/s", {-FASTEST_PIECE_SPIN, FASTEST_PIECE_SPIN});
  const Quat& q = broken.pose.orientation;
  double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  checker.number("norm of orientation", norm, "", {1.0 - NORM_ERROR, 1.0 + NORM_ERROR});
}

void archiveBroken(Archive& a, std::size_t trees, BrokenTrees& broken) {
  constexpr std::size_t PIECE_BYTES = 117;
  a.map(
      "broken trees", broken, std::min(trees, MOST_BROKEN), 2 * sizeof(std::uint32_t),
      [&](std::uint32_t& tree) {
        a.integer<std::uint32_t>("tree", tree, 0, static_cast<std::uint32_t>(trees) - 1);
      },
      [&](std::uint32_t, BrokenBranches& pieces) {
        a.list("broken branches", pieces, MOST_BROKEN, PIECE_BYTES, [&](BrokenBranch& piece) {
          a.integer("broken branch", piece.branch, 1, MAX_BRANCHES - 1);
          a.stamp("broken stamp", piece.stamp);
          a.flag("broken cut", piece.cut);
          a.pose("broken pose", piece.pose);
          a.vector("broken velocity", piece.velocity);
          a.vector("broken spin", piece.spin);
        });
        if (a.reads() && pieces.empty()) Archive::reject("broken branches = 0", "of a listed tree");
      });
  if (!a.reads()) return;
  Faults faults;
  for (const auto& [tree, pieces] : broken)
    for (const BrokenBranch& piece : pieces)
      check(piece, "broken branch of tree " + std::to_string(tree) + ": ", faults);
  if (countBroken(broken) > MOST_BROKEN)
    faults.add("broken branches = " + std::to_string(countBroken(broken)) + " is outside 0 to " +
               std::to_string(MOST_BROKEN));
  faults.throwIfAny();
}

}  // namespace vegetation_sim::forest
