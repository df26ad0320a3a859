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

/// GOAL considers several obstacles, keeps a side and finds ways around walls. PAPER is section 5.2
/// of paper 2.
enum class Behaviour : int { GOAL = 0, PAPER = 1 };
/// The noise of the command grows with the distance as the text says, or is its inverse as printed
/// (E7).
enum class NoiseLaw : int { GROWING = 0, PRINTED = 1 };

/// Perception, decision and motion of every walker of a crowd.
struct CrowdSettings {
  Behaviour behaviour{Behaviour::GOAL};
  NoiseLaw noise{NoiseLaw::GROWING};
  double noise_heading{0.15};  ///< standard deviation at the sensor's range [rad]
  double noise_speed{0.0};     ///< likewise of the speed, as a share of it
  double sensor_range{3.0};    ///< range between outlines [m]
  int neighbours{3};           ///< number of obstacles in a decision; PAPER uses one
  double commitment{1.0};      ///< time for which a side once chosen is kept [s]
  double handedness{0.02};     ///< how much nearer the right side seems: positive keeps right
  double turn_rate{2.5};       ///< limit [rad/s]
  double acceleration{2.5};    ///< limit [m/s^2]
  double reaction{0.25};       ///< time constant of following a command [s]
  double clearance{0.05};      ///< distance kept from obstacles and others if there is room [m]
  double slowest{0.2};         ///< share of the speed that a walker of PAPER keeps at contact
  double push_speed{3.0};      ///< speed at which overlaps are resolved [m/s]
  double field_cell{0.25};     ///< cell of the ways around walls [m]
  double grass_drag{0.6};      ///< share of the speed that grass of resistance 1 removes
  double pace{1.0};            ///< factor on the speed of every walker
  double arrival{0.4};         ///< distance at which a goal is reached [m]
};
void describe(FieldVisitor& visitor, CrowdSettings& settings);

/// State of a foot.
struct Foot {
  Point planted{};  ///< position where it stands, or stood last [m]
  /// Lift-off position relative to that of the gait alone; forward and left of the walker [m]
  Point offset{};
  bool stands{true};
};

/// State of one walker.
struct Walker {
  std::uint32_t id{0};
  std::uint64_t key{0};   ///< key of its random numbers
  Point position{};       ///< [m]
  Point velocity{};       ///< actual velocity of the last step [m/s]
  double heading{0.0};    ///< counter-clockwise from east [rad]
  double turn_rate{0.0};  ///< [rad/s]
  double radius{0.25};    ///< [m]
  double height{1.75};    ///< [m]
  double speed{1.35};     ///< undisturbed speed [m/s]
  bool has_goal{false};
  bool wanders{true};  ///< chooses the next goal by itself
  bool arrived{false};
  Point goal{};                ///< [m]
  std::uint32_t goals{0};      ///< number of goals so far
  int side{0};                 ///< side that it keeps to: 1 left, -1 right, 0 none
  double side_left{0.0};       ///< remaining time of that [s]
  double nearest_goal{1e9};    ///< smallest distance from the goal so far [m]
  double no_progress{0.0};     ///< time without progress [s]
  double held_up{0.0};         ///< time in a throng; negative: remaining time of stepping aside [s]
  bool detours{false};         ///< follows a way around walls
  double gait{0.0};            ///< cycles walked; the left heel strikes at integers
  std::array<Foot, 2> feet{};  ///< left, right
};

/// Initial values of a walker.
struct Spawn {
  Point position{};
  double heading{0.0}, radius{0.25}, height{1.75}, speed{1.35};
  bool wanders{true};
  bool has_goal{false};
  Point goal{};
};
void describe(FieldVisitor& visitor, Spawn& spawn);

/// Footprint and position of a robot.
struct Robot {
  std::string id;
  std::vector<Point> outline;  ///< corners in the robot's frame; none for a disc [m]
  double radius{0.3};          ///< radius of the disc [m]
  Point position{};            ///< [m]
  double yaw{0.0};             ///< [rad]
  Point velocity{};            ///< [m/s]
};
/// Adds a fault for each value that is not finite or out of range.
void check(const Robot& robot, Faults& faults);
Obstacle obstacleOf(const Robot& robot);

}  // namespace vegetation_sim::crowd
