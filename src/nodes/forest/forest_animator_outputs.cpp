// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "nodes/forest/forest_animator.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double OVERRUN = 0.01;  // overlap of which the diagnostics warn [m]

void addModes(diagnostic_updater::DiagnosticStatusWrapper& status, const std::string& whose,
              const forest::TreeDetail& detail) {
  const auto& modal_states = detail.modes.modalStates();
  status.add(whose + "Trees in modes", modal_states.size());
  status.add(whose + "Of these in fine modes",
             std::count_if(modal_states.begin(), modal_states.end(),
                           [](const auto& tree) { return tree.second.fine(); }));
  status.add(whose + "Memory of modes [B]", detail.modes.bytes());
}

}  // namespace

void ForestAnimator::sendFrames() {
  PosedTrees trees(*forest_, cache_, forest_->snapshot().stamp);
  const BranchFrames::Wanted wanted = options_.tf_promoted
                                          ? frames_.withPhysical(trees, grab_manager_.heldPoints())
                                          : frames_.wanted();
  frames_sent_ = 0;
  for (const auto& entry : wanted) frames_sent_ += entry.second.size();
  if (frames_sent_ > 0)
    tf_broadcaster_.sendTransform(
        branchTransforms(wanted, trees, options_.frame_id, options_.frame_prefix));
}

void ForestAnimator::sendBranches() {
  if (branches_publisher_.getNumSubscribers() == 0) return;
  const Nanoseconds stamp = forest_->snapshot().stamp;
  std::size_t sent = 0;
  for (const int id : options_.branches_trees) {
    const auto tree = static_cast<std::uint32_t>(id);
    if (!forest_->owners().owns(tree)) continue;
    const auto grown = cache_.get(*forest_, tree);
    sent += grown->tree.skeleton.branches.size();
    if (sent > static_cast<std::size_t>(options_.branches_budget)) {
      if (budget_warning_.hasPassed())
        ROS_WARN("forest_animator: branches_budget = %d ends at tree %d", options_.branches_budget,
                 id);
      return;
    }
    BranchTransforms message =
        toMsg(tree, grown->tree.foot, posesOf(*forest_, grown->tree, tree, stamp));
    message.header.stamp = toStamp(stamp);
    message.header.frame_id = options_.frame_id;
    branches_publisher_.publish(message);
  }
}

void ForestAnimator::addDiagnostics(Status& status) {
  bodies_.missing().warn(name_, status);
  status.add("Frames of bodies without a transform", bodies_.missing().size());
  cutters_.missing().warn(name_, status);
  status.add("Cutters without a position", cutters_.missing().size());
  status.add("Transforms too late for their tick",
             bodies_.late() + cutters_.late() + grab_manager_.late());
  for (const std::string& link : options_.robot.left_out)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, link);
  status.add("Links of robots without a shape", options_.robot.left_out.size());
  status.add("Error of shapes around meshes [mm]", 1e3 * options_.robot.mesh_error);
  const auto& memory = forest_->snapshot();
  const std::size_t trees = forest_->owners().countOwned();
  const auto at = forest_->sensed().levels.counts(trees);
  status.add("Trees", trees);
  status.add("Trees of all shards", forest_->layout().treeCount());
  status.add("Shard", forest_->shard().index);
  status.add("Shards", forest_->shard().count);
  status.add("Trees at rest", at.front());
  status.add("Trees that move by procedure", trees - at.front() - at.back());
  status.add("Trees that move in modes", at.back());
  status.add("Trees not at the base level", forest_->sensed().levels.held().size());
  status.add("Base level", forest_->sensed().levels.base().level);
  status.add("Sensors", memory.sensors.size());
  status.add("Viewers", memory.viewers.size());
  status.add("State sent [B]", state_bytes_);
  status.add("Grown branches held", cache_.branches());
  addPhysics(status);
  warnOfMore(status, grabs_lost_, reported_grabs_lost_,
             "grabs ended: the trees have another design");
  reported_grabs_lost_ = grabs_lost_;
  status.add("Branches that tools have left uncut", left_uncut_);
  warnOfMore(status, left_uncut_, reported_left_uncut_, "branches that tools have left uncut");
  reported_left_uncut_ = left_uncut_;
  deepest_ = {};
  updateDeepestOverlap();
  status.add("tf frames", frames_sent_);
  status.add("tf budget [frames]", frames_.budget());
}

