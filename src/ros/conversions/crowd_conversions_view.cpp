// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "ros/conversions/crowd_conversions.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim {
namespace {

constexpr double VIEW_STEP = 1e-3;        // of a position [m] and a velocity [m/s]
constexpr double HEIGHT_STEP = 1e-4;      // of the height of a body [m]
constexpr double TURN_STEP = 1.0 / 80.0;  // of a rate of turning [rad/s]
constexpr double FRACTIONS = 65536.0;     // steps of a turn or a cycle
constexpr double GROUND_STEPS = 65535;    // largest number of steps above the lowest ground
constexpr double ORIGIN_GRID = 1000.0;    // grid of origins [m]: rounding is equal in all messages
constexpr Range VIEW_PLACES{-1e7, 1e7}, BODY_HEIGHTS{0.1, 5.0}, GROUND_STEP_RANGE{1e-3, 400.0};

/// Returns the nearest whole number of steps, or the nearest one that the type has.
template <class Number>
Number stepsOf(double value, double step) {
  return static_cast<Number>(std::clamp(std::round(value / step),
                                        static_cast<double>(std::numeric_limits<Number>::min()),
                                        static_cast<double>(std::numeric_limits<Number>::max())));
}

// Returns the fraction of a cycle, of which the last half step belongs to the next cycle.
std::uint16_t fractionSteps(double cycles) {
  const double steps = std::round((cycles - std::floor(cycles)) * FRACTIONS);
  return static_cast<std::uint16_t>(steps < FRACTIONS ? steps : 0.0);
}

double originOf(double first) {
  return ORIGIN_GRID * std::round(first / ORIGIN_GRID);
}

void appendId(std::uint32_t id, CrowdView& out) {
  if (out.first_id.empty() || out.first_id.back() + out.id_count.back() != id) {
    out.first_id.push_back(id);
    out.id_count.push_back(0);
  }
  ++out.id_count.back();
}

// A standing foot is on the grid of the world, so it stays where it is while the walker moves on.
void appendFeet(const crowd::Walker& w, const crowd::Point& rounded, CrowdView& out) {
  std::uint8_t stand = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const crowd::Foot& foot = w.feet[i];
    const crowd::Point at = foot.stands ? foot.planted - rounded : foot.offset;
    out.feet_x.push_back(stepsOf<std::int16_t>(at.x, VIEW_STEP));
    out.feet_y.push_back(stepsOf<std::int16_t>(at.y, VIEW_STEP));
    if (foot.stands) stand = static_cast<std::uint8_t>(stand + (i == 0 ? 1 : 2));
  }
  out.feet_stand.push_back(stand);
}

void append(const crowd::Walker& w, CrowdView& out) {
  appendId(w.id, out);
  out.x.push_back(stepsOf<std::int32_t>(w.position.x - out.origin_x, VIEW_STEP));
  out.y.push_back(stepsOf<std::int32_t>(w.position.y - out.origin_y, VIEW_STEP));
  out.heading.push_back(fractionSteps(w.heading / (2.0 * PI)));
  out.gait.push_back(fractionSteps(w.gait));
  // The limits are symmetric, so that turns to both sides are rounded alike.
  out.turn_rate.push_back(
      std::max<std::int8_t>(stepsOf<std::int8_t>(w.turn_rate, TURN_STEP), -127));
  out.height.push_back(stepsOf<std::uint16_t>(w.height, HEIGHT_STEP));
  out.velocity_x.push_back(stepsOf<std::int16_t>(w.velocity.x, VIEW_STEP));
  out.velocity_y.push_back(stepsOf<std::int16_t>(w.velocity.y, VIEW_STEP));
  appendFeet(w, {out.origin_x + VIEW_STEP * out.x.back(), out.origin_y + VIEW_STEP * out.y.back()},
             out);
}

std::vector<double> groundsOf(const std::vector<crowd::Walker>& walkers,
                              const terrain::HeightMap& terrain) {
  std::vector<double> out;
  out.reserve(walkers.size());
  for (const crowd::Walker& w : walkers) out.push_back(terrain.height(w.position.x, w.position.y));
  return out;
}

double groundStepOf(const std::vector<double>& heights) {
  if (heights.empty()) return VIEW_STEP;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return std::max(VIEW_STEP, (*high - *low) / GROUND_STEPS);
}

