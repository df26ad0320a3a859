// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "rviz/crowd/crowd_properties.h"
#include "rviz/ground/ground_source.h"
#include "rviz/ground/ground_visual.h"
#include "rviz/scenery/scenery_display.h"

namespace vegetation_sim {

/// Draws people from the state of a crowd, with gait, clothes by id and shadows.
class CrowdDisplay : public SceneryDisplay {
  Q_OBJECT
 public:
  CrowdDisplay();
  ~CrowdDisplay() override;

  view::CrowdReport drawn() const;

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

  std::unique_ptr<view::CrowdProperties> properties_;
  std::unique_ptr<SubscribedCrowd> source_;
  std::unique_ptr<view::GroundSource> terrain_source_;
  std::unique_ptr<view::CrowdVisual> people_;
  std::unique_ptr<view::GroundVisual> ground_;
};

}  // namespace vegetation_sim
