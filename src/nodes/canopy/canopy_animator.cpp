// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/canopy_animator.h"

#include "nodes/base/node_factory.h"

#include "core/config/field_values.h"
#include "nodes/canopy/pushing_bodies.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_WINDS = 16;  // that events can name

}  // namespace

CanopyAnimator::CanopyAnimator(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : EventNode("canopy_animator", "canopy/events", handle, private_handle,
                loadCanopyOptions(private_handle)),
      canopy_(options_.scene.layout),
      plants_(options_.scene.layout.plants),
      cover_(options_.scene.layout, options_.cover_resolution),
      forest_({options_.frame_id, false,
               [this](const std::string& input, const std::string& why) {
                 refusals_.add(input, why);
               }}),
      markers_(canopy_, crowns_, forest_.replica(), options_.marker_points, options_.tolerance),
      bodies_(handle_, options_.frame_id, options_.robot.parts, options_.frame_wait),
      people_(
          {options_.frame_id, false,
           [this](const std::string& input, const std::string& why) { refusals_.add(input, why); }},
          options_.frame_wait),
      cutters_(options_.frame_id, options_.cutters, tf_buffer_, options_.frame_wait),
      winds_(MOST_WINDS) {
  layout_publisher_ = handle_.advertise<CanopyLayout>("canopy/layout", 1, true);
  state_publisher_ = handle_.advertise<CanopyState>("canopy/state", 1000);
  cover_publisher_ = handle_.advertise<nav_msgs::OccupancyGrid>("canopy/cover/cut", 1);
  contacts_publisher_ = handle_.advertise<PlantContacts>("canopy/contacts", 1000);
  publishLayout();
  start("canopy", "canopy/markers", markers_);
  cutters_.clear();  // after a checkpoint: how the tools have moved since then is unknown
}

void CanopyAnimator::connect() {
  subscribeToOwner("wind", 10, &CanopyAnimator::onWind);
  if (!options_.scene.layout.crowns.empty())
    forest_.subscribe(handle_, {"forest/layout", "", "forest/view"});
  if (options_.walkers && !options_.replay && !options_.scene.layout.plants.empty())
    people_.subscribe(handle_, "agents");
  serve("sample", &CanopyAnimator::onSample);
  serve("cut", &CanopyAnimator::onCut);
  serve("cutting", &CanopyAnimator::onCutting);
}

void CanopyAnimator::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!begun_ && !options_.replay) publishBeginning(stamp);
  begun_ = true;
  forgetViewer();
  updateCrowns();
  if (!options_.replay) {
    followBodies(tick);
    followCutters(stamp);
  }
  applyInputs(stamp);
  canopy_.advance(stamp);
  publishCover(tick);
  publishState(tick);
  publishContacts();
}

void CanopyAnimator::apply(CanopyEvent& event) {
  switch (event.kind) {
    case CanopyEvent::VIEWER:
      canopy_.setViewer(event.gone ? std::nullopt
                                   : std::optional<canopy::CutView>(eyeFromMsg(event.eye)));
      if (event.gone && recovers()) viewer_.reset();
      break;
    case CanopyEvent::WIND:
      canopy_.setWind(windOf(event.wind_hash));
      break;
    case CanopyEvent::SETTINGS: {
      const auto tuning = fromNamedValues<CanopyTuning>({event.names, event.values});
      canopy_.setMotion(withTuning(canopy_.layout().motion, tuning));
      publishLayout();
      break;
    }
    case CanopyEvent::RESET:
      canopy_.reset();
      cutters_.clear();
      cuts_changed_ = true;
      break;
    case CanopyEvent::CUT:
      applyCut(event);
      break;
    case CanopyEvent::BODY:
      canopy_.setBody(vegetation_sim::fromMsg(event.body));
      break;
    case CanopyEvent::REMOVE_BODY:
      canopy_.removeBody(event.body.id);
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 7");
  }
}

// A replay gets the plants that were cut. Plants that were lower have no piece.
void CanopyAnimator::applyCut(CanopyEvent& event) {
  const std::vector<canopy::CutPiece> pieces = canopy_.cut(event.cut_plants, event.cut_height);
  event.cut_plants.clear();
  event.cut_lengths.clear();
  for (const canopy::CutPiece& piece : pieces) {
    event.cut_plants.push_back(piece.plant);
    event.cut_lengths.push_back(piece.length);
  }
  cuts_changed_ = cuts_changed_ || !pieces.empty();
}

wind::Field CanopyAnimator::windOf(std::uint64_t hash) const {
  if (const wind::Field* wind = winds_.find(hash)) return *wind;
  if (wind::Field calm; calm.hash() == hash) return calm;  // before the first was received
  throw InvalidInput("wind_hash = " + std::to_string(hash) + " matches no wind received");
}

bool CanopyAnimator::isOutdated(const CanopyEvent& event, Nanoseconds /*now*/) const {
  return event.kind == CanopyEvent::VIEWER || event.kind == CanopyEvent::BODY ||
         event.kind == CanopyEvent::REMOVE_BODY || event.kind == CanopyEvent::CUT;
}

// Layout, wind and settings stay in force.
void CanopyAnimator::restart(Nanoseconds /*now*/) {
  canopy_.reset();
  canopy_.setViewer(std::nullopt);
  viewer_.reset();
  bodies_.clear();
  cutters_.clear();
  people_.forgetLater(fromMsg(ros::Time::now()));
  begun_ = false;
  publishLayout();
}

void CanopyAnimator::publishLayout() {
  CanopyLayout message = toMsg(canopy_.layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
  cuts_changed_ = true;  // for replicas, which begin anew
}

std::shared_ptr<void> createCanopyAnimator(const ros::NodeHandle& handle,
                                           const ros::NodeHandle& private_handle) {
  return std::make_shared<CanopyAnimator>(handle, private_handle);
}

}  // namespace vegetation_sim
