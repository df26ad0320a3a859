// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/forest_conversions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "ros/conversions/grab_conversions.h"
#include "ros/conversions/orientation.h"
#include "tree/growth/broken_branch.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SPECIES = 256;
constexpr double VIEW_ASPECT = 16.0 / 9.0;         // width of the picture over its height
constexpr double VIEW_MARGIN = 0.15;               // [rad]
constexpr double LARGEST_BEND = 100.0;             // [rad]
constexpr double LARGEST_RATE = 1e5;               // [rad/s]
constexpr std::size_t MOST_MODES = 256;            // of a tree
constexpr std::ptrdiff_t MOST_MODAL_TREES = 1000;  // as modal_trees allows

/// Names of the values of each choice of a structure, by field.
class Choices : public FieldVisitor {
 public:
  void number(const char*, double&, const char*, Range) override {}
  void integer(const char*, int&, const char*, Range) override {}
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char* name, int&, const std::vector<std::string>& words) override {
    words_[name] = words;
  }
  const std::vector<std::string>& of(const std::string& name) const { return words_.at(name); }

 private:
  std::map<std::string, std::vector<std::string>> words_;
};

const Choices& choicesOfMotion() {
  static const Choices CHOICES = [] {
    Choices out;
    forest::MotionLaw law;
    describe(out, law);
    return out;
  }();
  return CHOICES;
}

template <class Enum>
const std::string& wordOf(const std::string& name, Enum value) {
  return choicesOfMotion().of(name).at(static_cast<std::size_t>(value));
}

template <class Enum>
Enum valueOf(const std::string& name, const std::string& word, Faults& faults) {
  const std::vector<std::string>& names = choicesOfMotion().of(name);
  std::string allowed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) return static_cast<Enum>(i);
    allowed += (i ? ", " : "") + names[i];
  }
  faults.add("layout: " + name + " = " + inQuotes(word) + " is none of " + allowed);
  return Enum{};
}

ForestTile tileToMsg(const forest::Tile& tile) {
  ForestTile out;
  out.first_tree = tile.first_tree;
  out.count = tile.count;
  out.seed = tile.seed;
  out.x = tile.x;
  out.y = tile.y;
  out.size = tile.size;
  out.mix = tile.mix;
  return out;
}

forest::Tile tileFromMsg(const ForestTile& message) {
  forest::Tile out;
  out.first_tree = message.first_tree;
  out.count = message.count;
  out.seed = message.seed;
  out.x = message.x;
  out.y = message.y;
  out.size = message.size;
  out.mix = message.mix;
  return out;
}

// A level that was settled when it was set needs no blend.
std::vector<float> blendToMsg(const forest::LevelState& state, Nanoseconds now) {
  if (state.since <= now && state.blend == forest::LevelState::settled(state.level).blend)
    return {};
  return {state.blend.begin(), state.blend.end()};
}

forest::LevelState levelFromMsg(const std::string& name, int level, const ros::Time& since,
                                const std::vector<float>& blend, Faults& faults) {
  if (level > forest::MODAL_LEVEL) {
    faults.add(name + "level = " + std::to_string(level) + " is outside 0 to " +
               std::to_string(forest::MODAL_LEVEL));
    return {};
  }
  forest::LevelState out = forest::LevelState::settled(level);
  out.since = fromMsg(since);
  if (blend.empty()) return out;
  if (blend.size() != out.blend.size()) {
    faults.add(name + "blend has " + std::to_string(blend.size()) + " entries, allowed are 0 or " +
               std::to_string(out.blend.size()));
    return out;
  }
  for (std::size_t d = 0; d < blend.size(); ++d) {
    const std::string fault = rangeFault(name + "blend", blend[d], "", {0.0, 1.0});
    if (!fault.empty()) faults.add(fault);
    out.blend[d] = blend[d];
  }
  return out;
}

TreeState entryToMsg(const forest::StateUpdate::Entry& entry, Nanoseconds now) {
  TreeState out;
  out.tree = entry.tree;
  out.level = static_cast<std::uint8_t>(entry.state.level);
  out.since = toStamp(entry.state.since);
  out.blend = blendToMsg(entry.state, now);
  out.promoted.reserve(entry.promoted.size());
  for (const forest::PromotedBranch& branch : entry.promoted) out.promoted.push_back(toMsg(branch));
  out.amplitude = entry.modal.amplitude;
  out.rate = entry.modal.rate;
  for (const forest::BrokenBranch& broken : entry.broken) out.broken.push_back(toMsg(broken));
  return out;
}

