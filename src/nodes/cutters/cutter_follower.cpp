// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/cutters/cutter_follower.h"

#include <cmath>
#include <utility>

#include "nodes/cutters/followed_place.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double TURNED_OR_MOVED = 1e-6;  // [m] or [rad]
constexpr std::size_t LONGEST_CUTTER_NAME = 4096, CUT_BYTES = 58;

grass::CutterPose poseOf(const CutterFollower::LastCut& cut) {
  return {{cut.position.x(), cut.position.y()}, {cut.heading.x(), cut.heading.y()}};
}

bool isJump(const CutterFollower::LastCut& from, const CutterFollower::LastCut& to,
            const grass::TreadSettings& settings) {
  const double way = length(to.position - from.position);
  const double seconds = secondsBetween(from.stamp, to.stamp);
  return !(way <= settings.longest_stroke && way <= settings.top_speed * seconds);
}

bool stands(const CutterFollower::LastCut& from, const CutterFollower::LastCut& to) {
  return length(to.position - from.position) <= TURNED_OR_MOVED &&
         length(to.heading - from.heading) <= TURNED_OR_MOVED;
}

}  // namespace

CutterFollower::CutterFollower(std::string frame_id, std::vector<FollowedCutter> cutters,
                               const tf2_ros::Buffer& buffer, double wait)
    : frame_id_(std::move(frame_id)),
      cutters_(std::move(cutters)),
      lookup_(buffer, frame_id_, wait) {}

void CutterFollower::setEnabled(bool enabled) {
  state_.enabled = enabled;
  if (!enabled) state_.last.clear();
}

void CutterFollower::restore(State state) {
  state_.enabled = state.enabled;
  state_.last.clear();
  for (const FollowedCutter& cutter : cutters_)
    if (const auto found = state.last.find(cutter.name); found != state.last.end())
      state_.last[cutter.name] = found->second;
}

void CutterFollower::archive(Archive& a, State& state) {
  a.flag("cutters are on", state.enabled);
  a.map(
      "cutters", state.last, MOST_FOLLOWED, CUT_BYTES,
      [&a](std::string& name) { a.text("cutter", name, LONGEST_CUTTER_NAME); },
      [&a](const std::string&, LastCut& last) {
        a.vector("position of a cutter", last.position);
        a.vector("heading of a cutter", last.heading);
        a.stamp("stamp of a cutter", last.stamp);
      });
}

// Returns no place for a frame that is missing, old or points straight up.
std::optional<CutterFollower::LastCut> CutterFollower::find(const FollowedCutter& cutter,
                                                            Nanoseconds now) {
  try {
    const auto found = lookup_.find(cutter.frame);
    const Nanoseconds stamp = fromMsg(found.header.stamp);
    if (stamp != 0 && secondsBetween(stamp, now) > STALE) return std::nullopt;
    const Pose to_world = fromMsg(found.transform);
    Vec3 heading = rotate(to_world.orientation, Vec3(1.0, 0.0, 0.0));
    heading.z() = 0.0;
    const double size = length(heading);
    if (!(size > TURNED_OR_MOVED)) return std::nullopt;
    return LastCut{transformed(to_world, cutter.offset), heading / size, now};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::vector<grass::CutArea> CutterFollower::update(Nanoseconds now,
                                                   const terrain::HeightMap& terrain,
                                                   double height_gate,
                                                   const grass::TreadSettings& settings) {
  std::vector<grass::CutArea> out;
  missing_.clear();
  if (!state_.enabled) return out;
  lookup_.begin(now);
  for (const FollowedCutter& cutter : cutters_) {
    const std::optional<LastCut> here = find(cutter, now);
    if (!here) missing_.add(describeMissingTransform(cutter.frame, frame_id_));
    const bool is_down =
        here && here->position.z() - terrain.height(here->position.x(), here->position.y()) <=
                    cutter.height_gate.value_or(height_gate);
    if (!is_down) {
      state_.last.erase(cutter.name);
      continue;
    }
    const auto found = state_.last.find(cutter.name);
    const bool is_new = found == state_.last.end() || isJump(found->second, *here, settings);
    if (!is_new && stands(found->second, *here)) {
      found->second.stamp = now;
      continue;
    }
    const grass::CutterPose pose = poseOf(*here);
    if (is_new)
      out.push_back(footprintOf(cutter.cutter, pose));
    else
      for (grass::CutArea& area : sweep(cutter.cutter, poseOf(found->second), pose))
        out.push_back(std::move(area));
    state_.last[cutter.name] = *here;
  }
  return out;
}

}  // namespace vegetation_sim
