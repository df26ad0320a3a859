// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/influence.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

// Returns the bend of a joint under a torque, world axes at rest [rad]: joints do not twist
// (S1-A1).
Vec3 bendOf(const Branch& b, double stiffness, const Vec3& torque) {
  const Vec3 z = axisZ(b.rest.orientation);
  return (torque - dot(torque, z) * z) / stiffness;
}

Vec3 pointOn(const Branch& b, double along) {
  return b.rest.position + along * axisZ(b.rest.orientation);
}

std::vector<Vec3> staticBends(const Skeleton& skeleton, const Wood& wood,
                              const std::vector<BranchLoad>& loads) {
  std::vector<Vec3> out(skeleton.branches.size(), Vec3(Vec3::Zero()));
  for (const BranchLoad& load : loads) {
    const Vec3 point = pointOn(skeleton.branches[index(load.branch)], load.along);
    for (int i = load.branch; i >= 0; i = skeleton.branches[index(i)].parent) {
      const Branch& b = skeleton.branches[index(i)];
      out[index(i)] +=
          bendOf(b, wood.stiffness[index(i)], cross(point - b.rest.position, load.force));
    }
  }
  return out;
}

// Static displacement of a branch: of its joint, and its rotation.
struct Shift {
  Vec3 move{Vec3::Zero()}, turn{Vec3::Zero()};
};

std::vector<Shift> shiftsOf(const Skeleton& skeleton, const std::vector<Vec3>& bends) {
  std::vector<Shift> out(bends.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    if (b.parent >= 0) {
      const Shift& parent = out[index(b.parent)];
      const Vec3 arm = b.rest.position - skeleton.branches[index(b.parent)].rest.position;
      out[i] = {parent.move + cross(parent.turn, arm), parent.turn};
    }
    out[i].turn += bends[i];
  }
  return out;
}

// Returns the square of Rayleigh's frequency: twice the strain energy over sum m u^2 [1/s^2].
double frequencySquared(const Skeleton& skeleton, const Wood& wood, const std::vector<Vec3>& bends,
                        const std::vector<Shift>& shifts) {
  double strain = 0.0, motion = 0.0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    strain += wood.stiffness[i] * dot(bends[i], bends[i]);
    const Composite& body = wood.own[i];
    const Vec3 centre =
        rotate(skeleton.branches[i].rest.orientation, Vec3(body.moment / body.mass));
    const Vec3 move = shifts[i].move + cross(shifts[i].turn, centre);
    motion += body.mass * dot(move, move);
  }
  return motion > 0.0 ? strain / motion : 0.0;
}

// Removes ancestors below a gap: a branch must be connected to its highest physical ancestor.
void dropAboveGaps(const Skeleton& skeleton, std::vector<int>& wanted) {
  std::vector<char> kept(skeleton.branches.size(), 0);
  for (const int i : wanted) kept[index(i)] = 1;
  for (const int i : wanted) {
    int parent = skeleton.branches[index(i)].parent;
    if (parent >= 0 && kept[index(parent)]) continue;
    for (; parent >= 0; parent = skeleton.branches[index(parent)].parent) kept[index(parent)] = 0;
  }
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), [&](int i) { return !kept[index(i)]; }),
               wanted.end());
}

// Adds to each joint between a branch and the ground the sum of all smaller deflections, because
// omitting several joints adds their errors.
void addUp(const Skeleton& skeleton, int branch, std::vector<double>& deflection) {
  std::vector<int> way;
  for (int i = branch; i >= 0; i = skeleton.branches[index(i)].parent) way.push_back(i);
  std::sort(way.begin(), way.end(), [&](int a, int b) {
    const double x = deflection[index(a)], y = deflection[index(b)];
    return x != y ? x < y : a < b;
  });
  double sum = 0.0;
  for (const int i : way) {
    sum += deflection[index(i)];
    deflection[index(i)] = sum;
  }
}

}  // namespace

