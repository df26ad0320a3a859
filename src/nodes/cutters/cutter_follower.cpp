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
constexpr std::size_t LONGEST_CUTTER_NAME = 4096, CUT_BYTES = 66;

// Returns the place on the map; none for a frame that points straight up.
std::optional<grass::CutterPose> onMap(const Pose& pose) {
  const Vec3 heading = rotate(pose.orientation, Vec3(1.0, 0.0, 0.0));
  const double size = length(Vec3(heading.x(), heading.y(), 0.0));
  if (!(size > TURNED_OR_MOVED)) return std::nullopt;
  return grass::CutterPose{{pose.position.x(), pose.position.y()},
                           {heading.x() / size, heading.y() / size}};
}

bool isJump(const CutterFollower::LastCut& from, const CutterFollower::LastCut& to,
            const grass::TreadSettings& settings) {
  const double way = length(to.pose.position - from.pose.position);
  const double seconds = secondsBetween(from.stamp, to.stamp);
  return !(way <= settings.longest_stroke && way <= settings.top_speed * seconds);
}

bool isSame(const Pose& a, const Pose& b) {
  const auto differs = [&](const Vec3& axis) {
    return length(rotate(a.orientation, axis) - rotate(b.orientation, axis)) > TURNED_OR_MOVED;
  };
  return length(a.position - b.position) <= TURNED_OR_MOVED && !differs(Vec3::UnitX()) &&
         !differs(Vec3::UnitZ());
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
        a.pose("pose of a cutter", last.pose);
        a.stamp("stamp of a cutter", last.stamp);
      });
}

// Returns no place for a frame that is missing or old.
std::optional<CutterFollower::LastCut> CutterFollower::find(const FollowedCutter& cutter,
                                                            Nanoseconds now) {
  try {
    const auto found = lookup_.find(cutter.frame);
    const Nanoseconds stamp = fromMsg(found.header.stamp);
    if (stamp != 0 && secondsBetween(stamp, now) > STALE) return std::nullopt;
    const Pose to_world = fromMsg(found.transform);
    return LastCut{{transformed(to_world, cutter.offset), normalized(to_world.orientation)}, now};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::vector<CutterFollower::Stroke> CutterFollower::follow(Nanoseconds now,
                                                           const terrain::HeightMap& terrain,
                                                           double height_gate,
                                                           const grass::TreadSettings& settings) {
  std::vector<Stroke> out;
  missing_.clear();
  if (!state_.enabled) return out;
  lookup_.begin(now);
  for (const FollowedCutter& cutter : cutters_) {
    const std::optional<LastCut> here = find(cutter, now);
    if (!here) missing_.add(describeMissingTransform(cutter.frame, frame_id_));
    const bool is_down =
        here && here->pose.position.z() -
                        terrain.height(here->pose.position.x(), here->pose.position.y()) <=
                    cutter.height_gate.value_or(height_gate);
    if (!is_down) {
      state_.last.erase(cutter.name);
      continue;
    }
    Stroke stroke{&cutter, std::nullopt, here->pose};
    const auto found = state_.last.find(cutter.name);
    if (found != state_.last.end() && !isJump(found->second, *here, settings)) {
      stroke.from = found->second.pose;
      stroke.stands = isSame(found->second.pose, here->pose);
    }
    if (stroke.stands)
      found->second.stamp = now;
    else
      state_.last[cutter.name] = *here;
    out.push_back(stroke);
  }
  return out;
}

std::vector<grass::CutArea> CutterFollower::update(Nanoseconds now,
                                                   const terrain::HeightMap& terrain,
                                                   double height_gate,
                                                   const grass::TreadSettings& settings) {
  std::vector<grass::CutArea> out;
  for (const Stroke& stroke : follow(now, terrain, height_gate, settings)) {
    const auto to = onMap(stroke.to);
    if (stroke.stands || !to) continue;
    const auto from = stroke.from ? onMap(*stroke.from) : std::nullopt;
    const grass::Cutter& tool = stroke.tool->cutter;
    const auto areas =
        from ? sweep(tool, *from, *to) : std::vector<grass::CutArea>{footprintOf(tool, *to)};
    out.insert(out.end(), areas.begin(), areas.end());
  }
  return out;
}

}  // namespace vegetation_sim
