// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/archive/archive.h"

namespace vegetation_sim {

/// An event as the bytes of its message, with the input to which it refers by its hash.
struct StoredEvent {
  std::string message;
  std::string input;  ///< empty if it refers to none
};
void archive(Archive& a, std::vector<StoredEvent>& events);

/// A tick that a node has begun, and the events that it has applied there.
struct JournalTick {
  Nanoseconds stamp{0};
  std::vector<StoredEvent> events;
};

/// The ticks of a node since its last checkpoint, in a file. A tick is written when its inputs are
/// applied, so that a node that is killed at any instant finds all complete ticks. The functions
/// throw InvalidInput that names the file.
class EventJournal {
 public:
  explicit EventJournal(std::string file) : file_(std::move(file)) {}
  ~EventJournal();
  EventJournal(const EventJournal&) = delete;
  EventJournal& operator=(const EventJournal&) = delete;

  /// Forgets all ticks.
  void restart();
  /// Adds a tick; does nothing before the first restart().
  void add(JournalTick tick);
  /// Reads the ticks after a stamp, up to the first that is not complete. Without a file there are
  /// none.
  std::vector<JournalTick> read(Nanoseconds after) const;

 private:
  void close();

  std::string file_;
  int number_{-1};  // descriptor of the open file
};

}  // namespace vegetation_sim
