// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>

#include "forest/pick.h"
#include "forest/trees_around.h"
#include "nodes/cutters/cut_request.h"
#include "nodes/forest/forest_animator.h"
#include "nodes/forest/tree_requests.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
Nanoseconds ForestAnimator::stampOf(const ros::Time& stamp) const {
  return stamp.isZero() ? forest_->snapshot().stamp : fromMsg(stamp);
}

bool ForestAnimator::onGetTree(GetTree::Request& request, GetTree::Response& response) {
  return answer(response, [&] {
    const Nanoseconds stamp = stampOf(request.stamp);
    const auto grown = cache_.get(*forest_, request.tree);
    forest_->owners().requireOwned("get_tree", request.tree);
    const forest::Skeleton& skeleton = grown->tree.skeleton;
    response.seed = toMsg(grown->tree.seed);
    response.species = forest_->layout().species[grown->tree.seed.species].name;
    const auto level_in = [&](const forest::TreeDetail& detail) {
      return static_cast<std::uint8_t>(detail.levels.of(request.tree).level);
    };
    response.level = level_in(forest_->sensed());
    response.view_level = level_in(forest_->view());
    response.skeleton_hash = skeleton.hash();
    response.height = skeleton.height;
    for (const forest::Branch& branch : skeleton.branches) {
      response.parents.push_back(branch.parent);
      response.depths.push_back(static_cast<std::uint8_t>(branch.depth));
      response.lengths.push_back(static_cast<float>(branch.length));
      response.radii.push_back(static_cast<float>(branch.base_radius));
    }
    response.transforms =
        toMsg(request.tree, grown->tree.foot, posesOf(*forest_, grown->tree, request.tree, stamp));
    for (const forest::PromotedBranch& branch : forest_->promoted(request.tree).branches)
      response.physical.push_back(static_cast<std::uint32_t>(branch.branch));
    for (const forest::BrokenBranch& broken : grown->broken)
      response.broken.push_back(toMsg(broken));
    response.grabs = grab_manager_.grabsOf(request.tree);
    response.transforms.header.stamp = toStamp(stamp);
    response.transforms.header.frame_id = options_.frame_id;
    return std::to_string(skeleton.branches.size()) + " branches";
  });
}

FoundTree ForestAnimator::foundTree(std::uint32_t id) {
  const auto grown = cache_.get(*forest_, id);
  FoundTree out;
  out.id = id;
  out.position = toPoint(grown->tree.foot);
  out.height = grown->tree.skeleton.height;
  out.species = forest_->layout().species[grown->tree.seed.species].name;
  return out;
}

bool ForestAnimator::onFindTrees(FindTrees::Request& request, FindTrees::Response& response) {
  return answer(response, [&] {
    check(request);
    std::vector<std::uint32_t> around;
    response.total = forest_->layout().treeCount();
    if (!request.all) {
      const auto& header = request.centre.header;
      const Vec3 centre =
          transformed(poseOf(header.frame_id, header.stamp), fromMsg(request.centre.point));
      around = forest::treesAround(forest_->layout(), centre, request.radius);
      response.total = static_cast<std::uint32_t>(around.size());
    }
    const std::uint64_t end = std::uint64_t{request.offset} + request.limit;
    for (std::uint32_t i = request.offset; i < std::min<std::uint64_t>(end, response.total); ++i)
      response.trees.push_back(foundTree(request.all ? i : around[i]));
    return std::to_string(response.trees.size()) + " of " + std::to_string(response.total) +
           " trees";
  });
}

forest::Ray ForestAnimator::rayOf(const Pick::Request& request) const {
  forest::Ray ray = vegetation_sim::rayOf(request);
  const std::string& frame = request.header.frame_id;
  if (frame.empty() || frame == options_.frame_id) return ray;
  const Pose pose = poseOf(frame, request.header.stamp);
  ray.origin = transformed(pose, ray.origin);
  ray.direction = rotate(pose.orientation, ray.direction);
  return ray;
}

std::optional<forest::Picked> ForestAnimator::pickAlong(
    const Pick::Request& request, const std::function<bool(std::uint32_t)>& is_searched) {
  const Nanoseconds stamp = stampOf(request.header.stamp);
  return pickTree(forest_->layout(), forest_->terrain(), rayOf(request),
                  [&](std::uint32_t id) -> forest::PosedTree {
                    if (!is_searched(id)) return {std::make_shared<forest::Tree>(), {}};
                    const auto grown = cache_.get(*forest_, id);
                    return {std::shared_ptr<const forest::Tree>(grown, &grown->tree),
                            forest_->poseInView(grown->tree, id, stamp)};
                  });
}

bool ForestAnimator::onPick(Pick::Request& request, Pick::Response& response) {
  return answer(response, [&]() -> std::string {
    const auto hit =
        pickAlong(request, [this](std::uint32_t id) { return forest_->owners().owns(id); });
    if (!hit) throw InvalidInput("the ray meets no branch", FaultCode::NOTHING_FOUND);
    response.tree = hit->tree;
    response.branch = static_cast<std::uint32_t>(hit->branch);
    response.along = hit->along;
    response.point = toPoint(hit->point);
    response.distance = hit->distance;
    return "tree_" + std::to_string(hit->tree) + "/branch_" + std::to_string(hit->branch);
  });
}

bool ForestAnimator::onFindBranch(FindBranch::Request& request, FindBranch::Response& response) {
  return answer(response, [&] {
    const forest::Nearest found = grab_manager_.findNearest(request.point);
    response.tree = found.at.tree;
    response.branch = static_cast<std::uint32_t>(found.at.branch);
    response.along = found.at.along;
    response.nearest = toPoint(found.point);
    response.distance = found.distance;
    return "tree_" + std::to_string(response.tree) + "/branch_" + std::to_string(response.branch);
  });
}

bool ForestAnimator::onSetTf(SetTf::Request& request, SetTf::Response& response) {
  answer(response, [&] {
    const auto grown = cache_.get(*forest_, request.tree);
    forest_->owners().requireOwned("set_tf", request.tree);
    const std::size_t count = grown->tree.skeleton.branches.size();
    if (request.all) {
      request.branches.resize(count);
      std::iota(request.branches.begin(), request.branches.end(), 0U);
    }
    frames_.set(request.tree, request.branches, count, request.enable);
    return std::to_string(frames_.count()) + " frames";
  });
  response.frames = static_cast<std::uint32_t>(frames_.count());
  response.budget = static_cast<std::uint32_t>(frames_.budget());
  return true;
}

bool ForestAnimator::onGrab(Grab::Request& request, Grab::Response& response) {
  return answer(response, [&] { return grab_manager_.grab(request, response); });
}

bool ForestAnimator::onMoveGrab(MoveGrab::Request& request, MoveGrab::Response& response) {
  return answer(response, [&] { return grab_manager_.move(request, response); });
}

bool ForestAnimator::onRelease(Release::Request& request, Release::Response& response) {
  return answer(response, [&] { return grab_manager_.release(request); });
}

bool ForestAnimator::onCutBranch(CutBranch::Request& request, CutBranch::Response& response) {
  return answer(response, [&] { return grab_manager_.cut(request, response); });
}

bool ForestAnimator::onCutting(std_srvs::SetBool::Request& request,
                               std_srvs::SetBool::Response& response) {
  // No event shows it.
  if (switchCutters(request, options_.replay, cutters_, response)) checkpointNow();
  return true;
}

bool ForestAnimator::onApplyForce(ApplyForce::Request& request, ApplyForce::Response& response) {
  return answer(response, [&] { return grab_manager_.push(request, response); });
}

}  // namespace vegetation_sim
