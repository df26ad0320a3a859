// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vegetation_sim/common/fields.h"
#include "vegetation_sim/forest/level.h"

namespace vegetation_sim::forest {

/// Rungs of a tree: its levels, the modal one on top.
constexpr std::size_t RUNGS = MODAL_LEVEL + 1;

/// What a forest may cost, and what things cost, on the machine that draws it: data, not a clock,
/// so that every process chooses alike.
struct Budget {
  double frame_time{8.0};        ///< of trees that move, a frame [ms]
  int state_bytes{100000};       ///< of amplitudes in key frames, a second [B]
  int modal_trees{16};           ///< in modes at once
  double procedural_cost{15.0};  ///< a branch and frame, forward kinematics included [ns]
  double modal_cost{20.0};  ///< the same, with its share of finding the modes once in 10 s [ns]
  double physical_cost{2200.0};  ///< a physical branch and frame [ns]
};
void describe(FieldVisitor& visitor, Budget& budget);

/// A tree that somebody sees move, with what is predicted of every rung at this tick.
struct Plant {
  std::uint32_t tree{0};
  int held{0};          ///< rung now
  int procedural{0};    ///< cheapest rung without modes that holds the tolerance, or the finest
  bool modal{false};    ///< the tolerance asks for modes
  bool resting{false};  ///< has changed within the last second
  int chosen{0};        ///< outcome
  std::array<float, RUNGS> error{};  ///< [pixel]
  std::array<float, RUNGS> cost{};   ///< [ms] a frame, rising with the level
};

/// What was chosen, and why.
struct GovernorFigures {
  double cost{0.0};                        ///< of all trees that move [ms]
  double physical{0.0};                    ///< of this, physical branches [ms]
  double budget{0.0};                      ///< [ms]
  double wanted{0.0};                      ///< what the tolerance asks for [ms]
  double largest{0.0};                     ///< predicted error of any plant [pixel]
  std::size_t over{0};                     ///< plants above the tolerance
  std::size_t held_back{0};                ///< plants on a lower rung than the tolerance asks for
  std::array<std::size_t, RUNGS> trees{};  ///< by rung
};

/// Chooses the rung of each plant: the cheapest that holds the tolerance; where all of them
/// together cost more than `room` [ms], what removes most error per millisecond goes first. What is
/// held counts half as much again, and what has just changed stays, so that choices stand still in
/// steady wind. At most `modal` trees have modes.
GovernorFigures govern(std::vector<Plant>& plants, double room, std::size_t modal,
                       double tolerance);

}  // namespace vegetation_sim::forest
