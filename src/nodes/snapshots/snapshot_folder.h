// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/archive/snapshot_file.h"
#include "ros/params/parameters.h"

namespace vegetation_sim {

/// Parameters of every node whose state can be saved.
struct SnapshotOptions {
  std::string folder;             ///< of all snapshots; an absolute path
  double checkpoint_period{0.0};  ///< [s]; 0: none
  bool checkpoint{false};         ///< the node begins with its newest checkpoint
};
/// The folder is by default vegetation_sim in the folder of ROS.
void readSnapshotOptions(Parameters& parameters, SnapshotOptions& options);

/// The snapshot files of one node: FOLDER/NAME/NODE.snapshot. Nodes may share the folder, so that a
/// scene is a name. All functions throw InvalidInput that names the file.
class SnapshotFolder {
 public:
  /// @param kind of node, such as forest_animator. @param node resolved name.
  SnapshotFolder(std::string folder, std::string kind, const std::string& node);

  const std::string& node() const { return node_; }
  /// Path of a file of this node or of another one. Names of nodes may have slashes.
  std::string fileOf(const std::string& name, const char* ending = ".snapshot") const;
  /// Writes a file, and the folders that it needs. @return its size [bytes].
  std::size_t write(const std::string& name, const SnapshotFile& snapshot, bool durable) const;
  /// Reads a file. @param node that has written it; empty: this one.
  SnapshotFile read(const std::string& name, const std::string& node = "") const;
  bool has(const std::string& name) const;

 private:
  std::string pathOf(const std::string& name, const std::string& node, const char* ending) const;

  std::string folder_, kind_, node_;
};

/// Returns the content of a file of at most `most` bytes; nothing if there is no such file.
/// @throws InvalidInput that names the file.
std::optional<std::string> contentOf(const std::string& file, std::size_t most);

}  // namespace vegetation_sim
