// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassEvent.h>

#include <cstddef>

#include "nodes/base/event_queue.h"

namespace vegetation_sim {

/// Largest number of points in the outlines of all areas to cut that wait for their tick together,
/// those of swaths included: 48 MB.
constexpr std::size_t MOST_WAITING_POINTS = 2'000'000;

/// Largest work of all treads and cuts that wait for their tick together, in nodes to press: one
/// tick takes about a second for them.
constexpr std::size_t MOST_WAITING_WORK = 100'000'000;

/// Largest number of discs in all lists of colours that wait for their tick together: 3 MB.
constexpr std::size_t MOST_WAITING_DISCS = 50'000;

/// Checks that a cut of this area and work may wait; a client may have half of what others leave of
/// the limits. @throws InvalidInput
void checkRoomToWait(const EventQueue<GrassEvent>& inputs, const GrassCut& cut, double work);
/// Checks that a list of so many discs of colour may wait, likewise. @throws InvalidInput
void checkDiscsToWait(const EventQueue<GrassEvent>& inputs, std::size_t discs);
/// Checks that what has this work may wait. @throws InvalidInput
void checkWorkToWait(const EventQueue<GrassEvent>& inputs, double work);

}  // namespace vegetation_sim
