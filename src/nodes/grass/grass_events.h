// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ClearGrass.h>
#include <vegetation_sim/GrassEvent.h>
#include <vegetation_sim/Tread.h>

#include <functional>
#include <utility>
#include <vector>

#include "grass/tread_simulation.h"
#include "nodes/grass/grass_options.h"

namespace vegetation_sim {

/// Treads, cuts or raises grass. @return what TreadSimulation::apply() returns for a tread, else an
/// empty text. @throws InvalidInput, and then nothing has changed, also for another kind.
std::string applyToGrass(const GrassEvent& event, const GrassTuning& tuning,
                         grass::TreadSimulation& simulation);

/// Pose of the frame of a request in the world frame; asked for once the request has been checked.
using FramePose = std::function<Pose()>;

/// Event of a request to raise grass. @throws InvalidInput for values out of range.
GrassEvent clearingOf(const ClearGrass::Request& request, const FramePose& pose);

/// The points of a request to tread a path, on the ground, world. @throws InvalidInput for their
/// number, and with all points that are not on the map.
std::vector<Vec3> pathOf(const Tread::Request& request, const grass::MapLaw& law,
                         const terrain::HeightMap& terrain, const FramePose& pose);

/// Ranges of a map in x and y [m].
std::pair<Range, Range> rangesOf(const grass::MapLaw& law);
/// Adds a fault for a point whose place is not finite or far away.
void checkPoint(std::size_t index, Vec3 point, Faults& faults);
/// @throws InvalidInput for a number of points out of range.
void checkCount(std::size_t count, std::size_t most);

/// Returns at most how many nodes the tread or cut of an event presses, in the time of which it is
/// applied. An event that is no valid one has no work: it is refused.
double workOf(const GrassEvent& event, const grass::TreadSimulation& simulation);

}  // namespace vegetation_sim
