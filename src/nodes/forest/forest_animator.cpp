// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_animator.h"

#include <geometry_msgs/WrenchStamped.h>

#include <algorithm>

#include "nodes/base/node_factory.h"
#include "nodes/markers/trunk_markers.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SENSORS = 32;
constexpr std::size_t MOST_TRUNKS = 10000;  // of markers
constexpr std::size_t MOST_WINDS = 256;     // that events can name

forest::Layout designed(const forest::Layout& layout, const ForestTuning& tuning) {
  forest::Layout out = layout;
  for (forest::Species& species : out.species) species = applyDesign(species, tuning.design);
  out.motion.transition = tuning.transition;
  return out;
}

std::unique_ptr<forest::Forest> makeForest(const ForestOptions& options) {
  auto out = std::make_unique<forest::Forest>(designed(options.scene.layout, options.tuning),
                                              options.scene.terrain, options.tuning.settings,
                                              options.shard);
  out->setPhysics(options.scene.physics);
  out->setThreads(options.threads);
  out->precompute();
  return out;
}

}  // namespace

ForestAnimator::ForestAnimator(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : EventNode("forest_animator", "forest/events", handle, private_handle,
                loadForestOptions(private_handle)),
      winds_(MOST_WINDS),
      tuning_(options_.tuning),
      forest_(makeForest(options_)),
      cache_(static_cast<std::size_t>(options_.cache_budget)),
      grab_manager_({options_, *forest_, cache_, inputs_, tf_buffer_, [this] { checkpointNow(); }}),
      bodies_(handle_, options_.frame_id, options_.robot.parts, options_.frame_wait),
      cutters_(options_.frame_id, options_.cutters, tf_buffer_, options_.frame_wait),
      frames_(options_.tf_budget),
      markers_(*forest_, cache_, options_.marker_points) {
  layout_publisher_ = handle_.advertise<ForestLayout>("forest/layout", 1, true);
  trunks_publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("forest/trunks", 1, true);
  state_publisher_ = handle_.advertise<ForestState>("forest/state", 1000);
  view_publisher_ = handle_.advertise<ForestState>("forest/view", 1000);
  branches_publisher_ = handle_.advertise<BranchTransforms>("forest/branches", 60);
  wrenches_publisher_ = handle_.advertise<geometry_msgs::WrenchStamped>("forest/wrenches", 1000);
  forces_publisher_ = handle_.advertise<ContactForces>("forest/forces", 1000);
  grabs_publisher_ = handle_.advertise<GrabStatuses>("forest/grabs", 100, true);
  breaks_publisher_ = handle_.advertise<BranchBreak>("forest/breaks", 1000);
  join("forest", listMessages<ForestLayout, ForestState>(), forest_->layoutHash(),
       options_.scene.terrain->hash());
  publishLayout();
  start("forest", "forest/markers", markers_);
  cutters_.clear();  // after a checkpoint: how the tools have moved since then is unknown
}

void ForestAnimator::connect() {
  subscribeToOwner("wind", 10, &ForestAnimator::onWind);
  if (!options_.replay) subscribe("forest/sensors", 100, &ForestAnimator::onSensor);
  connectServices();
  repeat(options_.tf_rate, &ForestAnimator::sendFrames);
  repeat(options_.branches_rate, &ForestAnimator::sendBranches);
}

// Layout, wind and settings stay in force.
void ForestAnimator::resetForest() {
  grab_manager_.explainEnds(GrabStatus::RESET);
  forest_->reset();
  frames_.clear();
  deepest_ = {};
  force_key_frame_ = true;
}

bool ForestAnimator::isOutdated(const ForestInput& event, Nanoseconds /*now*/) const {
  return event.kind == ForestInput::SENSOR || event.kind >= ForestInput::GRAB;
}

void ForestAnimator::restart(Nanoseconds /*now*/) {
  resetForest();
  grab_manager_.clear();
  bodies_.clear();
  cutters_.clear();
  publishLayout();
}

void ForestAnimator::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!options_.replay) {
    followBodies(stamp);
    followCutters(stamp);
  }
  grab_manager_.follow(
      stamp, [this](const std::string& what, const std::string& why) { refusals_.add(what, why); });
  applyInputs(stamp);
  forest_->setViewers(viewers_.eyesAt(stamp));
  forest_->advance(stamp);
  updateDeepestOverlap();
  const auto period = static_cast<std::int64_t>(options_.key_frame_period * options_.state_rate);
  const bool key_frame = force_key_frame_ || tick % std::max<std::int64_t>(1, period) == 0;
  publishState(key_frame);
  if (key_frame && forest_->broken() != trunks_broken_) publishTrunks();
  updateGrabs(tick);
  publishForces();
  publishBreaks();
  force_key_frame_ = false;
}

void ForestAnimator::publishState(bool key_frame) {
  const auto publish = [&](const forest::StateUpdate& update, ros::Publisher& publisher) {
    ForestState message = toMsg(update);
    message.header.frame_id = options_.frame_id;
    state_bytes_ += ros::serialization::serializationLength(message);
    publisher.publish(message);
  };
  publish(forest_->update(key_frame), state_publisher_);
  publish(forest_->updateView(key_frame), view_publisher_);
}