// Reports the choice of levels for displays at the last tick and its reason, then those of the
// world and of sensors.
void ForestAnimator::addGovernor(Status& status) {
  const forest::GovernorFigures& figures = forest_->viewChoice().figures();
  const auto& settings = forest_->snapshot().settings;
  std::string why = "the tolerance is held";
  if (figures.over > 0) why = "there are no finer tiers, or no room for modes";
  if (figures.strained > 0) why = "trees bend too far for their modes";
  if (figures.held_back > 0 || figures.cost > figures.budget) why = "frame_time binds";
  if (figures.wanted + figures.physical <= 0.0) why = "nothing is seen to move";
  if (forest_->snapshot().viewers.empty()) why = "no viewer: fixed_level";
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, why);
  status.add("Tolerance [pixel]", settings.tolerance);
  status.add("Largest predicted error [pixel]", figures.largest);
  status.add("Trees above the tolerance", figures.over);
  status.add("Trees that the budget holds back", figures.held_back);
  status.add("Trees that bend too far for modes", figures.strained);
  status.add("Predicted frame time [ms]", figures.cost);
  status.add("Frame time that the tolerance asks for [ms]", figures.wanted + figures.physical);
  status.add("Frame time budget [ms]", figures.budget);
  for (std::size_t tier = 0; tier < figures.counts.size(); ++tier)
    status.add("Moving trees of level " + std::to_string(tier), figures.counts[tier]);
  status.add("tf frames", frames_sent_);
  status.add("tf budget [frames]", frames_.budget());
  status.add("Branches that tf_budget leaves without a frame", frames_.balance().held_back);
  const double farthest = frames_.balance().largest;
  status.add("Farthest of these from its rest [m]",
             std::isnan(farthest) ? "not computed: no room" : std::to_string(farthest));
  addModes(status, "", forest_->view());
  addDetail(status, "World: ", forest_->worldChoice(), forest_->world());
  addDetail(status, "Sensors: ", forest_->sensorChoice(), forest_->sensed());
}

// Reports the detail that bodies require of the world, or bodies and sensors of what is perceived.
void ForestAnimator::addDetail(Status& status, const std::string& whose,
                               const forest::DetailChooser& choice,
                               const forest::TreeDetail& detail) const {
  const forest::GovernorFigures& figures = choice.figures();
  status.add(whose + "largest predicted error [tolerance]",
             figures.largest / forest_->snapshot().settings.tolerance);
  status.add(whose + "trees above the tolerance", figures.over);
  status.add(whose + "trees that bend too far for modes", figures.strained);
  addModes(status, whose, detail);
}

void ForestAnimator::addPhysics(Status& status) {
  const forest::PhysicsFigures figures = forest_->physicsFigures();
  status.add("Grabs", forest_->grabs().size());
  status.add("Grabs whose frame is silent", grab_manager_.silent());
  status.add("Grabs ended by their lease", leases_ended_);
  status.add("Grabs ended by a new design", grabs_lost_);
  status.add("Bodies", forest_->bodies().size());
  status.add("Physical trees", figures.trees);
  status.add("Physical branches", figures.branches);
  status.add("Physical branches that blend back", figures.blending);
  status.add("Branches kept procedural by the cap", figures.refused);
  status.add("Branches that have come off", figures.broken);
  status.add("Trees with overloaded wood that stays", figures.unbroken);
  warnOfMore(status, figures.unbroken, 0,
             "trees keep overloaded wood, since " + std::to_string(forest::MOST_BROKEN) +
                 " branches have come off");
  status.add("Physics memory [B]", figures.bytes);
  status.add("Physics steps of the last tick", figures.steps);
  status.add("Gaps in time not stepped through", figures.skipped);
  status.add("Steps too long for the integrator", figures.replaced);
  status.add("Steps whose contacts were too fast", figures.coarse);
  status.add("Forces at their limit", figures.capped_forces);
  status.add("Deepest overlap with a body [m]", deepest_.penetration);
  if (deepest_.penetration <= 0.0) return;
  const std::string where = deepest_.body + " in tree_" + std::to_string(deepest_.at.tree) +
                            "/branch_" + std::to_string(deepest_.at.branch);
  status.add("Deepest overlap, where", where);
  if (deepest_.penetration > OVERRUN)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        where + ": wood is overrun beyond contact_force_limit");
}

void ForestAnimator::updateDeepestOverlap() {
  for (const forest::Reaction& reaction : forest_->reactions())
    if (reaction.penetration > deepest_.penetration) deepest_ = reaction;
}

std::vector<PredictedError> ForestAnimator::predictErrors() const {
  const double tolerance = forest_->snapshot().settings.tolerance;
  const auto errorsOf = [&](const char* topic, const forest::DetailChooser& choice) {
    const forest::GovernorFigures& figures = choice.figures();
    return predictError(topic, figures,
                        {"Trees", tolerance, "frame_time", "ms", figures.budget, {}});
  };
  // Sensors see errors in metres: their tolerance counts as that of viewers.
  PredictedError sensed = errorsOf("forest/state", forest_->sensorChoice());
  sensed.pixels = 0.0;
  return {errorsOf("forest/view", forest_->viewChoice()), sensed};
}

}  // namespace vegetation_sim
