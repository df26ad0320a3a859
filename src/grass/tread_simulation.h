// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/grass/tread/tread_input.h"
#include "vegetation_sim/grass/tread/tread_update.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::grass {

/// State of a source.
struct TreadSourceState {
  std::uint32_t id{0};  ///< id in the TreadMap
  TreadInput last;
  Nanoseconds updated{0};       ///< stamp of its last input
  Nanoseconds pressed{0};       ///< stamp of its last press
  bool down{false};             ///< it is on the ground
  Vec3 velocity{Vec3::Zero()};  ///< [m/s]
  Vec3 before{Vec3::Zero()};    ///< position at an earlier stamp [m]
  Nanoseconds before_stamp{0};
  int column{-1}, row{-1};  ///< tile below it; -1: none
};

/// The state of the simulation (N6).
struct TreadSnapshot {
  Nanoseconds stamp{0};
  std::uint32_t next_id{1};
  std::map<std::string, TreadSourceState> sources;  ///< by name
  TreadState tread;
  CutState cuts;

  std::uint64_t hash() const;
};

/// Event: a source entered a tile of the map.
struct Entering {
  std::string source;
  int column{0}, row{0};
};

/// Drag of the grass on a source.
struct Drag {
  std::string source, body_frame;
  Vec3 at{Vec3::Zero()};     ///< point of application, world [m]
  Vec3 force{Vec3::Zero()};  ///< world [N]
};

/// Sources by name that tread a meadow: height gates, passes, drag and events (N3, N4). The trodden
/// ground is in a TreadMap, which must outlive it. One thread at a time.
class TreadSimulation {
 public:
  static constexpr std::size_t MOST_SOURCES = 4096;
  /// Limit of the work of one stroke; a hundred thousand take about a millisecond.
  static constexpr double MOST_STROKE_NODES = 5e7;
  /// A source without inputs for this time is removed [s].
  static constexpr double LEASE = 3.0;
  static constexpr double RENEWAL = 0.25;  ///< A standing source presses again after this time [s].

  /// @param tread of one shard or of all; each shard takes the inputs of all.
  TreadSimulation(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain,
                  const TreadSettings& treading, TreadMap& tread);

  const Layout& layout() const { return layout_; }
  /// Sets the drag of grass [N s/m], see resistanceAt().
  void setDrag(double drag) { drag_ = drag; }
  double drag() const { return drag_; }
  /// Sets the default law of sources, which is part of the layout.
  void setTreadLaw(const TreadLaw& law);

  /// Applies a checked input. @return a description of a problem of the step, such as a jump that
  /// left no track; empty if there is none. @throws InvalidInput if there are too many sources.
  std::string apply(const TreadInput& input, Nanoseconds stamp);
  /// @throws InvalidInput for a checked stroke that presses more than MOST_STROKE_NODES times a
  /// node.
  void checkStroke(const TreadInput& stroke) const;
  /// Returns how many nodes a checked input presses at most, each as often as it is pressed.
  double workOf(const TreadInput& input) const;
  /// Returns the work of a checked area, see CutMap::workOf().
  double workOf(const CutArea& area) const { return tread_.cuts().workOf(area); }
  /// Raises the grass within a disc; @throws InvalidInput for a disc out of
  /// range.
  void raise(const Point& centre, double radius);
  /// Cuts a checked area. @return the removed mass [kg]. @throws InvalidInput as checkCut() does.
  double cut(const CutArea& area) { return tread_.cuts().cut(*layout_.map, area); }
  /// @throws InvalidInput for an area with too many nodes.
  void checkCut(const CutArea& area) const { tread_.cuts().checkWork(area); }
  /// Raises the grass everywhere; sources begin new passes.
  void raiseAll();
  /// Ends a tick: removes silent sources, presses again below standing ones, frees what has
  /// recovered. @return the tiles of this shard that sources entered since the last call, in order.
  std::vector<Entering> advance(Nanoseconds stamp);
  /// Discards all state.
  void reset();

  /// Returns an update for replicas: a key frame, or what was pressed or cut since the last call.
  TreadUpdate update(bool key_frame);
  /// Returns a key frame of the included blocks only, and numbers no message.
  TreadUpdate keyFrameOf(const BlockFilter& includes) const;

  /// Returns the drag on each source that has a body and the grass of this shard ahead of it; it is
  /// zero above the gate and off the map.
  std::vector<Drag> drags() const;
  /// Returns the height of untrodden grass, or of its stubble [m].
  double heightAt(const Point& place) const;
  /// Returns the drag per speed on one metre of width [N/(m/s)]: drag * density * height * (1 -
  /// crush).
  double resistanceAt(const Point& place, Nanoseconds stamp) const;

  TreadSnapshot snapshot() const;
  void restore(TreadSnapshot memory);
  /// The snapshot as bytes, and back with all stamps moved by `shift`. Reading needs the same map.
  /// @throws InvalidInput for bytes that are no state of this map.
  std::string archived() const;
  TreadSnapshot readArchived(std::string bytes, Nanoseconds shift = 0) const;
  const std::map<std::string, TreadSourceState>& sources() const { return sources_; }
  Nanoseconds stamp() const { return stamp_; }
  const TreadMap& tread() const { return tread_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }

 private:
  /// The presses `first` to `last` of a stroke, of 0 to `count`, are those near the map.
  struct StrokeSteps {
    double count{1.0}, first{0.0}, last{-1.0};
  };
  StrokeSteps stepsOf(const TreadInput& stroke) const;
  double nodesOf(double presses, double reach, double step) const;
  TreadSourceState& sourceOf(const TreadInput& input);
  void press(TreadSourceState& source, const Vec3& to, Nanoseconds stamp);
  void enter(TreadSourceState& source, const Vec3& from, const Vec3& to);
  std::string move(TreadSourceState& source, const TreadInput& input, Nanoseconds stamp);
  void lift(TreadSourceState& source);
  void touch(const Vec3& from, const Vec3& to, double reach);

  Layout layout_;
  std::uint64_t layout_hash_;
  std::shared_ptr<const terrain::HeightMap> terrain_;
  TreadSettings treading_;
  TreadMap& tread_;
  double drag_{0.2};
  Nanoseconds stamp_{0};
  std::uint32_t next_id_{1};
  std::map<std::string, TreadSourceState> sources_;
  std::vector<Entering> entered_;
  std::set<std::pair<int, int>> touched_;  ///< blocks that changed since the last update
  Nanoseconds published_{0};               ///< stamp of the last update
  std::uint32_t sequence_{0};
};

}  // namespace vegetation_sim::grass
