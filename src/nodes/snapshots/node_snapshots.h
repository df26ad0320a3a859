// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/LoadSnapshot.h>
#include <vegetation_sim/SaveSnapshot.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nodes/snapshots/event_journal.h"
#include "nodes/snapshots/snapshot_folder.h"

namespace vegetation_sim {

/// A state that has been read and checked, and has changed nothing yet.
struct CheckedState {
  std::uint64_t hash{0};          ///< of the state
  std::function<void()> restore;  ///< makes it the state of the node
};

/// Functions of a node that NodeSnapshots calls.
struct SnapshotCalls {
  /// Returns the present state.
  std::function<SnapshotFile()> save;
  /// Hash of what the scenario fixes; a state of another scenario is rejected.
  std::function<std::uint64_t()> scene_hash;
  /// Reads a payload with all stamps moved. @throws InvalidInput if it is no state of this node.
  std::function<CheckedState(const std::string& payload, Nanoseconds shift)> read;
};

/// Snapshots and checkpoints of a node. A checkpoint is the snapshot of the name CHECKPOINT, with a
/// journal of the inputs and ticks after it.
class NodeSnapshots {
 public:
  static constexpr const char* CHECKPOINT = "checkpoint";

  /// @param kind of node, such as forest_animator. @param node resolved name.
  NodeSnapshots(const SnapshotOptions& options, const std::string& kind, const std::string& node,
                SnapshotCalls calls);

  const std::string& node() const { return folder_.node(); }
  /// Body of the service ~save_snapshot. @throws InvalidInput
  std::string save(const std::string& name, SaveSnapshot::Response& response) const;

  struct Loadable {
    SnapshotHeader header;
    Nanoseconds shift{0};
    CheckedState state;
    std::uint64_t key{0};  ///< of this file, for its journal
  };
  /// Reads a file and checks all of it. @param node whose file it is; empty: this one. @param now
  /// stamp at which the state is to continue; 0: its own. @throws InvalidInput that names the file.
  Loadable read(const std::string& name, const std::string& node, Nanoseconds now) const;
  /// Body of the service ~load_snapshot; without check_only, `loaded(state)` is called once the
  /// state is restored. @throws InvalidInput, and then nothing has changed.
  std::string load(const LoadSnapshot::Request& request, Nanoseconds now,
                   LoadSnapshot::Response& response,
                   const std::function<void(const Loadable&)>& loaded) const;

  /// Whether checkpoints are written.
  bool hasCheckpoints() const { return period_ > 0.0; }
  /// To be called after each tick: writes a checkpoint if the period has passed since the last one,
  /// its journal is large, or there is none.
  void checkpointIfDue(Nanoseconds stamp);
  /// Writes a checkpoint now.
  void checkpoint();
  /// Removes the checkpoint, whose ticks are no past of what follows.
  void dropCheckpoint();
  /// Adds a tick to the journal of the checkpoint.
  void addTick(JournalRecord tick) { journal_.add(std::move(tick)); }
  /// Adds an input that arrives between ticks. A journal that is large is replaced by a new
  /// checkpoint.
  void addInput(StoredEvent input);
  /// Returns the checkpoint with which the node begins, if it shall and there is one.
  std::optional<Loadable> readCheckpoint() const;
  /// Returns what has happened after a checkpoint.
  std::vector<JournalRecord> readJournal(const Loadable& checkpoint) const {
    return journal_.read(checkpoint.key);
  }

 private:
  bool begins_with_checkpoint_;
  double period_;  // [s]
  SnapshotFolder folder_;
  SnapshotCalls calls_;
  EventJournal journal_;
  std::optional<Nanoseconds> last_;  // stamp of the newest checkpoint
};

}  // namespace vegetation_sim
