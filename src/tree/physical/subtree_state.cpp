// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/subtree_state.h"

namespace vegetation_sim::forest {

SubtreeState& SubtreeState::operator=(const SubtreeState& other) {
  if (this == &other) return *this;
  state_ = other.get();
  setChain(nullptr);
  return *this;
}

const physics::ChainState& SubtreeState::get() const {
  if (holder_ == Holder::CHAIN) {
    chain_->readState(0, state_);
    holder_ = Holder::BOTH;
  }
  return state_;
}

physics::Vec2 SubtreeState::bend(std::size_t link) const {
  return holder_ == Holder::CHAIN ? chain_->bend(0, link) : state_.q[link];
}

physics::ChainState& SubtreeState::change() {
  get();
  holder_ = Holder::STATE;
  return state_;
}

void SubtreeState::setChain(std::unique_ptr<physics::BatchChain> chain) {
  change();
  chain_ = std::move(chain);
}

physics::BatchChain& SubtreeState::loadChain(double theta) {
  if (holder_ == Holder::STATE) {
    chain_->setState(0, state_, theta);
    holder_ = Holder::BOTH;
  }
  return *chain_;
}

}  // namespace vegetation_sim::forest
