// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crowd/geometry/obstacle.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::crowd {

/// `goal`: several obstacles, one side kept, ways around walls. `paper`: section 5.2 of paper 2.
enum class Behaviour : int { GOAL = 0, PAPER = 1 };
/// Noise of the command: growing with the distance, as the text means, or its inverse, as it is
/// printed (E7).
enum class NoiseLaw : int { GROWING = 0, PRINTED = 1 };

/// How every walker of a crowd perceives, decides and moves.
struct CrowdSettings {
  Behaviour behaviour{Behaviour::GOAL};
  NoiseLaw noise{NoiseLaw::GROWING};
  double noise_heading{0.15};  ///< standard deviation at the sensor's range [rad]
  double sensor_range{3.0};    ///< between outlines [m]
  int neighbours{3};           ///< nearest obstacles that a decision fuses; `paper` takes one
  double commitment{1.0};      ///< for which a side once chosen is kept [s]
  double handedness{0.02};     ///< how much nearer the right side seems: above 0 keeps right
  double turn_rate{2.5};       ///< largest [rad/s]
  double acceleration{2.5};    ///< largest [m/s^2]
  double reaction{0.25};       ///< time in which a command takes hold [s]
  double clearance{0.05};      ///< kept from obstacles and others where there is room [m]
  double slowest{0.2};         ///< share of its speed that a walker of `paper` keeps at contact
  double push_speed{3.0};      ///< with which overlaps are left [m/s]
  double field_cell{0.25};     ///< of the ways around walls [m]
  double grass_drag{0.6};      ///< share of the speed that the densest grass takes
  double pace{1.0};            ///< factor on everybody's speed
  double arrival{0.4};         ///< distance at which a goal is reached [m]
};
void describe(FieldVisitor& visitor, CrowdSettings& settings);

/// A foot on the ground or on its way.
struct Foot {
  Point planted{};  ///< where it stands, or stood last [m]
  Point lag{};      ///< from where the gait alone would have had it to there, when it lifted off;
                    ///< forward and left of the walker [m]
  bool stands{true};
};

/// All that one walker remembers.
struct Walker {
  std::uint32_t id{0};
  std::uint64_t key{0};   ///< of its random numbers
  Point position{};       ///< [m]
  Point velocity{};       ///< as it really moved in the last step [m/s]
  double heading{0.0};    ///< counter-clockwise from east [rad]
  double turn_rate{0.0};  ///< [rad/s]
  double radius{0.25};    ///< [m]
  double height{1.75};    ///< [m]
  double speed{1.35};     ///< that it walks at where nothing hinders [m/s]
  bool has_goal{false};
  bool wanders{true};  ///< chooses the next goal by itself
  bool arrived{false};
  Point goal{};              ///< [m]
  std::uint32_t goals{0};    ///< that it has had
  int side{0};               ///< that it keeps to: 1 left, -1 right, 0 none
  double side_left{0.0};     ///< for which it still does [s]
  double nearest_goal{1e9};  ///< distance from the goal that it has come to [m]
  double no_progress{0.0};   ///< since when it has not come nearer [s]
  double held_up{0.0};  ///< since when it is in a throng; below 0: steps aside for that long [s]
  bool detours{false};  ///< follows a way around walls
  double gait{0.0};     ///< cycles walked; left heel strikes at whole ones
  std::array<Foot, 2> feet{};  ///< left, right
};

/// What a walker is made from.
struct Spawn {
  Point position{};
  double heading{0.0}, radius{0.25}, height{1.75}, speed{1.35};
  bool wanders{true};
  bool has_goal{false};
  Point goal{};
};
void describe(FieldVisitor& visitor, Spawn& spawn);

/// A robot's footprint and where it is now.
struct Robot {
  std::string id;
  std::vector<Point> outline;  ///< corners in the robot's frame; none: a disc [m]
  double radius{0.3};          ///< of the disc [m]
  Point position{};            ///< [m]
  double yaw{0.0};             ///< [rad]
  Point velocity{};            ///< [m/s]
};
/// Adds a fault for whatever is not finite or out of range.
void check(const Robot& robot, Faults& faults);
Obstacle obstacleOf(const Robot& robot);

}  // namespace vegetation_sim::crowd
