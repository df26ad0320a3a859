// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/node_snapshots.h"

#include <ros/time.h>

#include <cstdio>
#include <utility>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_JOURNAL = 100'000'000;  // [bytes]

std::uint64_t keyOf(const SnapshotFile& snapshot) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(snapshot.header.stamp));
  hash.add(snapshot.payload);
  return hash.value();
}

}  // namespace

NodeSnapshots::NodeSnapshots(const SnapshotOptions& options, const std::string& kind,
                             const std::string& node, SnapshotCalls calls)
    : begins_with_checkpoint_(options.checkpoint),
      period_(options.checkpoint_period),
      folder_(options.folder, kind, node),
      calls_(std::move(calls)),
      journal_(hasCheckpoints() || options.checkpoint ? folder_.fileOf(CHECKPOINT, ".journal")
                                                      : "") {}

std::string NodeSnapshots::save(const std::string& name, SaveSnapshot::Response& response) const {
  const ros::WallTime begin = ros::WallTime::now();
  const SnapshotFile snapshot = calls_.save();
  response.file = folder_.fileOf(name);
  response.bytes = folder_.write(name, snapshot, true);
  response.stamp = toStamp(snapshot.header.stamp);
  response.hash = snapshot.header.state_hash;
  response.seconds = (ros::WallTime::now() - begin).toSec();
  return std::to_string(response.bytes) + " bytes in " + response.file;
}

NodeSnapshots::Loadable NodeSnapshots::read(const std::string& name, const std::string& node,
                                            Nanoseconds now) const {
  const SnapshotFile file = folder_.read(name, node);
  const SnapshotHeader& header = file.header;
  try {
    if (header.layout_hash != calls_.scene_hash())
      throw InvalidInput("scene hash = " + std::to_string(header.layout_hash) +
                         ", allowed is that of this node's scenario, " +
                         std::to_string(calls_.scene_hash()));
    Loadable out{header, now == 0 ? 0 : now - header.stamp, calls_.read(file.payload, 0),
                 keyOf(file)};
    if (out.state.hash != header.state_hash)
      throw InvalidInput("the state has the hash " + std::to_string(out.state.hash) +
                         ", allowed is that of the header, " + std::to_string(header.state_hash));
    if (out.shift != 0) out.state = calls_.read(file.payload, out.shift);
    return out;
  } catch (const std::exception& error) {
    throw InvalidInput("snapshot " + inQuotes(name) + ": " + error.what(),
                       FaultCode::FILE_REJECTED);
  }
}

std::string NodeSnapshots::load(const LoadSnapshot::Request& request, Nanoseconds now,
                                LoadSnapshot::Response& response,
                                const std::function<void(const Loadable&)>& loaded) const {
  const ros::WallTime begin = ros::WallTime::now();
  const Loadable found = read(request.name, request.node, now);
  if (!request.check_only) {
    found.state.restore();
    loaded(found);
  }
  response.stamp = toStamp(found.header.stamp + found.shift);
  response.hash = found.state.hash;
  response.shift = secondsBetween(0, found.shift);
  response.seconds = (ros::WallTime::now() - begin).toSec();
  return request.check_only ? "can be loaded" : "continues at the next tick";
}

void NodeSnapshots::checkpointIfDue(Nanoseconds stamp) {
  if (!hasCheckpoints()) return;
  if (!last_ || secondsBetween(*last_, stamp) >= period_ || journal_.size() > LARGEST_JOURNAL)
    checkpoint();
}

void NodeSnapshots::checkpoint() {
  if (!hasCheckpoints()) return;
  const SnapshotFile snapshot = calls_.save();
  last_ = snapshot.header.stamp;  // also if it fails, so that it is tried again after the period
  folder_.write(CHECKPOINT, snapshot, false);
  journal_.restart(keyOf(snapshot));
}

void NodeSnapshots::addInput(StoredEvent input) {
  journal_.add({0, {std::move(input)}});
  if (journal_.size() > LARGEST_JOURNAL) checkpoint();
}

// The snapshot goes first: without it the journal counts for nothing.
void NodeSnapshots::dropCheckpoint() {
  last_.reset();
  if (!hasCheckpoints()) return;
  std::remove(folder_.fileOf(CHECKPOINT).c_str());
  std::remove(folder_.fileOf(CHECKPOINT, ".journal").c_str());
}

std::optional<NodeSnapshots::Loadable> NodeSnapshots::readCheckpoint() const {
  if (!begins_with_checkpoint_ || !folder_.has(CHECKPOINT)) return std::nullopt;
  return read(CHECKPOINT, "", 0);
}

}  // namespace vegetation_sim