void appendGround(const std::vector<crowd::Walker>& walkers, const terrain::HeightMap& terrain,
                  CrowdView& out) {
  const std::vector<double> heights = groundsOf(walkers, terrain);
  out.ground_step = groundStepOf(heights);
  if (heights.empty()) return;
  out.ground_low = *std::min_element(heights.begin(), heights.end());
  for (const double height : heights)
    out.ground.push_back(stepsOf<std::uint16_t>(height - out.ground_low, out.ground_step));
}

// Faults of the ids. @param number of walkers by their positions.
void checkIds(const CrowdView& message, std::size_t number, Faults& faults) {
  if (message.first_id.size() != message.id_count.size()) {
    faults.add("id_count has " + std::to_string(message.id_count.size()) +
               " numbers, first_id has " + std::to_string(message.first_id.size()));
    return;
  }
  std::uint64_t next = 0, sum = 0;
  for (std::size_t i = 0; i < message.first_id.size(); ++i) {
    const std::uint64_t first = message.first_id[i], count = message.id_count[i];
    const std::string name = "first_id[" + std::to_string(i) + "] = " + std::to_string(first);
    if (first < next) faults.add(name + " is below " + std::to_string(next) + ", the next free id");
    if (count == 0 || first + count > std::uint64_t{1} << 32)
      faults.add(name + ": id_count = " + std::to_string(count) + " is outside 1 to " +
                 std::to_string((std::uint64_t{1} << 32) - first));
    next = first + count;
    sum += count;
  }
  if (sum != number)
    faults.add("id_count, its sum, = " + std::to_string(sum) + ", x has " + std::to_string(number) +
               " numbers");
}

void checkSizes(const CrowdView& m, Faults& faults) {
  const auto check = [&](const char* name, std::size_t size, std::size_t each) {
    if (size != each * m.x.size())
      faults.add(std::string(name) + " has " + std::to_string(size) + " numbers, " +
                 std::to_string(m.x.size()) + " walkers have " + std::to_string(each * m.x.size()));
  };
  if (m.x.size() > crowd::MOST_WALKERS)
    faults.add("walkers = " + std::to_string(m.x.size()) + " is outside 0 to " +
               std::to_string(crowd::MOST_WALKERS));
  check("y", m.y.size(), 1);
  check("ground", m.ground.size(), 1);
  check("heading", m.heading.size(), 1);
  check("gait", m.gait.size(), 1);
  check("turn_rate", m.turn_rate.size(), 1);
  check("height", m.height.size(), 1);
  check("velocity_x", m.velocity_x.size(), 1);
  check("velocity_y", m.velocity_y.size(), 1);
  check("feet_x", m.feet_x.size(), 2);
  check("feet_y", m.feet_y.size(), 2);
  check("feet_stand", m.feet_stand.size(), 1);
}

// The numbers that have values without a meaning.
void checkValues(const CrowdView& message, Faults& faults) {
  FieldChecker checker("", faults);
  const auto check = [&](const char* name, double value, Range range) {
    checker.number(name, value, "m", range);
  };
  check("origin_x", message.origin_x, VIEW_PLACES);
  check("origin_y", message.origin_y, VIEW_PLACES);
  check("ground_low", message.ground_low, VIEW_PLACES);
  check("ground_step", message.ground_step, GROUND_STEP_RANGE);
  for (std::size_t i = 0; i < message.height.size(); ++i)
    if (const double height = HEIGHT_STEP * message.height[i]; !BODY_HEIGHTS.contains(height))
      check(("height[" + std::to_string(i) + "]").c_str(), height, BODY_HEIGHTS);
  for (std::size_t i = 0; i < message.feet_stand.size(); ++i)
    if (message.feet_stand[i] > 3)
      faults.add("feet_stand[" + std::to_string(i) +
                 "] = " + std::to_string(message.feet_stand[i]) + " is outside 0 to 3");
}

crowd::Walker walkerAt(const CrowdView& m, std::size_t i) {
  crowd::Walker out;
  out.position = {m.origin_x + VIEW_STEP * m.x[i], m.origin_y + VIEW_STEP * m.y[i]};
  out.velocity = {VIEW_STEP * m.velocity_x[i], VIEW_STEP * m.velocity_y[i]};
  out.heading = 2.0 * PI * m.heading[i] / FRACTIONS;
  out.gait = m.gait[i] / FRACTIONS;
  out.turn_rate = TURN_STEP * m.turn_rate[i];
  out.height = HEIGHT_STEP * m.height[i];
  for (std::size_t side = 0; side < 2; ++side) {
    const crowd::Point at{VIEW_STEP * m.feet_x[2 * i + side], VIEW_STEP * m.feet_y[2 * i + side]};
    crowd::Foot& foot = out.feet[side];
    foot.stands = (m.feet_stand[i] >> side & 1) != 0;
    (foot.stands ? foot.planted : foot.offset) = foot.stands ? out.position + at : at;
  }
  return out;
}

