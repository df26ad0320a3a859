// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/GrassColour.h>
#include <vegetation_sim/GrassColours.h>
#include <vegetation_sim/GrassCut.h>
#include <vegetation_sim/GrassLayout.h>
#include <vegetation_sim/GrassState.h>
#include <vegetation_sim/TreadEvent.h>

#include <string>
#include <vector>

#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/grass/lod/colour_mask.h"
#include "vegetation_sim/grass/tread/tread_input.h"
#include "vegetation_sim/grass/tread/tread_update.h"

namespace vegetation_sim {

/// The header is left to the sender.
GrassLayout toMsg(const grass::Layout& layout);
/// The terrain is the caller's to load and to compare by its hash. @throws InvalidInput with all
/// faults: species that do not parse, pictures of a wrong size, numbers out of range, and if the
/// hash is another than the sender's.
grass::Layout fromMsg(const GrassLayout& message);

/// The header's frame is left to the sender.
GrassState toMsg(const grass::TreadUpdate& update);
/// @throws InvalidInput for what cannot be.
grass::TreadUpdate fromMsg(const GrassState& message);

/// The frame of the header is left to the sender.
GrassColours toMsg(const grass::ColourMasks& masks);
/// @throws InvalidInput with all values that are not finite or out of range.
grass::ColourMasks fromMsg(const GrassColours& message);
/// The same for discs that have their places at `stamp`.
grass::ColourMasks masksOf(const std::vector<GrassColour>& discs, Nanoseconds stamp);

GrassCut toMsg(const grass::CutArea& area);
/// @throws InvalidInput with all values that are not finite or out of range.
grass::CutArea fromMsg(const GrassCut& message, const std::string& context);

TreadLaw toMsg(const grass::TreadLaw& law);
/// Numbers that are not given are the node's `own`; reach and softness then are in proportion to
/// the radius. Adds a fault for a number without its flag; ranges are left to grass::check().
grass::TreadLaw fromMsg(const TreadLaw& message, const grass::TreadLaw& own,
                        const std::string& context, Faults& faults);

/// The header is left to the sender.
TreadEvent toMsg(const grass::TreadInput& input);
/// Positions as they stand: the frame is the caller's. Numbers that are not given are the node's.
/// @throws InvalidInput with all values that are not finite or out of range.
grass::TreadInput fromMsg(const TreadEvent& message, const grass::TreadLaw& own,
                          double height_gate);

}  // namespace vegetation_sim
