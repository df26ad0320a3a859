// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <vegetation_sim/AgentSpawn.h>
#include <vegetation_sim/AgentState.h>
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdMotions.h>
#include <vegetation_sim/CrowdRobot.h>
#include <vegetation_sim/CrowdView.h>
#include <vegetation_sim/InterestDisc.h>

#include <memory>
#include <vector>

#include "core/lod/interest_regions.h"
#include "crowd/agents/crowd.h"
#include "crowd/body/limb_error.h"
#include "crowd/body/motion_style.h"
#include "vegetation_sim/tree/growth/forest_layout.h"

namespace vegetation_sim {

/// Converts a walker on the terrain, and its body back.
AgentState toMsg(const crowd::Walker& walker, const terrain::HeightMap& terrain);
crowd::Walker fromMsg(const AgentState& message);
/// Checks received walkers. @throws InvalidInput with all faults, each with id, value and range.
void check(const std::vector<AgentState>& agents);

/// Limit of the discs of a message: a node has up to 32 viewers and 32 sensors.
constexpr std::size_t MOST_DISCS = 64;
/// Converts the discs of NearAgents and NearGrass, and back. @throws InvalidInput for impossible
/// ones, and too many.
std::vector<InterestDisc> toMsg(const std::vector<InterestArea>& discs);
std::vector<InterestArea> fromMsg(const std::vector<InterestDisc>& discs);

/// A walker as a display draws it.
struct WalkerView {
  crowd::Walker walker;
  double ground{0.0};  ///< height of the ground at the walker [m]
};
/// Checks and converts received walkers. @throws InvalidInput with all faults.
std::vector<WalkerView> peopleOf(const std::vector<AgentState>& agents);
/// Rounds walkers, by rising id, on the terrain. What no display needs is left out: radius, goal
/// and progress.
CrowdView toView(const std::vector<crowd::Walker>& walkers, const terrain::HeightMap& terrain);
/// Returns half a step of each number of toView() of these walkers.
crowd::WalkerRounding viewRounding(const std::vector<crowd::Walker>& walkers,
                                   const terrain::HeightMap& terrain);
/// Reads rounded walkers. @throws InvalidInput with all faults, each with name, value and range.
std::vector<WalkerView> fromMsg(const CrowdView& message);

CrowdMotions toMsg(const crowd::MotionStyles& styles);
/// Reads styles. @throws InvalidInput with all faults, each with name, value and range.
crowd::MotionStyles fromMsg(const CrowdMotions& message);

AgentSpawn toMsg(const crowd::Spawn& spawn);
/// Numbers that are not given have their defaults. Adds a fault for a number without its flag;
/// Crowd::spawn() checks ranges.
crowd::Spawn fromMsg(const AgentSpawn& message, const std::string& context, Faults& faults);

CrowdRobot toMsg(const crowd::Robot& robot);
crowd::Robot fromMsg(const CrowdRobot& message);

/// Trunks of a forest as obstacles, round or as their bounding boxes, within the area and
/// `margin` [m] of it; at most `most`, by id.
enum class TrunkShape : int { ROUND = 0, BOX = 1 };
std::vector<crowd::Obstacle> trunksOf(const forest::Layout& layout, TrunkShape shape,
                                      const crowd::Area& area, double margin, std::size_t most);

/// Cover in percent as a resistance by place; unknown cells and those beyond are free. A map that
/// is turned is read as if it were not. @throws InvalidInput for sizes that do not fit.
crowd::Resistance resistanceOf(const nav_msgs::OccupancyGrid& cover);
std::uint64_t hashOf(const nav_msgs::OccupancyGrid& cover);

}  // namespace vegetation_sim
