// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim {

/// Number of tiers of the longest ladder of models.
constexpr std::size_t MAX_TIERS = 9;
/// Time that a changed tier is kept while the budget binds [s].
constexpr double TIER_HOLD = 1.0;

/// An item that is modelled on one of several tiers, each finer than the one below, with the
/// predicted error and cost of every tier. Errors are in pixels of a camera or in metres at a
/// robot. Costs have the unit of the budget: ms per frame, points, frames, or bytes per second.
struct TierChoice {
  std::uint32_t id{0};
  int held{0};          ///< current tier
  int stepwise{0};      ///< up to this tier, tiers are climbed one by one
  int above{0};         ///< first tier that is climbed to from `stepwise`, if any
  int wanted{0};        ///< cheapest tier that holds the tolerance
  double scale{0.0};    ///< unit of the errors per metre at the item; 0: it is not known
  bool resting{false};  ///< changed less than TIER_HOLD ago
  int chosen{0};        ///< outcome
  std::array<float, MAX_TIERS> error{};
  std::array<float, MAX_TIERS> cost{};  ///< rises with the tier
};

/// The outcome of an allocation, for reports.
struct TierAllocation {
  double cost{0.0};            ///< sum over the chosen tiers
  double wanted{0.0};          ///< cost that the tolerance asks for
  double largest{0.0};         ///< largest predicted error
  double largest_metres{0.0};  ///< the same as a length at its item [m]; 0 if no scale is known
  std::size_t over{0};         ///< number of items above the tolerance
  std::size_t held_back{0};    ///< number of items on a lower tier than the tolerance asks for
  std::array<std::size_t, MAX_TIERS> counts{};  ///< by tier
};

/// Returns the cheapest of the tiers 0 to `finest` that holds the tolerance, else the finest. A
/// finer tier is kept until the next coarser one is well within the tolerance (HYSTERESIS).
int tierWithin(const TierChoice& choice, int finest, double tolerance);

/// Chooses the tier of each item: the one that is wanted. Where all of them together cost more than
/// `room`, the steps that remove most error per cost go first. Steps to a tier that is held count
/// STICKY times as much, and a resting item keeps its tier, so that choices stand still in a steady
/// scene.
TierAllocation allocateTiers(std::vector<TierChoice>& choices, double room, double tolerance);

/// Factor of the priority of what is held already, here and where places are shared out.
constexpr double STICKY = 1.5;

}  // namespace vegetation_sim
