// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dynamics/integration/stability.h"

namespace vegetation_sim::physics {

struct ChainGroup;
struct ChainStore;

/// Where air grips a link and how hard: with `w` what the air there moves faster than the link, the
/// force is (steady + square |w|) w.
struct Grip {
  Vec3 centre{Vec3::Zero()};  ///< own axes [m]
  double steady{0.0};         ///< [N s/m]
  double square{0.0};         ///< [N s^2/m^2]
};

/// Air at places of joints: each of `blocks` blocks has three rows of 16 floats, x y z of places
/// [m] and, to be filled in, of the velocity of the air there [m/s]; world axes.
using AskAir = std::function<void(const float* places, float* air, std::size_t blocks)>;

/// The guarded linearly implicit midpoint (Stepper's default) of many links at once in single
/// precision, in the widest instruction set of the processor: links of equal depth, of one tree or
/// of several that step together, share vectors. The more links on a level, the better it pays;
/// small trees belong in one BatchChain. The same bits on every instruction set: only + - * / sqrt,
/// nothing fused, parents sum their children in one order; and whatever other trees there are.
/// Takes links, bases, loads and anchors as the plain stepper does. One thread at a time.
class BatchChain {
 public:
  /// Each tree has its own guard. Links as the plain stepper takes them; at rest, on the ground,
  /// without load.
  explicit BatchChain(const std::vector<std::vector<Link>>& trees);
  explicit BatchChain(const std::vector<Link>& tree);
  BatchChain(BatchChain&&) noexcept;
  BatchChain& operator=(BatchChain&&) noexcept;
  ~BatchChain();

  int treeCount() const { return static_cast<int>(trees_.size()); }
  void setState(int tree, const ChainState& state, double theta = 0.5);
  ChainState state(int tree) const;
  double theta(int tree) const { return trees_[static_cast<std::size_t>(tree)].theta; }
  /// Largest rate of a joint about an axis [rad/s].
  double fastest(int tree) const { return fastestOf(trees_[static_cast<std::size_t>(tree)]); }
  std::size_t bytes() const;

  void setProducts(Products products);

  /// One step of `h` seconds from `time`; `around` per tree. `number`: of the step in its frame.
  /// The first, 0, averages velocity products as the plain stepper does. Those after it go on from
  /// where the step before, as long, has left the trees: they take velocity products at the rates
  /// that it foretells for their middle, of second order too, for two thirds of the cost.
  void step(const std::vector<Surroundings>& around, double time, double h, int number = 0);
  void step(const Surroundings& around, double time, double h, int number = 0);

  /// From now on air acts on a tree's links, one grip each, besides loads; still air until asked.
  void setGrips(int tree, const std::vector<Grip>& grips);
  /// The next step asks for the air; later ones take what it said, while the links move in it.
  void askAir(AskAir ask) { ask_ = std::move(ask); }

  /// A frame of so many steps under the bases and loads of the step before, without anchors. Air is
  /// asked for in the first.
  void step(double h, int steps = 1);

 private:
  struct Member {
    std::size_t first{0}, count{0};  ///< its links, in slots_
    std::size_t group{0};
    double theta{0.5}, products{1.0};
    std::vector<std::size_t> by_slot;  ///< links in the order in which rows hold them
    std::vector<int> base;             ///< [links] what the root of each hangs on
    std::vector<int> roots;            ///< links
    std::vector<BaseMotion> bases;
    bool loaded{false};
    bool on_axis{true};  ///< so are all grips
  };
  Member& member(int tree) { return trees_[static_cast<std::size_t>(tree)]; }
  void sortGroup(const std::vector<std::vector<Link>>& trees, std::size_t index);
  std::size_t blocks() const;
  void fill(const std::vector<std::vector<Link>>& trees);
  void sortBySlot(const ChainGroup& group);
  void fillBases(const Member& member);
  void fillLoads(const Loads& loads, Member& member);
  const BaseMotion& baseOf(const Member& member, std::size_t link) const;
  double fastestOf(const Member& member) const;
  void setTheta(Member& member, double theta, double products);
  void guard(ChainGroup& group, double h);
  void stepGroup(ChainGroup& group, const Surroundings* around, double time, double h, int number);
  void stepWithin(const Surroundings* around, std::size_t count, double time, double h, int number);
  void askAirOf(const ChainGroup& group);
  void askBases(const Surroundings& around, double time, Member& member);
  void askLoads(const Surroundings& around, double time, double h, Member& member);

  std::unique_ptr<ChainStore> store_;
  std::vector<ChainGroup> groups_;
  std::vector<Member> trees_;
  std::vector<int> slots_;  ///< [links of all trees]
  int slot_count_{0};
  AskAir ask_;
  Kinematics kinematics_;
  Loads loads_;
};

}  // namespace vegetation_sim::physics
