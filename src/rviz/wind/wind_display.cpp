// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/wind/wind_display.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = -1;  // plain grass
constexpr double AHEAD = 0.4;    // distance of the arrows before the viewer, in extents

}  // namespace

WindDisplay::WindDisplay()
    : SceneryDisplay(GROUND_RANK), properties_(std::make_unique<view::WindProperties>(*this)) {}

WindDisplay::~WindDisplay() {
  stop();
}

void WindDisplay::open() {
  terrain_source_ = std::make_unique<view::GroundSource>(update_nh_);
  source_ = std::make_unique<SubscribedWind>();
  source_->subscribe(update_nh_, properties_->topic());
  material_ = std::make_unique<view::Material>(
      view::Material::Kind::BLADES, view::uniqueName("wind_material"), std::vector<std::string>());
  batch_ = std::make_unique<view::GrassBatch>(view::uniqueName("wind"), material_->name(), 0);
  node_ = scene_node_->createChildSceneNode();
  node_->attachObject(batch_.get());
}

void WindDisplay::close() {
  dropGround();
  if (node_ != nullptr) {
    node_->detachAllObjects();
    node_->getCreator()->destroySceneNode(node_);
    node_ = nullptr;
  }
  batch_.reset();
  material_.reset();
  source_.reset();
  terrain_source_.reset();
  report_ = Report();
}

std::optional<std::string> WindDisplay::frame() const {
  if (source_->messages() == 0) return {};
  return source_->frame();
}

void WindDisplay::light(const view::Daylight& daylight, const view::Haze& haze) {
  material_->light(daylight, daylight.to_sun, haze);
  if (ground_) ground_->light(daylight, daylight.to_sun, haze);
}

void WindDisplay::draw(Nanoseconds stamp, const view::View& view) {
  const view::WindStyle style = properties_->style();
  source_->field().at(stamp, instant_);
  mesh_.clear();
  const Vec3 ahead(view.forward.x(), view.forward.y(), 0.0);
  const Vec3 around = view.eye.position + AHEAD * style.extent * ahead;
  mesh_.origin = Vec3(around.x(), around.y(), 0.0);
  node_->setPosition(static_cast<float>(around.x()), static_cast<float>(around.y()), 0.f);
  report_ = Report();
  if (properties_->arrows())
    report_.arrows = appendArrows(instant_, terrain_source_->ground(), around, style, mesh_);
  report_.fastest = length(instant_.mean);
  for (const wind::Term& term : instant_.terms) {
    report_.fastest = std::max(report_.fastest, term.peak);
    if (!properties_->shapes()) continue;
    appendTerm(term, terrain_source_->ground(), style, mesh_);
    ++report_.shapes;
  }
  batch_->fill(mesh_);
  if (givesGround(terrain_source_->ground())) makeGround(around);
}

void WindDisplay::makeGround(const Vec3& around) {
  if (ground_) return;
  const double edge = std::max(60.0, properties_->style().extent);
  const view::Plot plot{around.x() - 0.5 * edge, around.y() - 0.5 * edge, edge};
  const view::Daylight daylight = properties_->daylight();
  ground_ = view::plainGround(*scene_node_, plot, {}, terrain_source_->ground(), daylight,
                              properties_->groundTint());
  ground_->light(daylight, daylight.to_sun, properties_->hazeValues());
}

void WindDisplay::showInputs(view::StatusBoard& board, Nanoseconds /*now*/) const {
  board.show("Wind", source_->status());
  board.show("Publishers", source_->publishers());
}

InputStatus WindDisplay::describeDrawn() const {
  if (source_->messages() == 0) return {false, "Nothing: no wind field has been received"};
  const auto tenths = static_cast<long>(10.0 * report_.fastest + 0.5);
  return {true, std::to_string(report_.arrows) + " arrows, " + std::to_string(report_.shapes) +
                    " shapes; fastest primitive " + std::to_string(tenths / 10) + "." +
                    std::to_string(tenths % 10) + " m/s"};
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::WindDisplay, rviz::Display)
