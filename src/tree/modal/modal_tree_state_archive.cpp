// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/archive.h"
#include "vegetation_sim/tree/modal/modal_tree_state.h"

namespace vegetation_sim::forest {
namespace {

void archive(Archive& a, physics::ModalState& state, std::size_t modes) {
  a.numbers("amplitudes", state.amplitude, modes);
  a.numbers("rates", state.rate, modes);
  if (state.amplitude.size() != modes || state.rate.size() != modes)
    Archive::reject("modes", "differ: " + std::to_string(state.amplitude.size()) +
                                 " amplitudes and " + std::to_string(state.rate.size()) +
                                 " rates, allowed are " + std::to_string(modes));
}

}  // namespace

void ModalTreeState::archive(Archive& a) {
  forest::archive(a, state_, modes_->size());
  forest::archive(a, before_, modes_->size());
  a.numbers("accelerations", acceleration_, modes_->size());
  if (acceleration_.size() != modes_->size())
    Archive::reject("accelerations", "are " + std::to_string(acceleration_.size()) +
                                         ", allowed are " + std::to_string(modes_->size()));
  a.stamp("stamp of modes", stamp_);
  a.stamp("stamp before", before_stamp_);
}

}  // namespace vegetation_sim::forest
