// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "core/lod/feedback_budget.h"
#include "rviz/grass/grass_properties.h"
#include "rviz/grass/meadow_ground.h"
#include "rviz/scenery/scenery_display.h"

namespace vegetation_sim {

/// Rebuilds a meadow from its layout, its wind and its state, and draws it at the time of rviz:
/// blades near the viewer, strips farther away, and a texture on the ground (paper 2).
class GrassDisplay : public SceneryDisplay {
  Q_OBJECT
 public:
  GrassDisplay();
  ~GrassDisplay() override;

  view::GrassReport drawn() const;
  /// Number of tiles of the ground texture with tracks.
  std::size_t paintedTracks() const { return ground_ ? ground_->paintedTracks() : 0; }

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

  std::unique_ptr<view::GrassProperties> properties_;
  std::unique_ptr<SubscribedMeadow> source_;
  std::unique_ptr<view::GrassVisual> grass_;
  std::unique_ptr<view::MeadowGround> ground_;
  FeedbackBudget feedback_;  // of blades
  int layouts_{0};
  double pruned_{0.0};  // wall time [s]
};

}  // namespace vegetation_sim
