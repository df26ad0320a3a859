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

  /// Where a tool was at its last tick.
  struct LastCut {
    Vec3 position{Vec3::Zero()}, heading{Vec3::Zero()};
    Nanoseconds stamp{0};
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

  /// Returns the areas that the tools have swept since the last call, in the order of the tools. A
  /// tool that was missing, higher than its gate or off cuts its footprint first, as does one whose
  /// step is a jump by `longest_stroke` or `top_speed`.
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
