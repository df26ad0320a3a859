// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dynamics/integration/stability.h"

namespace vegetation_sim::physics {

struct ChainGroup;
struct ChainScratch;
struct ChainStore;

/// The drag of air on a link: with `w` the velocity of the air there relative to the link, the
/// force is (steady + square |w|) w.
struct Grip {
  Vec3 centre{Vec3::Zero()};  ///< point of application, own axes [m]
  double steady{0.0};         ///< [N s/m]
  double square{0.0};         ///< [N s^2/m^2]
};

/// Computes the wind at joints: each of `blocks` blocks has three rows of 16 floats, x y z of
/// positions [m] and of the wind velocities there, to be filled in [m/s]; world axes.
using WindQuery = std::function<void(const float* places, float* air, std::size_t blocks)>;

/// The guarded linearly implicit midpoint (ChainStepper's default) of many links at once in single
/// precision, in the widest instruction set of the processor. Links of equal depth, of one tree or
/// of several that step together, share vectors. The gain rises with the number of links per level,
/// so small trees should share one BatchChain. The bits are the same on every instruction set and
/// do not depend on the other trees: only + - * / sqrt, nothing fused, parents sum their children
/// in one order. Links, bases, loads and anchors are as for the plain stepper. One thread at a
/// time.
class BatchChain {
 public:
  /// Creates trees at rest, on the ground, without load. Each tree has its own guard.
  explicit BatchChain(const std::vector<std::vector<Link>>& trees);
  explicit BatchChain(const std::vector<Link>& tree);
  BatchChain(BatchChain&&) noexcept;
  BatchChain& operator=(BatchChain&&) noexcept;
  ~BatchChain();

  int treeCount() const { return static_cast<int>(trees_.size()); }
  void setState(int tree, const ChainState& state, double theta = 0.5);
  ChainState state(int tree) const;
  void readState(int tree, ChainState& out) const;
  Vec2 bend(int tree, std::size_t link) const;
  double theta(int tree) const { return trees_[static_cast<std::size_t>(tree)].theta; }
  /// Returns the largest rate of a joint about an axis [rad/s].
  double fastest(int tree) const { return fastestOf(trees_[static_cast<std::size_t>(tree)]); }
  /// Returns true if all joints of all trees are finite, bent by at most `bend` [rad] and no faster
  /// than `rate` [rad/s]; it may return false if one is within 1e-6 of a limit.
  bool isWithin(double bend, double rate) const;
  std::size_t bytes() const;

  void setProducts(Products products);
  /// Sets the scratch memory of the steps from now on, which chains that step one after the other
  /// may share; without it a chain has its own. It affects no result.
  void setScratch(ChainScratch& scratch);

  /// Takes one step of `h` seconds from `time`, with `around` per tree. `number` is that of the
  /// step in its frame. The first, 0, averages velocity products as the plain stepper does. Later
  /// ones must have the same length and continue the step before: they take velocity products at
  /// the rates that it predicts for their middle, of second order too, for two thirds of the cost.
  void step(const std::vector<Surroundings>& around, double time, double h, int number = 0);
  void step(const Surroundings& around, double time, double h, int number = 0);

  /// Names the only links that the loads of the next step read and act on, in every tree; null:
  /// all. It saves time only.
  void setLoadedLinks(const std::vector<std::size_t>* links) { loaded_ = links; }

  /// Lets air act on a tree's links, one grip each, in addition to loads. The air is still until
  /// queryWind().
  void setGrips(int tree, const std::vector<Grip>& grips);
  /// The next step asks for the wind. Later steps use the same velocities while the links move.
  void queryWind(WindQuery ask) { query_ = std::move(ask); }

  /// Takes a frame of so many steps under the bases and loads of the step before, without anchors.
  /// The first step asks for the wind.
  void step(double h, int steps = 1);

 private:
  struct Member {
    std::size_t first{0}, count{0};  ///< range of its links in slots_
    std::size_t group{0};
    double theta{0.5}, products{1.0};
    std::vector<std::size_t> by_slot;  ///< links in the order in which rows hold them
    std::vector<int> base;             ///< [links] base of the root of each
    std::vector<int> roots;            ///< links
    std::vector<BaseMotion> bases;
    std::vector<std::size_t> loaded;  ///< links whose rows may hold loads
    bool on_axis{true};               ///< all grips are on the links' axes
  };
  Member& member(int tree) { return trees_[static_cast<std::size_t>(tree)]; }
  void sortGroup(const std::vector<std::vector<Link>>& trees, std::size_t index);
  std::size_t blocks() const;
  void fill(const std::vector<std::vector<Link>>& trees);
  void sortBySlot(const ChainGroup& group);
  void fillBases(const Member& member);
  void fillLoads(const std::vector<std::size_t>& links, Member& member);
  void evaluateLoads(const Surroundings& around, double time, Member& member);
  const BaseMotion& baseOf(const Member& member, std::size_t link) const;
  double fastestOf(const Member& member) const;
  void setTheta(Member& member, double theta, double products);
  void guard(ChainGroup& group, double h);
  void prepareScratch();
  void stepGroup(ChainGroup& group, const Surroundings* around, double time, double h, int number);
  void stepWithin(const Surroundings* around, std::size_t count, double time, double h, int number);
  void queryWindOf(const ChainGroup& group);
  void updateBases(const Surroundings& around, double time, Member& member);
  void updateLoads(const Surroundings& around, double time, double h, Member& member);

  std::unique_ptr<ChainStore> store_;
  std::unique_ptr<ChainScratch> own_scratch_;
  int largest_{0}, widest_{0};  ///< most slots of a group, most joints of a level
  std::vector<ChainGroup> groups_;
  std::vector<Member> trees_;
  std::vector<int> slots_;  ///< [links of all trees]
  int slot_count_{0};
  WindQuery query_;
  const std::vector<std::size_t>* loaded_{nullptr};  ///< in the next step
  Kinematics kinematics_;
  Loads loads_;  ///< scratch; no loads between steps unless it is `loads_used_`
  bool loads_used_{false};
};

}  // namespace vegetation_sim::physics
