// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/forest/forest_display.h"

#include <algorithm>
#include <array>
#include <pluginlib/class_list_macros.hpp>

namespace vegetation_sim {
namespace {

constexpr int GROUND_RANK = 1;       // the ground has floor and shadows of a forest
constexpr int GROUND_EDGE = 1024;    // [pixel] of the ground texture
constexpr double GROUND_CELL = 3.0;  // [m] of the ground mesh
// Radius of the contact shadow of a trunk: that of the trunk times a factor and some room [m].
constexpr double TRUNK_SHADOW = 2.6, TRUNK_ROOM = 0.12;
constexpr double TRUNK_DARK = 0.75;  // strength of it
constexpr double LEAST_TRIANGLES = 1000.0;
constexpr double LONGEST_WAIT = 3.0;  // [s] for trees that fade to other levels

std::string describeTrees(const view::ForestReport& report) {
  std::string out = std::to_string(report.trees) + " of " + std::to_string(report.wanted) +
                    " trees, " + std::to_string(report.moving) + " moving; " +
                    std::to_string(report.triangles) +
                    " triangles in the picture; trees per level 0 to " +
                    std::to_string(forest::GEOMETRY_LEVELS - 1) + ":";
  for (const std::size_t count : report.per_level) out += " " + std::to_string(count);
  return out;
}

std::string describeMotion(const forest::ForestReplica& replica, const view::TreeSet& tree_set) {
  std::array<std::size_t, forest::MODAL_LEVEL + 1> trees{};
  std::size_t physical = 0;
  for (const auto& tree : tree_set.trees()) {
    ++trees[static_cast<std::size_t>(replica.levelOf(tree->id()).level)];
    physical += replica.promoted(tree->id()).branches.empty() ? 0 : 1;
  }
  std::string out = std::to_string(trees.front()) + " trees at rest, moving to depth 1 to " +
                    std::to_string(forest::MAX_DEPTHS) + ":";
  for (std::size_t depth = 1; depth < forest::MODAL_LEVEL; ++depth)
    out += " " + std::to_string(trees[depth]);
  return out + "; in modes: " + std::to_string(trees[forest::MODAL_LEVEL]) +
         "; with physical branches: " + std::to_string(physical);
}

}  // namespace

ForestDisplay::ForestDisplay()
    : SceneryDisplay(GROUND_RANK,
                     {"forest_animator", "Predicted frame time [ms]", "Frame time budget [ms]"}),
      properties_(std::make_unique<view::ForestProperties>(*this)) {}

ForestDisplay::~ForestDisplay() {
  stop();
}

void ForestDisplay::open() {
  source_ =
      std::make_unique<SubscribedForest>(ReplicaOptions(), SubscribedForest::FineModes::ONE_BY_ONE);
  source_->subscribe(update_nh_, properties_->topics());
  if (!properties_->grabsTopic().empty())
    grabs_ = update_nh_.subscribe(properties_->grabsTopic(), 1, &ForestDisplay::takeGrabs, this);
  forest_ = std::make_unique<view::ForestVisual>(*scene_node_);
  layouts_ = 0;
}

void ForestDisplay::close() {
  dropGround();
  shared_light_.reset();
  lit_ = -1;
  forest_.reset();
  grabs_.shutdown();
  held_.clear();
  source_.reset();
}

void ForestDisplay::takeGrabs(const GrabStatuses& message) {
  held_.clear();
  for (const GrabStatus& status : message.held)
    held_[status.grab.tree].push_back(static_cast<int>(status.grab.branch));
  for (auto& entry : held_) std::sort(entry.second.begin(), entry.second.end());
}

std::optional<std::string> ForestDisplay::frame() const {
  if (!source_->replica().ready()) return {};
  return source_->frame();
}

// The trees are grown again, with another selection or other light.
void ForestDisplay::updateTrees() {
  layouts_ = 0;
}

void ForestDisplay::updateLook() {
  if (forest_) forest_->repaint();
}

void ForestDisplay::light(const view::Daylight& daylight, const view::Haze& haze) {
  if (daylight.to_sun != to_sun_) updateTrees();
  to_sun_ = daylight.to_sun;
  forest_->light(daylight, daylight.to_sun, haze);
  if (ground_) ground_->light(daylight, daylight.to_sun, haze);
  if (shadows_) shadows_->light(daylight, haze);
  if (contacts_) contacts_->light(daylight, haze);
}

void ForestDisplay::draw(Nanoseconds stamp, const view::View& view) {
  if (layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    forest_->restart(source_->replica(), view, properties_->options());
  }
  view::ForestVisual::Options options = properties_->options();
  options.held = held_;
  options.target_triangles =
      std::max(LEAST_TRIANGLES, shareOfTriangles() * options.target_triangles);
  forest_->update(source_->replica(), stamp, wall(), view, properties_->daylight(), options);
  if (forest_->treeSet() == nullptr) return;
  shareLight();
  if (!properties_->ground()) return;
  if (properties_->hasContactShadows()) makeContacts();
  const bool gives = givesGround(source_->replica().terrain());
  if (gives) makeGround();
  if (!gives || properties_->movesShadows()) updateShadows(stamp, view);
}

// Trees fade to a new share, and then its effect is measured. While the viewer moves some always
// fade, so this wait has an end.
double ForestDisplay::shareOfTriangles() {
  const double target = properties_->frameTime();
  const view::ForestReport& report = forest_->report();
  const bool fades = report.fading + report.waiting > 0;
  if (target > 0.0 && fades && wall() < share_changed_ + LONGEST_WAIT) return feedback_.share();
  const double before = feedback_.share();
  const double share = feedback_.update(frameTime(), target);
  if (share != before) share_changed_ = wall();
  return share;
}

// The ground of this display has shadows at rest unless they move.
void ForestDisplay::updateShadows(Nanoseconds stamp, const view::View& view) {
  makeShadows();
  shadows_->update(source_->replica(), stamp, view.eye.position);
}

void ForestDisplay::shareLight() {
  if (lit_ == forest_->treeSets()) return;
  shared_light_ = std::make_unique<view::SharedLight>(scene_manager_, source_->frame(),
                                                      forest_->treeSet()->lightGrid());
  lit_ = forest_->treeSets();
}

void ForestDisplay::dropGround() {
  ground_.reset();
  shadows_.reset();
  contacts_.reset();
}

void ForestDisplay::makeShadows() {
  if (shadows_ && shaded_ == forest_->treeSets()) return;
  const view::Daylight daylight = properties_->daylight();
  const view::TreeSet& tree_set = *forest_->treeSet();
  const terrain::HeightMap& terrain = source_->replica().terrain();
  shadows_.reset();
  if (properties_->movesShadows())
    shadows_ = std::make_unique<view::ShadowVisual>(
        *scene_node_, tree_set, terrain,
        std::make_unique<view::MovingShadows>(tree_set, terrain, daylight.to_sun));
  else
    shadows_ = std::make_unique<view::ShadowVisual>(*scene_node_, tree_set, terrain, daylight);
  shadows_->light(daylight, properties_->hazeValues());
  shaded_ = forest_->treeSets();
}

void ForestDisplay::makeContacts() {
  if (contacts_ && contacted_ == forest_->treeSets()) return;
  std::vector<view::BlobShadow> shadows;
  const terrain::HeightMap& terrain = source_->replica().terrain();
  for (const auto& tree : forest_->treeSet()->trees()) {
    const auto& branches = tree->tree().skeleton.branches;
    if (branches.empty()) continue;
    const double radius = branches.front().base_radius;
    const Vec3& foot = tree->foot();
    if (const auto shadow = view::contactShadow(
            view::capsuleBox(foot, foot, TRUNK_ROOM + TRUNK_SHADOW * radius), TRUNK_DARK, terrain))
      shadows.push_back(*shadow);
  }
  contacts_ = std::make_unique<view::BlobVisual>(*scene_node_);
  contacts_->light(properties_->daylight(), properties_->hazeValues());
  contacts_->fill(std::move(shadows), source_->frame(), terrain);
  contacted_ = forest_->treeSets();
}

void ForestDisplay::makeGround() {
  if (ground_ && grounded_ == forest_->treeSets()) return;
  dropGround();
  const view::TreeSet& tree_set = *forest_->treeSet();
  const view::Daylight daylight = properties_->daylight();
  const terrain::HeightMap& terrain = source_->replica().terrain();
  const view::Plot plot = view::plotAround(tree_set.extent());
  const view::Rgba tint = properties_->groundTint();
  const view::Image picture =
      properties_->movesShadows()
          ? view::groundPicture(plot, GROUND_EDGE, view::wholePlot(GROUND_EDGE),
                                {{}, [&](const Vec3& at) { return tree_set.light().sky(at); }},
                                terrain, daylight, tint)
          : view::groundPicture(plot, GROUND_EDGE, tree_set, terrain, daylight, tint);
  const view::Land land{plot, picture, terrain, tree_set.origin(), GROUND_CELL, tint};
  ground_ = std::make_unique<view::GroundVisual>(*scene_node_, land, daylight);
  ground_->light(daylight, daylight.to_sun, properties_->hazeValues());
  grounded_ = forest_->treeSets();
}

view::ForestReport ForestDisplay::drawn() const {
  view::ForestReport out = forest_ ? forest_->report() : view::ForestReport();
  out.shadows_late = shadows_ && shadows_->isLate();
  return out;
}

void ForestDisplay::showInputs(view::StatusBoard& board, Nanoseconds now) const {
  board.show("Layout", source_->layoutStatus());
  board.show("Publishers", source_->publishers());
  board.show("Wind", source_->windStatus());
  board.show("State", source_->stateStatus(now));
  if (forest_->treeSet() != nullptr)
    board.show(rviz::StatusProperty::Ok, "Motion",
               describeMotion(source_->replica(), *forest_->treeSet()));
}

InputStatus ForestDisplay::describeDrawn() const {
  return {drawn().trees > 0, describeTrees(drawn())};
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::ForestDisplay, rviz::Display)
