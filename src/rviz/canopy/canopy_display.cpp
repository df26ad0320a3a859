// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_display.h"

#include <cmath>
#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = 0;  // plain grass
// The shadow below a plant: its radius per radius of the plant, its strength, and the largest
// number of plants that have one.
constexpr double PLANT_SHADOW = 0.75, PLANT_DARK = 0.55;
constexpr std::size_t MOST_CONTACTS = 400;

}  // namespace

CanopyDisplay::CanopyDisplay()
    : SceneryDisplay(GROUND_RANK, {"canopy_animator", "Cost [points]", "Budget [points]"}),
      properties_(std::make_unique<view::CanopyProperties>(*this)) {}

CanopyDisplay::~CanopyDisplay() {
  stop();
}

void CanopyDisplay::open() {
  terrain_source_ = std::make_unique<view::GroundSource>(update_nh_);
  source_ = std::make_unique<SubscribedCanopy>();
  source_->subscribe(update_nh_, properties_->topics());
  layouts_ = 0;
}

void CanopyDisplay::close() {
  dropGround();
  contacts_.reset();
  canopy_.reset();
  source_.reset();
  terrain_source_.reset();
}

std::optional<std::string> CanopyDisplay::frame() const {
  if (source_->replica() == nullptr) return {};
  return source_->frame();
}

void CanopyDisplay::updateLook() {
  if (canopy_) canopy_->repaint();
}

// Leaves are lit when they are grown, so they are grown again for another sun.
void CanopyDisplay::light(const view::Daylight& daylight, const view::Haze& haze) {
  if (daylight.to_sun != to_sun_) layouts_ = 0;
  to_sun_ = daylight.to_sun;
  if (canopy_) canopy_->light(daylight, haze);
  if (ground_) ground_->light(daylight, daylight.to_sun, haze);
  if (contacts_) contacts_->light(daylight, haze);
}

void CanopyDisplay::draw(Nanoseconds stamp, const view::View& view) {
  source_->updateCrowns();
  if (!canopy_ || layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    dropGround();
    canopy_.reset();
    canopy_ = std::make_unique<view::CanopyVisual>(*scene_node_, *source_, to_sun_);
    canopy_->light(properties_->daylight(), properties_->hazeValues());
    makeContacts();
  }
  view::CanopyVisual::Options options = properties_->options();
  options.share = feedback_.update(frameTime(), properties_->frameTime());
  canopy_->update(*source_, stamp, view, options);
  const std::vector<view::Extent> cut = canopy_->takeCutAreas();
  if (!cut.empty()) makeContacts();
  if (!givesGround(terrain_source_->ground())) return;
  if (ground_)
    repaintGround(cut);
  else
    makeGround();
}

void CanopyDisplay::makeGround() {
  const view::Plot plot = canopy_->plot();
  const view::Daylight daylight = properties_->daylight();
  ground_ =
      view::plainGround(*scene_node_, plot,
                        canopy_->shadeOn(plot, view::PLAIN_EDGE, view::wholePlot(view::PLAIN_EDGE),
                                         terrain_source_->ground(), daylight.to_sun),
                        terrain_source_->ground(), daylight, properties_->groundTint());
  ground_->light(daylight, daylight.to_sun, properties_->hazeValues());
}

// Lays a soft shadow below each plant that has not been cut.
void CanopyDisplay::makeContacts() {
  const canopy::Replica& canopy = *source_->replica();
  const canopy::Layout& layout = canopy.layout();
  std::vector<view::BlobShadow> shadows;
  for (std::size_t i = 0; i < layout.plants.size() && shadows.size() < MOST_CONTACTS; ++i) {
    const canopy::Plant& plant = layout.plants[i];
    const canopy::PlantKind& kind = layout.kinds[plant.kind];
    if (kind.shape == canopy::PlantShape::TRELLIS || canopy.cutHeight(i) < canopy::UNCUT) continue;
    const double radius = PLANT_SHADOW * plant.scale * kind.radius;
    // The feet are on the ground that the publisher knows, which may differ from that known here.
    Vec3 foot = plant.position;
    foot.z() = terrain_source_->ground().height(foot.x(), foot.y());
    if (std::fabs(foot.z() - plant.position.z()) > radius) continue;
    if (const auto shadow = view::contactShadow(view::capsuleBox(foot, foot, radius), PLANT_DARK,
                                                terrain_source_->ground()))
      shadows.push_back(*shadow);
  }
  view::shareDarkness(shadows);
  contacts_ = std::make_unique<view::BlobVisual>(*scene_node_);
  contacts_->light(properties_->daylight(), properties_->hazeValues());
  contacts_->fill(std::move(shadows), source_->frame(), terrain_source_->ground());
}

// Plants that have been cut give less shadow.
void CanopyDisplay::repaintGround(const std::vector<view::Extent>& areas) {
  const view::Plot plot = canopy_->plot();
  std::vector<view::Window> windows;
  int pixels = 0;
  for (const view::Extent& area : areas) {
    const view::Window window = view::windowAround(plot, view::PLAIN_EDGE, area);
    if (window.columns > 0 && window.rows > 0) windows.push_back(window);
    pixels += window.columns * window.rows;
  }
  if (pixels > view::PLAIN_EDGE * view::PLAIN_EDGE) windows = {view::wholePlot(view::PLAIN_EDGE)};
  for (const view::Window& window : windows) repaintGround(plot, window);
}

void CanopyDisplay::repaintGround(const view::Plot& plot, const view::Window& window) {
  const view::Daylight daylight = properties_->daylight();
  const terrain::HeightMap& ground = terrain_source_->ground();
  const view::Shade shade =
      canopy_->shadeOn(plot, view::PLAIN_EDGE, window, ground, daylight.to_sun);
  ground_->repaint(window.column, view::PLAIN_EDGE - window.row - window.rows,
                   view::groundPicture(plot, view::PLAIN_EDGE, window, shade, ground, daylight,
                                       properties_->groundTint()));
}

view::CanopyReport CanopyDisplay::drawn() const {
  return canopy_ ? canopy_->report() : view::CanopyReport();
}

void CanopyDisplay::showInputs(view::StatusBoard& board, Nanoseconds now) const {
  board.show("Layout", source_->layoutStatus());
  board.show("Publishers", source_->publishers());
  board.show("State", source_->stateStatus(now));
  if (canopy_ && !canopy_->textureFaults().empty())
    board.show("Textures", {false, canopy_->textureFaults().front()});
  if (const SubscribedForest* forest = source_->forest()) {
    board.show("Forest Layout", forest->layoutStatus());
    board.show("Forest State", forest->stateStatus(now));
    board.show("Wind", forest->windStatus());
  }
}

InputStatus CanopyDisplay::describeDrawn() const {
  const view::CanopyReport report = drawn();
  return {report.leaves > 0, std::to_string(report.drawn) + " of " + std::to_string(report.leaves) +
                                 " leaves of " + std::to_string(report.plants) + " plants and " +
                                 std::to_string(report.crowns) + " crowns, in " +
                                 std::to_string(report.layers) + " layers, " +
                                 std::to_string(report.pictures) + " of them as pictures"};
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::CanopyDisplay, rviz::Display)
