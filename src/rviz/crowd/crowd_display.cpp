// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/crowd_display.h"

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = 0;     // plain grass
constexpr double SMALLEST = 60.0;  // [m] edge of the ground

}  // namespace

CrowdDisplay::CrowdDisplay()
    : SceneryDisplay(GROUND_RANK, {"agent_crowd", "Cost [points]", "Budget [points]"}),
      properties_(std::make_unique<view::CrowdProperties>(*this)) {}

CrowdDisplay::~CrowdDisplay() {
  stop();
}

void CrowdDisplay::open() {
  terrain_source_ = std::make_unique<view::GroundSource>(update_nh_);
  source_ = std::make_unique<SubscribedCrowd>();
  source_->subscribeView(update_nh_, properties_->topic());
  people_ = std::make_unique<view::CrowdVisual>(*scene_node_);
}

void CrowdDisplay::close() {
  dropGround();
  people_.reset();
  source_.reset();
  terrain_source_.reset();
}

std::optional<std::string> CrowdDisplay::frame() const {
  if (source_->changes() == 0) return {};
  return source_->frame();
}

void CrowdDisplay::updateLook() {
  if (people_) people_->repaint();
}

void CrowdDisplay::light(const view::Daylight& daylight, const view::Haze& haze) {
  people_->light(daylight, haze);
  if (ground_) ground_->light(daylight, daylight.to_sun, haze);
}

void CrowdDisplay::draw(Nanoseconds stamp, const view::View& view) {
  source_->selectTopic();
  source_->forgetUnchanged(stamp);
  people_->update(*source_, stamp, terrain_source_->ground(), view, properties_->options());
  if (!source_->people().empty() && givesGround(terrain_source_->ground())) makeGround();
}

// The ground lies around the first people.
void CrowdDisplay::makeGround() {
  if (ground_) return;
  Vec3 low(1e9, 1e9, 0.0), high(-1e9, -1e9, 0.0);
  for (const SubscribedCrowd::Person& person : source_->people()) {
    const crowd::Point& at = person.walker.position;
    low = Vec3(std::min(low.x(), at.x), std::min(low.y(), at.y), 0.0);
    high = Vec3(std::max(high.x(), at.x), std::max(high.y(), at.y), 0.0);
  }
  const double edge = std::max(SMALLEST, 1.6 * std::max(high.x() - low.x(), high.y() - low.y()));
  const view::Plot plot{0.5 * (low.x() + high.x() - edge), 0.5 * (low.y() + high.y() - edge), edge};
  const view::Daylight daylight = properties_->daylight();
  ground_ = view::plainGround(*scene_node_, plot, {}, terrain_source_->ground(), daylight,
                              properties_->groundTint());
  ground_->light(daylight, daylight.to_sun, properties_->hazeValues());
}

view::CrowdReport CrowdDisplay::drawn() const {
  return people_ ? people_->report() : view::CrowdReport();
}

void CrowdDisplay::showInputs(view::StatusBoard& board, Nanoseconds /*now*/) const {
  board.show("People", source_->status());
  board.show("Styles", source_->motionsStatus());
  board.show("Publishers", source_->publishers());
}

InputStatus CrowdDisplay::describeDrawn() const {
  const view::CrowdReport report = drawn();
  return {report.people > 0, std::to_string(report.drawn) + " of " + std::to_string(report.people) +
                                 " people in the picture; " + std::to_string(report.triangles) +
                                 " triangles"};
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::CrowdDisplay, rviz::Display)