std::vector<forest::PromotedBranch> promotedFromMsg(const std::string& name,
                                                    const std::vector<PromotedBranch>& promoted,
                                                    Faults& faults) {
  std::vector<forest::PromotedBranch> out;
  std::int64_t last = -1;
  for (const PromotedBranch& branch : promoted) {
    const std::string joint = name + "branch " + std::to_string(branch.branch) + ": ";
    if (branch.branch <= last || branch.branch >= forest::MAX_BRANCHES)
      faults.add(joint + "branch is not above the one before, or not below " +
                 std::to_string(forest::MAX_BRANCHES));
    last = branch.branch;
    for (const auto& [field, value, range] :
         {std::make_tuple("first", branch.first, LARGEST_BEND),
          std::make_tuple("second", branch.second, LARGEST_BEND),
          std::make_tuple("first_rate", branch.first_rate, LARGEST_RATE),
          std::make_tuple("second_rate", branch.second_rate, LARGEST_RATE)}) {
      const std::string fault = rangeFault(joint + field, value, "", {-range, range});
      if (!fault.empty()) faults.add(fault);
    }
    out.push_back(fromMsg(branch));
  }
  return out;
}

forest::BrokenBranches brokenFromMsg(const std::string& name,
                                     const std::vector<BrokenBranch>& broken, Faults& faults) {
  forest::BrokenBranches out;
  for (const BrokenBranch& piece : broken) {
    const std::string branch = name + "broken branch " + std::to_string(piece.branch) + ": ";
    out.push_back(fromMsg(piece));
    check(out.back(), branch, faults);
  }
  return out;
}

physics::ModalState modalStateFromMsg(const std::string& name, const TreeState& tree,
                                      Faults& faults) {
  if (tree.amplitude.size() != tree.rate.size() || tree.amplitude.size() > MOST_MODES)
    faults.add(name + std::to_string(tree.amplitude.size()) + " amplitudes and " +
               std::to_string(tree.rate.size()) + " rates; allowed are as many, up to " +
               std::to_string(MOST_MODES));
  for (const auto* values : {&tree.amplitude, &tree.rate})
    for (const double value : *values) {
      const std::string fault = rangeFault(name + "mode", value, "", {-LARGEST_RATE, LARGEST_RATE});
      if (!fault.empty()) faults.add(fault);
    }
  return {tree.amplitude, tree.rate};
}

}  // namespace

PromotedBranch toMsg(const forest::PromotedBranch& branch) {
  PromotedBranch out;
  out.branch = static_cast<std::uint32_t>(branch.branch);
  out.first = branch.q.first;
  out.second = branch.q.second;
  out.first_rate = branch.rate.first;
  out.second_rate = branch.rate.second;
  if (branch.blend != forest::NEVER) out.blend = toStamp(branch.blend);
  return out;
}

forest::PromotedBranch fromMsg(const PromotedBranch& message) {
  forest::PromotedBranch out;
  out.branch = static_cast<int>(message.branch);
  out.q = {message.first, message.second};
  out.rate = {message.first_rate, message.second_rate};
  if (!message.blend.isZero()) out.blend = fromMsg(message.blend);
  return out;
}

TreeSeed toMsg(const forest::TreeSeed& seed) {
  TreeSeed out;
  out.seed = seed.seed;
  out.species = seed.species;
  out.position.x = seed.position.x();
  out.position.y = seed.position.y();
  out.position.z = seed.position.z();
  out.yaw = seed.yaw;
  out.scale = seed.scale;
  return out;
}

forest::TreeSeed fromMsg(const TreeSeed& message) {
  forest::TreeSeed out;
  out.seed = message.seed;
  out.species = message.species;
  out.position = Vec3(message.position.x, message.position.y, message.position.z);
  out.yaw = message.yaw;
  out.scale = message.scale;
  return out;
}

