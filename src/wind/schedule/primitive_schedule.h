// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::wind {

/// The list of primitives behind a wind field, and the rules by which it is edited. Nothing changes
/// before `earliest`, the stamp from which on all subscribers can know. A successor fades in while
/// its predecessor fades out, over the longer of the two times. Only one such change of a source
/// runs at a time, and one that has not begun gives way to a later edit. Every edit is checked as a
/// whole and throws InvalidInput, with all faults, before anything has changed.
class PrimitiveSchedule {
 public:
  /// Time that an ended primitive is kept, so that late messages still see the past [ns].
  static constexpr Nanoseconds KEEP_EDITED = 30 * NANOSECONDS_PER_SECOND;
  static constexpr Nanoseconds KEEP_PIECES = 5 * NANOSECONDS_PER_SECOND;  ///< of a followed frame

  explicit PrimitiveSchedule(std::uint64_t seed = 0) : field_({}, seed) {}

  const Field& field() const { return field_; }

  /// Adds the sources of a scenario with their stamps as they are. Names must be unique.
  void start(const std::vector<Primitive>& primitives);

  /// Adds a source, or replaces the one of the same name. An epoch of 0 becomes the predecessor's
  /// if that is of the same kind, else t_on; a t_on of 0 becomes `earliest`. While an earlier
  /// change of the source is still fading in, t_on moves to its end.
  /// @return the new primitive, as published.
  /// @throws InvalidInput also if it had to wait longer than LONGEST_WAIT.
  Primitive set(Primitive primitive, Nanoseconds earliest);

  /// Does the same for the next piece of a followed frame: it takes over within its own fade_in,
  /// however long the piece before would fade out alone, and is kept for a shorter time.
  Primitive follow(Primitive primitive, Nanoseconds earliest);

  /// Ends the source of this name over its fade_out. @throws InvalidInput if there is none.
  void remove(const std::string& name, Nanoseconds earliest);

  /// Drops primitives that ended long ago. @return whether there was one.
  bool prune(Nanoseconds now);

  /// Returns the names of the sources that are active after `stamp`, in order of appearance.
  std::vector<std::string> names(Nanoseconds stamp) const;
  /// Returns the last primitive of a name that has not ended by `stamp`, if any.
  std::optional<Primitive> find(const std::string& name, Nanoseconds stamp) const;

  /// Writes or reads all of it. @throws InvalidInput when it reads.
  void archive(Archive& a);

 private:
  enum class Change { EDIT, PIECE };
  struct Entry {
    Primitive primitive;
    Nanoseconds keep;
  };
  using Entries = std::vector<Entry>;

  /// Returns when a source that has begun to fade in may be changed again. Adds a fault if the wait
  /// is too long.
  static Nanoseconds freeFrom(const Primitive& old, Nanoseconds wanted, Faults& faults);
  Primitive put(Primitive primitive, Nanoseconds earliest, Change change);
  static Entry* latest(Entries& entries, const std::string& name);
  static void dropPending(Entries& entries, const std::string& name, Nanoseconds earliest);
  /// Rebuilds the field first, and keeps the entries if it accepts them.
  void replaceEntries(Entries entries, std::uint32_t next_id);

  Entries entries_;
  std::uint32_t next_id_{1};
  Field field_;
};

}  // namespace vegetation_sim::wind
