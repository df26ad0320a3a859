// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/lod/feedback_budget.h"
#include "rviz/canopy/canopy_properties.h"
#include "rviz/ground/blob_visual.h"
#include "rviz/ground/ground_source.h"
#include "rviz/ground/ground_visual.h"
#include "rviz/scenery/scenery_display.h"

namespace vegetation_sim {

/// Rebuilds plants and their leaves from layout and state, and draws each leaf as its layer moves
/// it (paper 3).
class CanopyDisplay : public SceneryDisplay {
  Q_OBJECT
 public:
  CanopyDisplay();
  ~CanopyDisplay() override;

  view::CanopyReport drawn() const;

 protected:
  const view::SceneryProperties& properties() const override { return *properties_; }
  void open() override;
  void close() override;
  std::optional<std::string> frame() const override;
  void draw(Nanoseconds stamp, const view::View& view) override;
  void light(const view::Daylight& daylight, const view::Haze& haze) override;
  void dropGround() override { ground_.reset(); }
  void forgetState(Nanoseconds now) override { source_->forgetLater(now); }
  void showInputs(view::StatusBoard& board, Nanoseconds now) const override;
  InputStatus describeDrawn() const override;
  void updateLook() override;

 private:
  void makeGround();
  void makeContacts();
  void repaintGround(const std::vector<view::Extent>& areas);
  void repaintGround(const view::Plot& plot, const view::Window& window);

  std::unique_ptr<view::CanopyProperties> properties_;
  std::unique_ptr<SubscribedCanopy> source_;
  std::unique_ptr<view::GroundSource> terrain_source_;
  std::unique_ptr<view::CanopyVisual> canopy_;
  std::unique_ptr<view::GroundVisual> ground_;
  Vec3 to_sun_{Vec3::Zero()};  // for which leaves are lit
  FeedbackBudget feedback_;    // of leaves
  int layouts_{0};
  std::unique_ptr<view::BlobVisual> contacts_;  // around the feet of plants
};

}  // namespace vegetation_sim
