// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim {

/// TreeModels of the longest ladder of models.
constexpr std::size_t MAX_TIERS = 9;
/// A tier that has changed stays for so long while the budget binds [s].
constexpr double TIER_HOLD = 1.0;

/// Something that is modelled on one of several tiers, each finer than the one below, with what is
/// predicted of every tier now. Errors are those of who looks (pixel) or stands near (m); costs
/// are in the unit of the budget: ms a frame, points, frames, bytes a second.
struct TierChoice {
  std::uint32_t id{0};
  int held{0};          ///< tier now
  int stepwise{0};      ///< up to here, tiers are climbed one by one
  int above{0};         ///< first tier that is climbed from the top of the stair, if any
  int wanted{0};        ///< cheapest that holds the tolerance
  bool resting{false};  ///< has changed a moment ago
  int chosen{0};        ///< outcome
  std::array<float, MAX_TIERS> error{};
  std::array<float, MAX_TIERS> cost{};  ///< rising
};

/// What was chosen, and why.
struct TierAllocation {
  double cost{0.0};                             ///< of all that was chosen
  double wanted{0.0};                           ///< what the tolerance asks for
  double largest{0.0};                          ///< predicted error of any
  std::size_t over{0};                          ///< above the tolerance
  std::size_t held_back{0};                     ///< on a lower tier than the tolerance asks for
  std::array<std::size_t, MAX_TIERS> counts{};  ///< by tier
};

/// Cheapest of the tiers 0 to `finest` that holds the tolerance, else the finest. A finer one is
/// kept until the next coarser one is well within (HYSTERESIS).
int tierWithin(const TierChoice& choice, int finest, double tolerance);

/// Chooses the tier of each: the one that is wanted; where all of them together cost more than
/// `room`, what removes most error per cost goes first. What is held counts half as much again, and
/// what rests stays, so that choices stand still in a steady scene.
TierAllocation allocateTiers(std::vector<TierChoice>& choices, double room, double tolerance);

/// What is held counts so much more, here and where places are shared out.
constexpr double STICKY = 1.5;

}  // namespace vegetation_sim
