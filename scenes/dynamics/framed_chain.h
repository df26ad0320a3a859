// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/batch_step/batch_chain.h"
#include "scenes/dynamics/chain_scene.h"

namespace vegetation_sim::physics {

/// Trees that step in frames of four, of which the first step averages velocity products and the
/// others predict their rates.
class FramedChain : public BatchChain {
 public:
  using BatchChain::BatchChain;
  void step(const std::vector<Surroundings>& around, double time, double h) {
    BatchChain::step(around, time, h, number_++ % 4);
  }
  void step(double h) {
    step(std::vector<Surroundings>(static_cast<std::size_t>(treeCount())), 0.0, h);
  }

 private:
  int number_{0};
};

}  // namespace vegetation_sim::physics