ForestLayout toMsg(const forest::Layout& layout) {
  ForestLayout out;
  out.hash = layout.hash();
  for (const forest::Species& species : layout.species) {
    Species message;
    message.name = species.name;
    message.rules = forest::writeSpecies(species);
    out.species.push_back(message);
  }
  out.terrain = layout.terrain;
  out.terrain_hash = layout.terrain_hash;
  out.joint_model = wordOf("joint_model", layout.motion.joint_model);
  out.gain = wordOf("gain", layout.motion.gain);
  out.drag = wordOf("drag", layout.motion.drag);
  out.transition = layout.motion.transition;
  out.transition_shape = wordOf("transition_shape", layout.motion.transition_shape);
  for (const forest::TreeSeed& seed : layout.trees) out.trees.push_back(toMsg(seed));
  for (const forest::Tile& tile : layout.tiles) out.tiles.push_back(tileToMsg(tile));
  return out;
}

forest::Layout fromMsg(const ForestLayout& message) {
  Faults faults;
  forest::Layout out;
  if (message.species.size() > MOST_SPECIES)
    throw InvalidInput("layout: " + std::to_string(message.species.size()) +
                       " species, more than the " + std::to_string(MOST_SPECIES) + " allowed");
  std::vector<NamedText> rules;
  for (const Species& species : message.species) rules.push_back({species.name, species.rules});
  if (!keepLimits("layout: species", rules, faults)) faults.throwIfAny();
  for (const Species& species : message.species) {
    try {
      out.species.push_back(
          forest::parseSpecies(species.rules, "species " + shortened(species.name)));
    } catch (const InvalidInput& error) {
      faults.add(error.what());
    }
  }
  out.terrain = message.terrain;
  out.terrain_hash = message.terrain_hash;
  out.motion.joint_model = valueOf<forest::JointModel>("joint_model", message.joint_model, faults);
  out.motion.gain = valueOf<forest::Gain>("gain", message.gain, faults);
  out.motion.drag = valueOf<forest::Drag>("drag", message.drag, faults);
  out.motion.transition = message.transition;
  out.motion.transition_shape =
      valueOf<forest::TransitionShape>("transition_shape", message.transition_shape, faults);
  for (const TreeSeed& seed : message.trees) out.trees.push_back(fromMsg(seed));
  for (const ForestTile& tile : message.tiles) out.tiles.push_back(tileFromMsg(tile));
  if (faults.empty()) check(out, faults);
  faults.throwIfAny();
  return out;
}

ForestState toMsg(const forest::StateUpdate& update) {
  ForestState out;
  out.header.stamp = toStamp(update.stamp);
  out.sequence = update.sequence;
  out.key_frame = update.key_frame;
  out.base_level = static_cast<std::uint8_t>(update.base.level);
  out.base_since = toStamp(update.base.since);
  out.base_blend = blendToMsg(update.base, update.stamp);
  out.blend_time = update.blend;
  out.layout_hash = update.layout_hash;
  out.wind_hash = update.wind_hash;
  out.hash = update.hash;
  out.trees_hash = update.trees_hash;
  out.shard = update.shard;
  out.shards = update.shards;
  out.trees.reserve(update.trees.size());
  for (const auto& entry : update.trees) out.trees.push_back(entryToMsg(entry, update.stamp));
  return out;
}

forest::StateUpdate fromMsg(const ForestState& message) {
  Faults faults;
  forest::StateUpdate out;
  out.stamp = fromMsg(message.header.stamp);
  out.sequence = message.sequence;
  out.key_frame = message.key_frame;
  out.base = levelFromMsg("state: base_", message.base_level, message.base_since,
                          message.base_blend, faults);
  out.blend = message.blend_time;
  const std::string blend_fault = rangeFault("state: blend_time", out.blend, "s", {0.0, 3600.0});
  if (!blend_fault.empty()) faults.add(blend_fault);
  out.layout_hash = message.layout_hash;
  out.wind_hash = message.wind_hash;
  out.hash = message.hash;
  out.trees_hash = message.trees_hash;
  out.shard = message.shard;
  out.shards = std::max<std::uint32_t>(1, message.shards);
  check(Shard{out.shard, out.shards}, faults);
  const auto modal = std::count_if(message.trees.begin(), message.trees.end(),
                                   [](const TreeState& tree) { return !tree.amplitude.empty(); });
  if (modal > MOST_MODAL_TREES)
    faults.add("state: " + std::to_string(modal) + " trees in modes, allowed are 0 to " +
               std::to_string(MOST_MODAL_TREES));
  std::size_t broken = 0;
  for (const TreeState& tree : message.trees) broken += tree.broken.size();
  if (broken > forest::MOST_BROKEN)
    throw InvalidInput("state: " + std::to_string(broken) + " broken branches, allowed are 0 to " +
                       std::to_string(forest::MOST_BROKEN));
  for (const TreeState& tree : message.trees) {
    const std::string name = "state: tree " + std::to_string(tree.tree) + ": ";
    out.trees.push_back({tree.tree, levelFromMsg(name, tree.level, tree.since, tree.blend, faults),
                         promotedFromMsg(name, tree.promoted, faults),
                         modalStateFromMsg(name, tree, faults),
                         brokenFromMsg(name, tree.broken, faults)});
  }
  faults.throwIfAny();
  return out;
}