constexpr std::size_t LONGEST_NAME = 60;
constexpr std::size_t CLIP_ANGLES = crowd::Clip::KEYS * crowd::CHANNELS;
constexpr std::size_t STYLE_ANGLES = 3 * CLIP_ANGLES;

void appendClip(const crowd::Clip& clip, CrowdMotions& out) {
  for (const crowd::ChannelAngles& key : clip.keys())
    for (const double angle : key) out.angles.push_back(static_cast<float>(angle));
}

crowd::Clip clipAt(const CrowdMotions& message, std::size_t first) {
  crowd::Clip::Keys keys;
  for (crowd::ChannelAngles& key : keys)
    for (double& angle : key) angle = static_cast<double>(message.angles[first++]);
  return crowd::Clip(keys);
}

void checkStyleSizes(const CrowdMotions& message, Faults& faults) {
  const std::size_t styles = message.names.size();
  const auto check = [&](const char* name, std::size_t size, std::size_t each) {
    if (size != each * styles)
      faults.add(std::string(name) + " has " + std::to_string(size) + " numbers, " +
                 std::to_string(styles) + " styles have " + std::to_string(each * styles));
  };
  check("stand_period", message.stand_period.size(), 1);
  check("angles", message.angles.size(), STYLE_ANGLES);
}

}  // namespace

CrowdView toView(const std::vector<crowd::Walker>& walkers, const terrain::HeightMap& terrain) {
  CrowdView out;
  if (!walkers.empty()) {
    out.origin_x = originOf(walkers.front().position.x);
    out.origin_y = originOf(walkers.front().position.y);
  }
  for (const crowd::Walker& walker : walkers) append(walker, out);
  appendGround(walkers, terrain, out);
  return out;
}

crowd::WalkerRounding viewRounding(const std::vector<crowd::Walker>& walkers,
                                   const terrain::HeightMap& terrain) {
  crowd::WalkerRounding out;
  out.place = out.velocity = 0.5 * VIEW_STEP;
  out.ground = 0.5 * groundStepOf(groundsOf(walkers, terrain));
  out.heading = PI / FRACTIONS;
  out.gait = 0.5 / FRACTIONS;
  out.turn_rate = 0.5 * TURN_STEP;
  out.height = 0.5 * HEIGHT_STEP;
  return out;
}

std::vector<WalkerView> fromMsg(const CrowdView& message) {
  Faults faults;
  checkSizes(message, faults);
  checkIds(message, message.x.size(), faults);
  faults.throwIfAny();
  checkValues(message, faults);
  faults.throwIfAny();
  std::vector<WalkerView> out;
  out.reserve(message.x.size());
  for (std::size_t run = 0; run < message.first_id.size(); ++run)
    for (std::uint32_t k = 0; k < message.id_count[run]; ++k) {
      const std::size_t i = out.size();
      out.push_back(
          {walkerAt(message, i), message.ground_low + message.ground_step * message.ground[i]});
      out.back().walker.id = message.first_id[run] + k;
    }
  return out;
}

CrowdMotions toMsg(const crowd::MotionStyles& styles) {
  CrowdMotions out;
  for (const crowd::MotionStyle& style : styles) {
    out.names.push_back(style.name);
    out.stand_period.push_back(style.stand_period);
    for (const crowd::Clip* clip : {&style.walk, &style.stand, &style.turn}) appendClip(*clip, out);
  }
  return out;
}

crowd::MotionStyles fromMsg(const CrowdMotions& message) {
  Faults faults;
  checkStyleSizes(message, faults);
  faults.throwIfAny();
  crowd::MotionStyles out;
  for (std::size_t i = 0; i < message.names.size(); ++i) {
    const std::size_t first = i * STYLE_ANGLES;
    out.push_back({message.names[i].substr(0, LONGEST_NAME), clipAt(message, first),
                   clipAt(message, first + CLIP_ANGLES), clipAt(message, first + 2 * CLIP_ANGLES),
                   message.stand_period[i]});
  }
  crowd::check(out, faults);
  faults.throwIfAny();
  return out;
}

}  // namespace vegetation_sim
