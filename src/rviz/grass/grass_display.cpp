// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/grass_display.h"

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = 2;          // the ground has tracks
constexpr int BARE_RANK = -1;           // of a meadow where nothing grows
constexpr float STRIPS_REACH = 2.f;     // of darker ground below strips, in reaches of blades
constexpr double PRUNING_PERIOD = 0.5;  // [s]
constexpr double LEAST_BLADES = 1000.0;

std::string describeGrass(const view::GrassReport& report) {
  return std::to_string(report.blades) + " blades on " + std::to_string(report.bladed) + " of " +
         std::to_string(report.tiles) + " tiles, strips on " + std::to_string(report.stripped) +
         "; " + std::to_string(report.triangles) + " triangles; " + std::to_string(report.trodden) +
         " blocks of trodden ground";
}

}  // namespace

GrassDisplay::GrassDisplay()
    : SceneryDisplay(GROUND_RANK, {"grass_field", "Cost [blades]", "Budget [blades]"}),
      properties_(std::make_unique<view::GrassProperties>(*this)) {}

GrassDisplay::~GrassDisplay() {
  stop();
}

void GrassDisplay::open() {
  source_ = std::make_unique<SubscribedMeadow>();
  source_->subscribe(update_nh_, properties_->topics());
  layouts_ = 0;
}

void GrassDisplay::close() {
  dropGround();
  grass_.reset();
  source_.reset();
}

std::optional<std::string> GrassDisplay::frame() const {
  if (!source_->ready()) return {};
  return source_->frame();
}

void GrassDisplay::updateLook() {
  if (grass_) grass_->repaint();
}

void GrassDisplay::light(const view::Daylight& daylight, const view::Haze& haze) {
  if (grass_) grass_->light(daylight, haze);
  if (ground_) ground_->light(daylight, haze);
}

void GrassDisplay::draw(Nanoseconds stamp, const view::View& view) {
  source_->selectTopic();
  if (!grass_ || layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    grass_.reset();
    setGroundRank(view::isBare(*source_->layout().map) ? BARE_RANK : GROUND_RANK);
    grass_ = std::make_unique<view::GrassVisual>(*scene_node_, *source_);
    grass_->light(properties_->daylight(), properties_->hazeValues());
  }
  view::GrassVisual::Options options = properties_->options();
  const double share = feedback_.update(frameTime(), properties_->frameTime());
  options.levels.most_blades = std::max(LEAST_BLADES, share * options.levels.most_blades);
  grass_->update(*source_, stamp, wall(), view, options);
  if (wall() > pruned_ + PRUNING_PERIOD) {
    source_->prune(stamp);
    pruned_ = wall();
  }
  if (view::isPaintable(*source_->layout().map) && givesGround(*source_->terrain())) makeGround();
  if (!ground_) return;
  ground_->update(*source_, source_->takePressed(), stamp);
  ground_->darken(STRIPS_REACH * grass_->bladesReach());
}

void GrassDisplay::makeGround() {
  if (ground_) return;
  const view::Daylight daylight = properties_->daylight();
  ground_ = std::make_unique<view::MeadowGround>(*scene_node_, *source_, daylight,
                                                 properties_->groundTint());
  ground_->light(daylight, properties_->hazeValues());
}

view::GrassReport GrassDisplay::drawn() const {
  return grass_ ? grass_->report() : view::GrassReport();
}

void GrassDisplay::showInputs(view::StatusBoard& board, Nanoseconds now) const {
  board.show("Layout", source_->layoutStatus());
  board.show("Publishers", source_->publishers());
  board.show("Wind", source_->windStatus());
  board.show("State", source_->stateStatus(now));
}

InputStatus GrassDisplay::describeDrawn() const {
  const bool painted = !grass_ || view::isPaintable(*source_->layout().map);
  return {drawn().tiles > 0,
          describeGrass(drawn()) + (painted ? "" : "; no ground: more than 2048 tiles a side")};
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrassDisplay, rviz::Display)
