// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "nodes/cutters/followed_cutter.h"
#include "ros/services/frame_lookup.h"
#include "ros/services/missing_inputs.h"
#include "vegetation_sim/grass/tread/tread_map.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {

/// Cutting tools that follow tf frames. The node asks at each tick; a replay needs no tf, since the
/// cuts are events.
class CutterFollower {
 public:
  /// A tool whose transform is older has left the ground [s].
  static constexpr double STALE = 0.5;

  /// Where the middle of a tool was at its last tick.
  struct LastCut {
    Pose pose;
    Nanoseconds stamp{0};
  };
  /// The way of a tool since its last tick.
  struct Stroke {
    const FollowedCutter* tool;
    std::optional<Pose> from;  ///< none: it was missing, off or higher than its gate, or has jumped
    Pose to;
    bool stands{false};  ///< it has not moved
  };
  /// State to be saved: whether tools cut, and the last place of each tool on the ground by its
  /// name.
  struct State {
    bool enabled{true};
    std::map<std::string, LastCut> last;
  };

  /// `buffer` must outlive it. @param wait for the transforms of a tick [s], see FrameLookup.
  CutterFollower(std::string frame_id, std::vector<FollowedCutter> cutters,
                 const tf2_ros::Buffer& buffer, double wait);

  /// Returns the ways of the tools that are below their gates, in the order of the tools. A step is
  /// a jump by `longest_stroke` or `top_speed`.
  std::vector<Stroke> follow(Nanoseconds now, const terrain::HeightMap& terrain, double height_gate,
                             const grass::TreadSettings& settings = {});
  /// Follows the tools and returns the areas that they have swept. One without a way cuts its
  /// footprint, one that points straight up nothing.
  std::vector<grass::CutArea> update(Nanoseconds now, const terrain::HeightMap& terrain,
                                     double height_gate, const grass::TreadSettings& settings);
  void setEnabled(bool enabled);
  /// Forgets all places, after a jump of time.
  void clear() { state_.last.clear(); }

  const State& state() const { return state_; }
  void restore(State state);
  static void archive(Archive& a, State& state);
  MissingInputs& missing() { return missing_; }
  /// Number of transforms that have not come in time for their tick.
  std::size_t late() const { return lookup_.late(); }

 private:
  std::optional<LastCut> find(const FollowedCutter& cutter, Nanoseconds now);

  std::string frame_id_;
  std::vector<FollowedCutter> cutters_;
  FrameLookup lookup_;
  State state_;
  MissingInputs missing_;
};

}  // namespace vegetation_sim
