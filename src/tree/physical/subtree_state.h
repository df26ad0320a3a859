// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "dynamics/batch_step/batch_chain.h"

namespace vegetation_sim::forest {

/// Bends and rates of the joints of a subtree. Steps in single precision leave them in a chain,
/// from which they are read on demand. A copy has no chain, because a chain is rebuilt from links.
class SubtreeState {
 public:
  SubtreeState() = default;
  SubtreeState(const SubtreeState& other) : state_(other.get()) {}
  SubtreeState(SubtreeState&&) noexcept = default;
  ~SubtreeState() = default;
  SubtreeState& operator=(const SubtreeState& other);
  SubtreeState& operator=(SubtreeState&&) noexcept = default;

  const physics::ChainState& get() const;
  /// Returns the bend of one joint.
  physics::Vec2 bend(std::size_t link) const;
  /// Returns the state for changes; the chain has the former one until loadChain().
  physics::ChainState& change();

  const physics::BatchChain* chain() const { return chain_.get(); }
  void setChain(std::unique_ptr<physics::BatchChain> chain);
  /// Returns the chain, which must exist, with the present state.
  physics::BatchChain& loadChain(double theta);
  /// The chain has stepped: the state is there.
  void followChain() { holder_ = Holder::CHAIN; }

 private:
  enum class Holder { STATE, CHAIN, BOTH };

  mutable physics::ChainState state_;
  mutable Holder holder_{Holder::STATE};
  std::unique_ptr<physics::BatchChain> chain_;
};

}  // namespace vegetation_sim::forest
