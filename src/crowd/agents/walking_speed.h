// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/agents/decision.h"

namespace vegetation_sim::crowd {

/// What the ground does to the speed: 1 on the flat, less uphill and on steep ways down (Tobler
/// 1993; S2-34, S2-37). @param slope rise per run along the way.
double slopeFactor(double slope);

/// A limit on the step: its part along `normal` is to be at most `wanted`, and is never more than
/// `hard` [m]. `wanted` below 0 asks for a retreat.
struct Limit {
  Point normal;
  double wanted, hard;
};

/// Limits of one step from what is in view. An obstacle is convex, so it lies beyond the line that
/// touches it where it is nearest: a step that stays on this side never meets it, however long it
/// is. Two walkers share what is between them; a robot takes what it moves in `dt`.
int limitsOf(std::uint32_t self, const View& view, const CrowdSettings& settings, double dt,
             std::array<Limit, View::MOST>& limits);

/// The step nearest to the desired one that the limits allow [m]. It slides along what it may not
/// cross, and never goes farther than `farthest`.
Point safeStep(const Point& desired, const std::array<Limit, View::MOST>& limits, int count,
               double farthest);

/// Velocity after `dt` of following a command, within reaction time and acceleration.
/// @param front where the walker's body points, unit.
Point followed(const Walker& walker, const Point& front, const Command& command,
               const CrowdSettings& settings, double dt);

/// Turns the walker's body towards a direction, smoothly and at a bounded rate. @param front where
/// it points before, unit.
void turnTowards(const Point& direction, const Point& front, const CrowdSettings& settings,
                 double dt, Walker& walker);
/// Where the walker's body points, unit.
Point frontOf(const Walker& walker);

}  // namespace vegetation_sim::crowd
