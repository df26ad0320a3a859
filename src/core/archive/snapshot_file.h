// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Version of the content of snapshot files. Raise it with every change of what is archived: other
/// versions are rejected with an error that names them.
constexpr std::uint32_t SNAPSHOT_VERSION = 15;
/// Largest file that is read [bytes].
constexpr std::size_t LARGEST_SNAPSHOT = 2'000'000'000;

/// Header of a snapshot file: describes its content.
struct SnapshotHeader {
  std::string node;              ///< kind of node, such as forest_animator
  std::uint64_t layout_hash{0};  ///< of the layout that the state belongs to
  Nanoseconds stamp{0};          ///< of the state's last tick
  std::uint64_t state_hash{0};   ///< hash of the state
};

struct SnapshotFile {
  SnapshotHeader header;
  std::string payload;
};

/// The bytes of a file: magic text, version, header, length, payload, and a checksum over all
/// before it.
std::string encodeSnapshot(const SnapshotFile& snapshot);
/// @param name of the file, for errors. @throws InvalidInput that names file, thing, value and what
/// is allowed for any other bytes, another version or another kind of node.
SnapshotFile decodeSnapshot(const std::string& name, const std::string& bytes,
                            const std::string& node);

/// Replaces a file in one step: after a failure or a crash there is the old file or the new one.
/// @param durable the file also survives a power failure; costs some ten milliseconds.
/// @throws InvalidInput naming the file.
void replaceFile(const std::string& file, const std::string& bytes, bool durable);

/// @throws InvalidInput unless `name` is 1 to 64 letters, digits, '_', '-' or '.', and does not
/// begin with '.': the name of a file in a folder, and not a path.
void checkPlainName(const char* what, const std::string& name);

}  // namespace vegetation_sim
