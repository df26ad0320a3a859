// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_field.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "nodes/base/node_factory.h"

#include "core/config/field_values.h"
#include "grass/map/tile_owners.h"
#include "nodes/grass/grass_events.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

using Events = std::vector<GrassEvent>::iterator;
constexpr unsigned MOST_AWAITED = 100;  // messages of `treads` between two ticks

// Events are large, so they are moved once.
void sortBySource(Events first, Events last) {
  std::vector<Events> order(static_cast<std::size_t>(last - first));
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(), [](const Events& a, const Events& b) {
    return a->tread.source < b->tread.source;
  });
  std::vector<GrassEvent> sorted;
  sorted.reserve(order.size());
  for (const Events& event : order) sorted.push_back(std::move(*event));
  std::move(sorted.begin(), sorted.end(), first);
}

}  // namespace

GrassField::GrassField(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : EventNode("grass_field", "grass/events", handle, private_handle,
                loadGrassOptions(private_handle)),
      tuning_(options_.tuning),
      key_frames_(options_.key_frame_period, options_.state_rate, options_.state_bytes),
      sources_(handle_, options_.frame_id, options_.sources, tf_buffer_, options_.frame_wait),
      cutters_(options_.frame_id, options_.cutters, tf_buffer_, options_.frame_wait) {
  const GrassScene& scene = options_.scene;
  grass::Layout layout = scene.grass.layout;
  const grass::MapLaw& law = layout.map->law();
  const auto owners =
      std::make_shared<const grass::TileOwners>(law, options_.shard.value_or(Shard()));
  tread_ = std::make_unique<grass::TreadMap>(law, scene.grass.treading, owners);
  near_treads_.emplace(law, *owners,
                       NearTreads::marginOf(scene.grass.treading.longest_stroke,
                                            grass::TreadBlock::SIDE * tread_->spacing()));
  layout.tread_spacing = tread_->spacing();
  field_ = std::make_unique<grass::TreadSimulation>(layout, scene.terrain, scene.grass.treading,
                                                    *tread_);
  field_->setDrag(tuning_.drag);
  inputs_.setCost(
      [this](const GrassEvent& event) { return static_cast<std::size_t>(workOf(event, *field_)); });
  if (isPart() && showsAll()) {
    whole_ = std::make_unique<WholeMeadow>(layout, scene.terrain, scene.grass.treading);
    whole_->field().setDrag(tuning_.drag);
    covers_.emplace(options_.shard->count);
  }
  markers_ = std::make_unique<GrassMarkers>(shown(), scene.terrain, wind_, colours_, tuning_.view,
                                            options_.marker_points);
  layout_publisher_ = handle_.advertise<GrassLayout>("grass/layout", 1, true);
  // A late subscriber gets a key frame at the next tick.
  state_publisher_ = handle_.advertise<GrassState>(
      "grass/state", 1000, [this](const ros::SingleSubscriberPublisher&) { key_frames_.demand(); });
  near_publisher_ = handle_.advertise<NearGrass>(
      "grass/near", 1000,
      [this](const ros::SingleSubscriberPublisher&) { needs_near_frame_ = true; });
  wrenches_publisher_ = handle_.advertise<geometry_msgs::WrenchStamped>("grass/wrenches", 1000);
  forces_publisher_ = handle_.advertise<GrassForces>("grass/forces", 1000);
  colours_publisher_ = handle_.advertise<GrassColours>(shownTopic("grass/colours"), 1, true);
  values_publisher_ = handle_.advertise<GrassCover>(shownTopic("grass/cover/values"), 1);
  cover_publisher_ = handle_.advertise<nav_msgs::OccupancyGrid>(shownTopic("grass/cover"), 1);
  for (std::size_t i = 0; i < COVER_LAYERS.size(); ++i)
    layer_publishers_[i] = handle_.advertise<nav_msgs::OccupancyGrid>(
        shownTopic(std::string("grass/cover/") + COVER_LAYERS[i]), 1);
  if (!showsAll())
    cover_part_publisher_ = handle_.advertise<GrassCoverPart>("grass/cover/parts", 4);
  join("grass", listMessages<GrassLayout, GrassState>(), layout.hash(), scene.terrain->hash());
  publishLayout();
  start("grass", shownTopic("grass/markers").c_str(), *markers_);
  cutters_.clear();  // after a checkpoint: how the tools have moved since then is unknown
}

void GrassField::connect() {
  subscribeToOwner("wind", 10, &GrassField::onWind);
  if (!options_.replay) {
    subscribe("tread", EventQueue<GrassEvent>::MOST_WAITING, &GrassField::onTread);
    if (awaitsNodes())
      subscribe("treads", MOST_AWAITED, &GrassField::onTreads, Delivery::AWAITED);
    else
      subscribe("treads", 1000, &GrassField::onTreads);
  }
  subscribe("forest/sensors", 40, &GrassField::onSensor);
  connectServices();
}

void GrassField::tick(std::int64_t tick) {
  const Nanoseconds stamp = clock_.stamp();
  if (!coloured_) colourAsInScenario(stamp);
  if (!options_.replay) {
    awaitTreads(stamp);
    followSources(stamp);
    followCutters(stamp);
  }
  applyInputs(stamp);
  publishEntering(stamp);
  if (whole_) followWhole(stamp);
  publishState(tick);
  publishForces(stamp);
  sendCoverAt(tick);
}

void GrassField::apply(GrassEvent& event) {
  switch (event.kind) {
    case GrassEvent::SETTINGS:
      applyTuning(fromNamedValues<GrassTuning>({event.names, event.values}));
      break;
    case GrassEvent::RESET:
      resetGround();
      break;
    case GrassEvent::COLOURS:
      setColours(masksOf(event.colours, stampOf(event)));
      break;
    case GrassEvent::ENTER:  // an output of the recorded node
      break;
    default:
      applyToGround(event);
  }
}

void GrassField::arrange(std::vector<GrassEvent>& events) const {
  const auto is_tread = [](const GrassEvent& event) { return event.kind == GrassEvent::TREAD; };
  for (auto first = events.begin(); first != events.end();) {
    first = std::find_if(first, events.end(), is_tread);
    const auto last = std::find_if_not(first, events.end(), is_tread);
    sortBySource(first, last);
    first = last;
  }
}

void GrassField::applyToGround(const GrassEvent& event) {
  const std::string problem = applyToGrass(event, tuning_, *field_);
  if (!problem.empty()) refusals_.add("tread", problem);
  if (event.kind == GrassEvent::CLEAR) key_frames_.demand();
}

// A name of a path is not used again.
void GrassField::onRecovered(const GrassEvent& event) {
  if (event.kind == GrassEvent::TREAD && event.tread.source == PATH + std::to_string(paths_ + 1))
    ++paths_;
}

void GrassField::applyTuning(GrassTuning tuning) {
  check(tuning);
  tuning.view.most_blades = options_.tuning.view.most_blades;
  field_->setDrag(tuning.drag);
  if (whole_) whole_->field().setDrag(tuning.drag);
  markers_->setSettings(tuning.view);
  tuning_ = tuning;
  const std::uint64_t before = field_->layout().hash();
  field_->setTreadLaw(tuning.tread);
  if (whole_) whole_->field().setTreadLaw(tuning.tread);
  if (field_->layout().hash() == before) return;
  key_frames_.demand();
  publishLayout();
}

// Layout, wind and settings stay in force.
void GrassField::resetGround() {
  field_->reset();
  if (whole_) whole_->reset();
  if (covers_) covers_->clear();
  sources_.clear();
  cutters_.clear();
  key_frames_.demand();
}

bool GrassField::isOutdated(const GrassEvent& event, Nanoseconds /*now*/) const {
  return event.kind == GrassEvent::TREAD || event.kind == GrassEvent::CLEAR ||
         event.kind == GrassEvent::CUT || event.kind == GrassEvent::COLOURS;
}

// The first tick of a replay is another one, since it is behind. Where discs are that move follows
// from the event.
void GrassField::colourAsInScenario(Nanoseconds stamp) {
  const grass::ColourMasks colours{stamp, options_.scene.colours};
  if (options_.replay || colours.list.empty()) return setColours(colours);
  inputs_.addFirst(coloursEvent(colours));
  coloured_ = true;
}

void GrassField::setColours(grass::ColourMasks colours) {
  colours_ = std::move(colours);
  coloured_ = true;
  GrassColours message = toMsg(colours_);
  message.header.frame_id = options_.frame_id;
  colours_publisher_.publish(message);
}

void GrassField::restart(Nanoseconds /*now*/) {
  coloured_ = false;
  cover_period_ = -1;  // as at a start, the first tick has a map
  tread_senders_.jumpBack();
  sensors_.clear();
  resetGround();
  publishLayout();
}

// One node shows the meadow for all; the others show their share on topics of their own.
std::string GrassField::shownTopic(const std::string& topic) const {
  return showsAll() ? topic : private_handle_.resolveName(topic);
}

void GrassField::publishLayout() {
  GrassLayout message = toMsg(field_->layout());
  message.header.stamp = ros::Time::now();
  message.header.frame_id = options_.frame_id;
  layout_publisher_.publish(message);
}

std::shared_ptr<void> createGrassField(const ros::NodeHandle& handle,
                                       const ros::NodeHandle& private_handle) {
  return std::make_shared<GrassField>(handle, private_handle);
}

}  // namespace vegetation_sim
