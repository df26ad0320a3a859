// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "crowd/agents/decision.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::crowd {

/// Returns the factor of the slope on the speed: 1 on flat ground, less uphill and steeply downhill
/// (Tobler 1993; S2-34, S2-37). @param slope rise per run along the way.
double slopeFactor(double slope);

/// Resistance of the ground at a place over a reference: 0 for free ground; above 1 it counts as 1.
using Resistance = std::function<double(const Point&)>;
/// Returns the factor on a walker's speed at a place: the pace of all, less on a slope and in grass
/// (S2-37). @param resistance may be empty: free ground.
double paceAt(const Point& place, const Point& direction, const terrain::HeightMap& terrain,
              const Resistance& resistance, const CrowdSettings& settings);

/// A limit on the step: its part along `normal` should be at most `wanted` and must be at most
/// `hard` [m]. A negative `wanted` demands a retreat.
struct Limit {
  Point normal;
  double wanted, hard;
};

/// Computes the limits of one step from the view. An obstacle is convex and lies beyond its tangent
/// at the nearest point, so a step of any length on this side of the tangent does not meet it. Two
/// walkers share the space between them; a robot takes the space that it covers in `dt`.
int limitsOf(std::uint32_t self, const View& view, const CrowdSettings& settings, double dt,
             std::array<Limit, View::MOST>& limits);

/// Returns the step nearest to the desired one within the limits [m]. It slides along obstacles and
/// is never longer than `farthest`.
Point safeStep(const Point& desired, const std::array<Limit, View::MOST>& limits, int count,
               double farthest);

/// Returns the velocity after following a command for `dt`, with reaction time and limited
/// acceleration. @param front unit direction of the walker's body.
Point followed(const Walker& walker, const Point& front, const Command& command,
               const CrowdSettings& settings, double dt);

/// Turns the walker's body towards a direction, smoothly and at a limited rate. @param front unit
/// direction of the body before.
void turnTowards(const Point& direction, const Point& front, const CrowdSettings& settings,
                 double dt, Walker& walker);
/// Returns the unit direction of the walker's body.
Point frontOf(const Walker& walker);

}  // namespace vegetation_sim::crowd
