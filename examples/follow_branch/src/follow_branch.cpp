// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Prints twice per second where the tip of a branch is, rebuilt from three topics to the same bits
// as in forest_animator. usage: follow_branch _tree:=0 _branch:=20
#include <ros/ros.h>

#include <memory>
#include <vector>

#include "vegetation_sim/forest/forest_replica.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace {

using vegetation_sim::ForestLayout;
using vegetation_sim::ForestState;
using vegetation_sim::WindField;

class BranchFollower {
 public:
  BranchFollower(ros::NodeHandle handle, const ros::NodeHandle& settings)
      : tree_(static_cast<std::uint32_t>(settings.param("tree", 0))),
        branch_(static_cast<std::size_t>(settings.param("branch", 20))) {
    subscribers_ = {handle.subscribe("wind", 1, &BranchFollower::onWind, this),
                    handle.subscribe("forest/layout", 1, &BranchFollower::onLayout, this),
                    handle.subscribe("forest/state", 100, &BranchFollower::onState, this)};
    timer_ = handle.createTimer(ros::Duration(0.5), &BranchFollower::print, this);
  }

 private:
  void onWind(const WindField& message) { replica_.setWind(vegetation_sim::fromMsg(message)); }
  void onLayout(const ForestLayout& message) {
    if (!message.terrain.empty()) ROS_WARN("this example takes the ground as flat");
    replica_.setLayout(vegetation_sim::fromMsg(message),
                       std::make_shared<vegetation_sim::terrain::HeightMap>());
  }
  void onState(const ForestState& message) {
    if (replica_.ready()) replica_.apply(vegetation_sim::fromMsg(message));
  }
  void print(const ros::TimerEvent&) {
    if (!replica_.ready() || replica_.stamp() == 0) return;
    if (tree_ >= replica_.layout().treeCount()) {
      ROS_ERROR_ONCE("there is no such tree");
      return;
    }
    const vegetation_sim::forest::Tree tree = replica_.grow(tree_);
    if (branch_ >= tree.skeleton.branches.size()) {
      ROS_ERROR_ONCE("there is no such branch");
      return;
    }
    const vegetation_sim::Pose pose = replica_.pose(tree, tree_, replica_.stamp())[branch_];
    const vegetation_sim::Vec3 tip =
        tree.foot + pose.position +
        tree.skeleton.branches[branch_].length * vegetation_sim::axisZ(pose.orientation);
    ROS_INFO("the tip of branch %zu is at %.3f %.3f %.3f m", branch_, tip.x(), tip.y(), tip.z());
  }

  std::uint32_t tree_;
  std::size_t branch_;
  vegetation_sim::forest::ForestReplica replica_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "follow_branch");
  const BranchFollower follower(ros::NodeHandle{}, ros::NodeHandle{"~"});
  ros::spin();
  return 0;
}
