// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The services of the node, and which shards answer their requests.
#include <set>

#include "grass/map/tile_owners.h"
#include "nodes/grass/grass_field.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::int64_t TICKS_AHEAD = 6;  // so that all shards have the request before its tick

// Each shard knows the samples of its own ground; those of others are not inside. Lists may differ
// in length, since they are of other processes.
SampleGrass::Response mergeSamples(const std::vector<ShardReply<SampleGrass::Response>>& replies) {
  for (const auto& reply : replies)
    if (!reply.response.success) return reply.response;
  SampleGrass::Response out = replies.front().response;
  for (const auto& reply : replies)
    for (std::size_t i = 0; i < out.samples.size(); ++i)
      if (i < reply.response.samples.size() && reply.response.samples[i].inside)
        out.samples[i] = reply.response.samples[i];
  return out;
}

}  // namespace

// Treads, cuts and raised grass concern each shard whose tiles they touch, and all shards know the
// cuts of all.
void GrassField::connectServices() {
  serveShared(
      "tread", &GrassField::onTreadPath,
      [this](Tread::Request& request) { return askAllAtOneTick(request); }, Repeat::FORBIDDEN,
      joinReplies<Tread::Response>);
  serveShared(
      "cut", &GrassField::onCut,
      [this](CutGrass::Request& request) { return askAllAtOneTick(request); }, Repeat::FORBIDDEN,
      joinReplies<CutGrass::Response>);
  serveShared("clear", &GrassField::onClear, toAllShards<ClearGrass::Request>(), Repeat::ALLOWED,
              joinReplies<ClearGrass::Response>);
  serveShared("set_colours", &GrassField::onSetColours, toAllShards<SetGrassColours::Request>(),
              Repeat::ALLOWED, joinReplies<SetGrassColours::Response>);
  serveShared("cutting", &GrassField::onCutting, toAllShards<std_srvs::SetBool::Request>(),
              Repeat::ALLOWED, joinReplies<std_srvs::SetBool::Response>);
  serveShared(
      "sample", &GrassField::onSample,
      [this](SampleGrass::Request& request) { return ownersOfPoints(request); }, Repeat::ALLOWED,
      mergeSamples);
}

// A request for the next tick is made one for a tick that no shard has reached.
template <class ServiceRequest>
std::vector<std::uint32_t> GrassField::askAllAtOneTick(ServiceRequest& request) {
  if (request.header.stamp.isZero())
    shards()->runOnNode([&] {
      if (clock_.hasBegun())
        request.header.stamp = toStamp(clock_.grid().timeOf(clock_.tick() + TICKS_AHEAD));
    });
  return toAllShards<ServiceRequest>()(request);
}

std::vector<std::uint32_t> GrassField::ownersOfPoints(const SampleGrass::Request& request) {
  std::set<std::uint32_t> owners;
  shards()->runOnNode([&] {
    const Pose to_world = poseOf(request.header.frame_id);
    for (const geometry_msgs::Point& point : request.points) {
      const Vec3 place = transformed(to_world, Vec3(point.x, point.y, 0.0));
      owners.insert(field_->tread().owners().ownerAt(place.x(), place.y()));
    }
  });
  if (owners.empty()) owners = {shards()->shard().index};  // it says that there are no points
  return {owners.begin(), owners.end()};
}

}  // namespace vegetation_sim
