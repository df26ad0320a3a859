// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "vegetation_sim/physics/stability.h"

namespace vegetation_sim::physics {

struct TwinStore;

/// The step of BatchChain for many trees of one topology, one tree a lane: instances of a few
/// seeds. Nothing passes between lanes, and what parents hand to children stays in the first-level
/// cache; for trees of some 5 000 links and more, BatchChain's smaller working set wins. The same
/// bits on every instruction set, and whatever other trees there are; not those of BatchChain,
/// which sums children in another order.
class TwinChains {
 public:
  /// Same parents in all trees; otherwise they may differ.
  /// @throws InvalidInput naming the tree and link that differs.
  explicit TwinChains(const std::vector<std::vector<Link>>& trees);
  TwinChains(TwinChains&&) noexcept;
  TwinChains& operator=(TwinChains&&) noexcept;
  ~TwinChains();

  int treeCount() const { return static_cast<int>(theta_.size()); }
  void setState(int tree, const ChainState& state, double theta = 0.5);
  ChainState state(int tree) const;
  double theta(int tree) const { return theta_[static_cast<std::size_t>(tree)]; }

  void setProducts(Products products);

  /// One step of `h` seconds from `time`; `around` per tree.
  void step(const std::vector<Surroundings>& around, double time, double h);

  /// For callers that keep loads themselves, as in BatchChain.
  void setBases(int tree, const std::vector<BaseMotion>& bases);
  void setLoads(int tree, const Loads& loads);
  void step(double h);

 private:
  void order(const std::vector<Link>& links);
  void fill(const std::vector<std::vector<Link>>& trees);
  void fillBases(int tree);
  const BaseMotion& baseOf(int tree, int root) const;
  void guard(int pack, double h);
  void step(const Surroundings* around, double time, double h);
  void ask(const Surroundings& around, double time, double h, int tree);

  std::unique_ptr<TwinStore> store_;
  std::size_t links_{0};
  std::vector<int> place_;                      ///< [links] in depth-first order
  std::vector<int> root_;                       ///< [links] number of the root of each
  std::vector<std::vector<int>> root_base_;     ///< [trees][roots] index of a base
  std::vector<std::vector<BaseMotion>> bases_;  ///< [trees]
  std::vector<double> theta_;                   ///< [trees]
  std::vector<double> products_;                ///< [trees]
  std::vector<float> fastest_;                  ///< [trees] rate [rad/s]
  std::vector<char> loaded_;                    ///< [trees]
  Kinematics kinematics_;
  Loads loads_;
};

}  // namespace vegetation_sim::physics
