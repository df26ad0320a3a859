// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/subscriber.h>
#include <vegetation_sim/GrabStatuses.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/lod/feedback_budget.h"
#include "ros/replicas/subscribed_forest.h"
#include "rviz/forest/forest_properties.h"
#include "rviz/forest/forest_visual.h"
#include "rviz/ground/blob_visual.h"
#include "rviz/ground/ground_visual.h"
#include "rviz/ground/shadow_visual.h"
#include "rviz/scenery/scenery_display.h"
#include "rviz/trees/shared_light.h"

namespace vegetation_sim {

/// Rebuilds a forest from its layout, its wind and its state, and draws it at the time of rviz.
class ForestDisplay : public SceneryDisplay {
  Q_OBJECT
 public:
  ForestDisplay();
  ~ForestDisplay() override;

  view::ForestReport drawn() const;

 protected:
  const view::SceneryProperties& properties() const override { return *properties_; }
  void open() override;
  void close() override;
  std::optional<std::string> frame() const override;
  void draw(Nanoseconds stamp, const view::View& view) override;
  void light(const view::Daylight& daylight, const view::Haze& haze) override;
  void dropGround() override;
  void forgetState(Nanoseconds now) override { source_->forgetLater(now); }
  void showInputs(view::StatusBoard& board, Nanoseconds now) const override;
  InputStatus describeDrawn() const override;
  void updateLook() override;

 private Q_SLOTS:
  void updateTrees();

 private:
  double shareOfTriangles();
  void makeGround();
  void makeShadows();
  void makeContacts();
  void updateShadows(Nanoseconds stamp, const view::View& view);
  void shareLight();
  void takeGrabs(const GrabStatuses& message);

  std::unique_ptr<view::ForestProperties> properties_;
  std::unique_ptr<SubscribedForest> source_;
  ros::Subscriber grabs_;
  std::map<std::uint32_t, std::vector<int>> held_;  // branches by tree, sorted
  std::unique_ptr<view::ForestVisual> forest_;
  std::unique_ptr<view::GroundVisual> ground_;
  std::unique_ptr<view::ShadowVisual> shadows_;  // moving, or if another display draws the ground
  Vec3 to_sun_{Vec3::Zero()};                    // for which trees are lit
  std::unique_ptr<view::SharedLight> shared_light_;
  int lit_{-1};  // tree set whose light is shared
  int layouts_{0};
  FeedbackBudget feedback_;                     // of triangles
  double share_changed_{-1e9};                  // wall time [s]
  std::unique_ptr<view::BlobVisual> contacts_;  // around trunks
  // Tree sets for which ground, shadows and contact shadows were made.
  int grounded_{-1}, shaded_{-1}, contacted_{-1};
};

}  // namespace vegetation_sim
