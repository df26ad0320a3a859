// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Saving and loading of the wind.
#include <algorithm>

#include "core/archive/archive.h"
#include "nodes/wind/wind_broadcaster.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {

SnapshotCalls WindBroadcaster::snapshotCalls() {
  return {[this] { return snapshot(); }, [this] { return sceneHash(); },
          [this](const std::string& payload, Nanoseconds shift) {
            return readPayload(payload, shift);
          }};
}

// The breeze can change while the node runs.
std::uint64_t WindBroadcaster::sceneHash() const {
  WindSettings settings = settings_;
  auto& sources = settings.sources;
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                               [](const wind::Source& source) {
                                 return source.primitive.name == BreezeSettings::NAME;
                               }),
                sources.end());
  Hash hash;
  hash.add(initialSchedule(settings, NANOSECONDS_PER_SECOND).field().hash());
  for (const wind::Source& source : sources) {
    hash.add(source.primitive.name);
    hash.add(source.attached_frame);
  }
  return hash.value();
}

SnapshotFile WindBroadcaster::snapshot() const {
  Archive a;
  wind::PrimitiveSchedule schedule = schedule_;
  schedule.archive(a);
  FrameFollower::Attachments followed = follower_.attachments();
  follower_.archive(a, followed);
  BreezeSettings breeze = breeze_;
  a.fields("breeze", breeze);
  return {{name_, sceneHash(), clock_.now(), schedule_.field().hash()}, a.takeBytes()};
}

CheckedState WindBroadcaster::readPayload(const std::string& payload, Nanoseconds shift) {
  Archive a = Archive::reading(payload, shift);
  wind::PrimitiveSchedule schedule;
  schedule.archive(a);
  FrameFollower::Attachments followed;
  follower_.archive(a, followed);
  BreezeSettings breeze;
  a.fields("breeze", breeze);
  a.finish();
  return {schedule.field().hash(), [=] {
            schedule_ = schedule;
            follower_.restore(followed);
            breeze_ = breeze;
            publishField();
            showBreeze();
          }};
}

// A checkpoint of a later time is no past of this start.
bool WindBroadcaster::resume(Nanoseconds now) {
  bool resumed = false;
  acceptInput("checkpoint", [&] {
    const auto found = snapshots_.readCheckpoint();
    if (!found || found->header.stamp > now + BackwardStep::LARGEST_STEP) return;
    found->state.restore();
    resumed = true;
    reportCheckpoint(found->header.stamp);
    ROS_INFO("wind_broadcaster: continues from its checkpoint of %.9f s",
             secondsBetween(0, found->header.stamp));
  });
  return resumed;
}

}  // namespace vegetation_sim