void ForestAnimator::apply(ForestInput& event) {
  grab_manager_.followFrame(event);
  switch (event.kind) {
    case ForestInput::SENSOR: {
      event.sensor.stamp = event.stamp;
      const auto& known = forest_->snapshot().sensors;
      if (known.size() >= MOST_SENSORS && !known.count(event.sensor.id))
        throw InvalidInput("sensor " + inQuotes(event.sensor.id) + " is one more than the " +
                           std::to_string(MOST_SENSORS) + " allowed at once");
      forest_->setSensor(event.sensor);
      break;
    }
    case ForestInput::WIND: {
      const wind::Field* wind = winds_.find(event.wind_hash);
      if (!wind)
        throw InvalidInput("wind_hash = " + std::to_string(event.wind_hash) +
                           " matches no wind received");
      forest_->setWind(*wind);
      break;
    }
    case ForestInput::SETTINGS:
      applyTuning(tuningOf(event));
      break;
    case ForestInput::RESET:
      resetForest();
      break;
    default:
      applyInteraction(event);
  }
}

void ForestAnimator::applyInteraction(const ForestInput& event) {
  vegetation_sim::applyInteraction(event, *forest_);
  if (event.kind == ForestInput::RELEASE)
    grab_manager_.explainEnd(event.grab.id, GrabStatus::RELEASED);
}

void ForestAnimator::onRecovered(const ForestInput& event) {
  if (event.kind == ForestInput::GRAB) grab_manager_.addRequest(event);
}

// Bodies that have moved or appeared, and those without a recent transform.
void ForestAnimator::followBodies(Nanoseconds stamp) {
  for (const BodyChange& change : bodies_.changes(forest_->bodies(), stamp)) {
    ForestInput event;
    event.kind = change.gone ? ForestInput::REMOVE_BODY : ForestInput::BODY;
    event.body = change.body;
    inputs_.addFirst(event);
  }
}

void ForestAnimator::updateGrabs(std::int64_t tick) {
  for (const forest::EndedGrab& grab : forest_->ended()) {
    if (grab.reason == forest::EndedGrab::BRANCH_BROKEN) {
      grab_manager_.explainEnd(grab.id, GrabStatus::BRANCH_BROKEN);
      continue;
    }
    ++leases_ended_;
    ROS_WARN("forest_animator: grab %u ended: not moved or renewed for its lease of %g s", grab.id,
             grab.lease);
  }
  // Renewals are no change of the grabs, so the ends of leases are published each second.
  const bool renewed = !forest_->grabs().empty() && tick % options_.state_rate == 0;
  if (grab_manager_.update() || renewed || !grabs_published_)
    grabs_publisher_.publish(grab_manager_.statuses());
  grabs_published_ = true;
}

void ForestAnimator::publishForces() {
  const ContactForces forces = grab_manager_.forces();
  forces_publisher_.publish(forces);
  for (const ContactForce& force : forces.forces) {
    geometry_msgs::WrenchStamped message;
    message.header = forces.header;
    if (!force.frame.empty()) message.header.frame_id = force.frame;
    message.wrench = force.wrench;
    wrenches_publisher_.publish(message);
  }
}

void ForestAnimator::publishBreaks() {
  for (const forest::Break& broken : forest_->breaks()) {
    BranchBreak message = toMsg(broken);
    message.header.frame_id = options_.frame_id;
    breaks_publisher_.publish(message);
    ROS_INFO("forest_animator: tree_%u/branch_%d %s, %.3g kg, at %.3g MPa", broken.tree,
             broken.piece.branch, broken.piece.cut ? "is cut off" : "breaks", broken.mass,
             1e-6 * broken.stress);
  }
}

forest::Layout ForestAnimator::designedLayout(const ForestTuning& tuning) const {
  forest::Layout out = designed(options_.scene.layout, tuning);
  out.terrain_hash = options_.scene.terrain->hash();
  return out;
}

// Trees of another design have other branches.
void ForestAnimator::reportLostGrabs() {
  const std::size_t count = forest_->grabs().size();
  if (count == 0) return;
  grabs_lost_ += count;
  ROS_WARN("forest_animator: %zu grabs ended: the trees have another design", count);
}

void ForestAnimator::applyTuning(const ForestTuning& tuning) {
  forest::Layout layout = designedLayout(tuning);
  const bool same = layout.hash() == forest_->layoutHash();
  if (!same) {
    reportLostGrabs();
    grab_manager_.explainEnds(GrabStatus::TREES_CHANGED);
    forest_->setLayout(std::move(layout), options_.scene.terrain);
    forest_->precompute();
  }
  forest_->setSettings(tuning.settings);
  tuning_ = tuning;
  if (same) return;
  cache_.clear();
  markers_.reset();
  force_key_frame_ = true;
  publishLayout();
}

void ForestAnimator::publishLayout() {
  ForestLayout message = toMsg(forest_->layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
  publishTrunks();
}

void ForestAnimator::publishTrunks() {
  trunks_broken_ = forest_->broken();
  trunks_publisher_.publish(trunkMarkersOf(forest_->layout(), forest_->terrain(), options_.frame_id,
                                           MOST_TRUNKS, trunks_broken_, forest_->owners()));
}

std::shared_ptr<void> createForestAnimator(const ros::NodeHandle& handle,
                                           const ros::NodeHandle& private_handle) {
  return std::make_shared<ForestAnimator>(handle, private_handle);
}

}  // namespace vegetation_sim
