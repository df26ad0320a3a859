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

/// What is kept of a source.
struct TreadSourceState {
  std::uint32_t id{0};  ///< in the TreadMap
  TreadInput last;
  Nanoseconds updated{0};       ///< stamp of its last input
  Nanoseconds pressed{0};       ///< when its ground was
  bool down{false};             ///< it is on the ground
  Vec3 velocity{Vec3::Zero()};  ///< [m/s]
  Vec3 before{Vec3::Zero()};    ///< where it was at an earlier stamp [m]
  Nanoseconds before_stamp{0};
  int column{-1}, row{-1};  ///< tile that it is on; -1: none
};

/// All of a trodden field that has memory (N6).
struct TreadSnapshot {
  Nanoseconds stamp{0};
  std::uint32_t next_id{1};
  std::map<std::string, TreadSourceState> sources;  ///< by name
  TreadState tread;

  std::uint64_t hash() const;
};

/// A source came to a tile of the map.
struct Entering {
  std::string source;
  int column{0}, row{0};
};

/// Reaction on a source: what it pushes through resists.
struct Drag {
  std::string source, body_frame;
  Vec3 at{Vec3::Zero()};     ///< where it acts, world [m]
  Vec3 force{Vec3::Zero()};  ///< world [N]
};

/// Grass with what treads on it, by name: gates, passes, drag, who came where (N3, N4). What is
/// trodden is in a TreadMap, which must outlive it. One thread at a time.
class TreadSimulation {
 public:
  static constexpr std::size_t MOST_SOURCES = 4096;
  static constexpr double LEASE = 3.0;     ///< of a source that is told no more [s]
  static constexpr double RENEWAL = 0.25;  ///< a standing source presses again [s]

  TreadSimulation(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain,
                  const TreadSettings& treading, TreadMap& tread);

  const Layout& layout() const { return layout_; }
  /// Drag of grass [N s/m], see resistanceAt().
  void setDrag(double drag) { drag_ = drag; }
  /// Another law of sources that do not say their own, part of the layout.
  void setTreadLaw(const TreadLaw& law);

  /// Takes a checked input. @return what was wrong with the step, such as a jump that left no
  /// track; empty: nothing. @throws InvalidInput if there are too many sources.
  std::string apply(const TreadInput& input, Nanoseconds stamp);
  /// Raises a disc; radius 0: everything, and sources come down anew.
  void raise(const Point& centre, double radius);
  /// To the end of a tick: silent sources end, standing ones press again, what has recovered is
  /// freed. @return tiles that sources came to since the last call, in order.
  std::vector<Entering> advance(Nanoseconds stamp);
  /// Forgets everything: a fresh start.
  void reset();

  /// What a replica needs: all, or what was pressed since the last call.
  TreadUpdate update(bool key_frame);

  /// Drag on each source that has a body; zero above the gate and off the map.
  std::vector<Drag> drags() const;
  /// Drag per speed on one metre of width [N/(m/s)]: drag * density * height * (1 - crush).
  double resistanceAt(const Point& place, Nanoseconds stamp) const;

  TreadSnapshot snapshot() const;
  void restore(TreadSnapshot memory);
  const std::map<std::string, TreadSourceState>& sources() const { return sources_; }
  Nanoseconds stamp() const { return stamp_; }
  const TreadMap& tread() const { return tread_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }

 private:
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
  std::set<std::pair<int, int>> touched_;  ///< blocks, since the last update
  Nanoseconds published_{0};               ///< stamp of the last update
  std::uint32_t sequence_{0};
};

}  // namespace vegetation_sim::grass