geometry_msgs::Pose toMsg(const Vec3& foot, const Pose& pose) {
  geometry_msgs::Pose out;
  const Vec3 position = foot + pose.position;
  out.position.x = position.x();
  out.position.y = position.y();
  out.position.z = position.z();
  out.orientation.w = pose.orientation.w;
  out.orientation.x = pose.orientation.x;
  out.orientation.y = pose.orientation.y;
  out.orientation.z = pose.orientation.z;
  return out;
}

BranchTransforms toMsg(std::uint32_t tree, const Vec3& foot, const std::vector<Pose>& poses) {
  BranchTransforms out;
  out.tree = tree;
  out.poses.reserve(poses.size());
  for (const Pose& pose : poses) out.poses.push_back(toMsg(foot, pose));
  return out;
}

forest::Viewer fromMsg(const Viewer& message) {
  Faults faults;
  const auto check_number = [&](const char* name, double value, const char* unit, Range range) {
    const std::string fault = rangeFault(std::string("viewer: ") + name, value, unit, range);
    if (!fault.empty()) faults.add(fault);
  };
  const auto& p = message.pose.position;
  check_number("pose.position.x", p.x, "m", {-1e7, 1e7});
  check_number("pose.position.y", p.y, "m", {-1e7, 1e7});
  check_number("pose.position.z", p.z, "m", {-1e7, 1e7});
  const Quat turn = orientationOf(message.pose.orientation, "viewer: pose.orientation", faults);
  check_number("field_of_view", message.field_of_view, "rad", {0.01, 3.1});
  check_number("height", message.height, "pixel", {1.0, 100000.0});
  if (message.id.size() > 256) faults.add("viewer: id is longer than 256 characters");
  faults.throwIfAny();
  forest::Viewer out;
  out.id = message.id;
  out.stamp = fromMsg(message.header.stamp);
  out.eye.position = Vec3(p.x, p.y, p.z);
  const SinCos half = sinCos(0.5 * message.field_of_view);
  out.eye.pixels_per_radian = 0.5 * message.height * half.cos / half.sin;
  out.eye.forward = axisX(turn) / length(axisX(turn));
  // The cone around the whole picture, whatever its width up to VIEW_ASPECT, and a margin for
  // turning.
  const double corner = half.sin * std::sqrt(1.0 + VIEW_ASPECT * VIEW_ASPECT);
  out.eye.cone_cosine = sinCos(arcTangent(corner, half.cos) + VIEW_MARGIN).cos;
  return out;
}

forest::Sensor fromMsg(const SensorInterest& message) {
  const auto& p = message.position;
  forest::Sensor out{message.id, Vec3(p.x, p.y, p.z), message.range, message.tolerance,
                     fromMsg(message.header.stamp)};
  Faults faults;
  FieldChecker checker("sensor: ", faults);
  checker.vector("position", out.position, "m", {-1e7, 1e7});
  checker.number("range", out.range, "m", {0.0, 1000.0});
  checker.number("tolerance", out.tolerance, "m", {1e-4, 10.0});
  if (message.id.size() > 256) faults.add("sensor: id is longer than 256 characters");
  faults.throwIfAny();
  return out;
}

SensorInterest toMsg(const forest::Sensor& sensor) {
  SensorInterest out;
  out.header.stamp = toStamp(sensor.stamp);
  out.id = sensor.id;
  out.position = toPoint(sensor.position);
  out.range = sensor.range;
  out.tolerance = sensor.tolerance;
  return out;
}

}  // namespace vegetation_sim
