// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim {

/// Rungs of the longest ladder of models.
constexpr std::size_t MOST_RUNGS = 9;
/// A rung that has changed stays for so long while the budget binds [s].
constexpr double RUNG_REST = 1.0;

/// Something that is modelled on one of several rungs, each finer than the one below, with what is
/// predicted of every rung now. Errors are those of who looks (pixel) or stands near (m); costs
/// are in the unit of the budget: ms a frame, points, frames, bytes a second.
struct Choice {
  std::uint32_t id{0};
  int held{0};          ///< rung now
  int stair{0};         ///< up to here, rungs are climbed one by one
  int above{0};         ///< first rung that is climbed from the top of the stair, if any
  int wanted{0};        ///< cheapest that holds the tolerance
  bool resting{false};  ///< has changed a moment ago
  int chosen{0};        ///< outcome
  std::array<float, MOST_RUNGS> error{};
  std::array<float, MOST_RUNGS> cost{};  ///< rising
};

/// What was chosen, and why.
struct Balance {
  double cost{0.0};                              ///< of all that was chosen
  double wanted{0.0};                            ///< what the tolerance asks for
  double largest{0.0};                           ///< predicted error of any
  std::size_t over{0};                           ///< above the tolerance
  std::size_t held_back{0};                      ///< on a lower rung than the tolerance asks for
  std::array<std::size_t, MOST_RUNGS> counts{};  ///< by rung
};

/// Cheapest of the rungs 0 to `finest` that holds the tolerance, else the finest. A finer one is
/// kept until the next coarser one is well within (HYSTERESIS).
int rungWithin(const Choice& choice, int finest, double tolerance);

/// Chooses the rung of each: the one that is wanted; where all of them together cost more than
/// `room`, what removes most error per cost goes first. What is held counts half as much again, and
/// what rests stays, so that choices stand still in a steady scene.
Balance govern(std::vector<Choice>& choices, double room, double tolerance);

/// What is held counts so much more, here and where places are shared out.
constexpr double STICKY = 1.5;

}  // namespace vegetation_sim
