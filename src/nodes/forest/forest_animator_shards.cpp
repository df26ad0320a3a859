// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The services of the node, and which shards answer their requests.
#include <set>

#include "nodes/forest/forest_animator.h"

namespace vegetation_sim {

void ForestAnimator::connectServices() {
  serve("find_trees", &ForestAnimator::onFindTrees);  // the layout is that of all shards
  serveShared(
      "get_tree", &ForestAnimator::onGetTree,
      [this](const GetTree::Request& request) { return ownersOf(request.tree); }, Repeat::ALLOWED);
  serveShared(
      "find_branch", &ForestAnimator::onFindBranch,
      [this](const FindBranch::Request& request) { return ownersNear(request.point); },
      Repeat::ALLOWED, takeNearest<FindBranch::Response>);
  serveShared(
      "pick", &ForestAnimator::onPick,
      [this](const Pick::Request& request) { return ownersAlong(request); }, Repeat::ALLOWED,
      takeNearest<Pick::Response>);
  serveShared(
      "set_tf", &ForestAnimator::onSetTf,
      [this](const SetTf::Request& request) { return ownersOf(request.tree); }, Repeat::ALLOWED);
  serveShared(
      "grab", &ForestAnimator::onGrab,
      [this](const Grab::Request& request) { return ownersOfPlace(request); }, Repeat::FORBIDDEN);
  serveShared(
      "move_grab", &ForestAnimator::onMoveGrab,
      [this](const MoveGrab::Request& request) { return ownersOfGrab(request.id); },
      Repeat::ALLOWED);
  // All grabs, or that of an id.
  serveShared(
      "release", &ForestAnimator::onRelease,
      [this, to_all = toAllShards<Release::Request>()](Release::Request& request) {
        return request.all ? to_all(request) : ownersOfGrab(request.id);
      },
      Repeat::FORBIDDEN, joinReplies<Release::Response>);
  serveShared(
      "apply_force", &ForestAnimator::onApplyForce,
      [this](const ApplyForce::Request& request) { return ownersOfPlace(request); },
      Repeat::FORBIDDEN);
  serveShared(
      "cut_branch", &ForestAnimator::onCutBranch,
      [this](const CutBranch::Request& request) { return ownersOfPlace(request); },
      Repeat::FORBIDDEN);
  serveShared("cutting", &ForestAnimator::onCutting, toAllShards<std_srvs::SetBool::Request>(),
              Repeat::ALLOWED, joinReplies<std_srvs::SetBool::Response>);
}

// This shard says of a tree that is unknown that it is.
std::vector<std::uint32_t> ForestAnimator::ownersOf(std::uint32_t tree) {
  std::uint32_t owner = shards()->shard().index;
  shards()->runOnNode([&] {
    if (tree < forest_->layout().treeCount()) owner = forest_->owners().ownerOf(tree);
  });
  return {owner};
}

std::vector<std::uint32_t> ForestAnimator::ownersOfGrab(std::uint32_t id) const {
  return {id == 0 ? options_.shard->index : shardOfId(id, options_.shard->count)};
}

std::vector<std::uint32_t> ForestAnimator::ownersNear(const geometry_msgs::PointStamped& point) {
  std::vector<std::uint32_t> out;
  shards()->runOnNode([&] { out = grab_manager_.listOwnersNear(point); });
  if (out.empty()) out = {shards()->shard().index};  // it says that nothing is there
  return out;
}

std::vector<std::uint32_t> ForestAnimator::ownersAlong(const Pick::Request& request) {
  std::set<std::uint32_t> owners;
  shards()->runOnNode([&] {
    pickAlong(request, [&](std::uint32_t tree) {
      owners.insert(forest_->owners().ownerOf(tree));
      return false;
    });
  });
  if (owners.empty()) owners = {shards()->shard().index};
  return {owners.begin(), owners.end()};
}

// Only the owner of a tree knows where its branches are.
std::vector<std::uint32_t> ForestAnimator::ownersOfNearest(
    const geometry_msgs::PointStamped& point) {
  const std::vector<std::uint32_t> owners = ownersNear(point);
  if (owners.size() == 1) return owners;
  FindBranch::Request request;
  request.point = point;
  const FindBranch::Response found =
      takeNearest(askShards<FindBranch::Request, FindBranch::Response>(
          "find_branch", owners, request, Repeat::ALLOWED,
          [this](FindBranch::Request& own, FindBranch::Response& response) {
            onFindBranch(own, response);
          }));
  if (!found.success) throw InvalidInput(found.message, static_cast<FaultCode>(found.error_code));
  return ownersOf(found.tree);
}

template <class ServiceRequest>
std::vector<std::uint32_t> ForestAnimator::ownersOfPlace(const ServiceRequest& request) {
  return request.nearest ? ownersOfNearest(request.point) : ownersOf(request.tree);
}

}  // namespace vegetation_sim