std::vector<double> predictDeflection(const Skeleton& skeleton, const Wood& wood,
                                      const std::vector<BranchLoad>& loads) {
  const std::vector<Vec3> bends = staticBends(skeleton, wood, loads);
  const std::vector<Shift> shifts = shiftsOf(skeleton, bends);
  const double frequency = frequencySquared(skeleton, wood, bends, shifts);
  std::vector<double> out(bends.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    const Composite& body = wood.subtree[i];
    const Vec3 moment = rotate(b.rest.orientation, body.moment);
    const Vec3 turn = shifts[i].turn - bends[i];  // of the parent
    const double across = std::max(body.inertia[0], body.inertia[1]);
    const Vec3 torque = frequency * (cross(moment, shifts[i].move) + across * turn);
    const double inertial = length(bendOf(b, wood.stiffness[i], torque));
    out[i] = (length(bends[i]) + inertial) * wood.reach[i];
  }
  for (const BranchLoad& load : loads) addUp(skeleton, load.branch, out);
  return out;
}

double compliance(const Skeleton& skeleton, const Wood& wood, int branch, double along,
                  const Vec3& direction) {
  const Vec3 point = pointOn(skeleton.branches[index(branch)], along);
  double sum = 0.0;
  for (int i = branch; i >= 0; i = skeleton.branches[index(i)].parent) {
    const Branch& b = skeleton.branches[index(i)];
    const Vec3 bend = bendOf(b, 1.0, cross(point - b.rest.position, direction));
    sum += dot(bend, bend) / wood.stiffness[index(i)];
  }
  return sum;
}

Selection selectBranches(const Skeleton& skeleton, const std::vector<double>& score,
                         double threshold, double keep, const std::vector<char>& promoted,
                         std::size_t cap) {
  const std::size_t n = score.size();
  // highest[i]: highest requested score in the sub-tree of i; 0: none.
  std::vector<double> rank(n, 0.0), highest(n, 0.0);
  for (std::size_t i = n; i-- > 0;) {
    if (score[i] > (promoted[i] ? keep : threshold)) rank[i] = score[i];
    highest[i] = std::max(highest[i], rank[i]);
    const int parent = skeleton.branches[i].parent;
    if (parent >= 0) highest[index(parent)] = std::max(highest[index(parent)], highest[i]);
  }
  std::vector<char> below(n, 0);  // a requested branch is an ancestor or the branch itself
  std::vector<int> wanted;
  for (std::size_t i = 0; i < n; ++i) {
    const int parent = skeleton.branches[i].parent;
    below[i] = rank[i] > 0.0 || (parent >= 0 && below[index(parent)]);
    if (below[i] && highest[i] > 0.0) {
      rank[i] = std::max(rank[i], highest[i]);  // gaps have the score of what they carry
      wanted.push_back(static_cast<int>(i));
    }
  }
  const auto by_rank = [&](int a, int b) {
    return rank[index(a)] != rank[index(b)] ? rank[index(a)] > rank[index(b)] : a > b;
  };
  const auto is_new = [&](int i) { return !promoted[index(i)]; };
  const auto newcomers = [&] {
    return static_cast<std::size_t>(std::count_if(wanted.begin(), wanted.end(), is_new));
  };
  const auto taken = static_cast<std::size_t>(
      std::count_if(promoted.begin(), promoted.end(), [](char p) { return p != 0; }));
  std::size_t room = cap - std::min(cap, taken);
  Selection out;
  out.refused = newcomers();
  if (wanted.size() > cap || out.refused > room) {
    std::sort(wanted.begin(), wanted.end(), by_rank);
    wanted.resize(std::min(cap, wanted.size()));
    const auto finds_no_room = [&](int i) {
      if (!is_new(i)) return false;
      if (room == 0) return true;
      --room;
      return false;
    };
    wanted.erase(std::remove_if(wanted.begin(), wanted.end(), finds_no_room), wanted.end());
    std::sort(wanted.begin(), wanted.end());
    dropAboveGaps(skeleton, wanted);
  }
  out.refused -= newcomers();
  out.branches = std::move(wanted);
  return out;
}

std::vector<double> scoreByDepth(const Skeleton& skeleton, const std::vector<int>& loaded) {
  int deepest = -1;
  for (const int branch : loaded)
    deepest = std::max(deepest, skeleton.branches[index(branch)].depth);
  std::vector<double> out(skeleton.branches.size(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (skeleton.branches[i].depth <= deepest) out[i] = 1.0 / (1.0 + static_cast<double>(i));
  return out;
}

}  // namespace vegetation_sim::forest
