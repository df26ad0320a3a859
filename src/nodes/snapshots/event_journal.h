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

/// A tick that a node has begun and the events that it has applied there, or inputs that have
/// arrived between ticks.
struct JournalRecord {
  Nanoseconds stamp{0};  ///< of the tick; 0: the events are inputs that wait
  std::vector<StoredEvent> events;
};

/// Returns the records in the bytes of a journal up to the first that is not complete; none if they
/// continue another checkpoint. @throws InvalidInput for a complete record that is none.
std::vector<JournalRecord> readRecords(const std::string& bytes, std::uint64_t checkpoint);

/// The inputs and ticks of a node since its last checkpoint, in a file. An input is written when it
/// arrives and a tick when its inputs are applied, so that a node that is killed at any instant
/// finds all of them. The functions throw InvalidInput that names the file.
class EventJournal {
 public:
  explicit EventJournal(std::string file) : file_(std::move(file)) {}
  ~EventJournal();
  EventJournal(const EventJournal&) = delete;
  EventJournal& operator=(const EventJournal&) = delete;

  /// Forgets all records; what follows continues the checkpoint of a key.
  void restart(std::uint64_t checkpoint);
  /// Adds a record; does nothing before the first restart().
  void add(JournalRecord record);
  /// Size of the file [bytes]; 0 before the first restart().
  std::size_t size() const { return size_; }
  /// Reads the records up to the first that is not complete. There are none without a file, or if
  /// they continue another checkpoint.
  std::vector<JournalRecord> read(std::uint64_t checkpoint) const;

 private:
  void close();
  void write(const std::string& bytes);

  std::string file_;
  int number_{-1};  // descriptor of the open file
  std::size_t size_{0};
};

}  // namespace vegetation_sim
