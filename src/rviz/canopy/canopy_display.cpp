// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_display.h"

#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = 0;  // plain grass

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
}

void CanopyDisplay::draw(Nanoseconds stamp, const view::View& view) {
  source_->updateCrowns();
  if (!canopy_ || layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    dropGround();
    canopy_.reset();
    canopy_ = std::make_unique<view::CanopyVisual>(*scene_node_, *source_, to_sun_);
    canopy_->light(properties_->daylight(), properties_->hazeValues());
  }
  view::CanopyVisual::Options options = properties_->options();
  options.share = feedback_.update(frameTime(), properties_->frameTime());
  canopy_->update(*source_, stamp, view, options);
  const std::vector<view::Extent> cut = canopy_->takeCutAreas();
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
