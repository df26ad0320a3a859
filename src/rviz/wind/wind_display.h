// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "ros/replicas/subscribed_wind.h"
#include "rviz/ground/ground_source.h"
#include "rviz/ground/ground_visual.h"
#include "rviz/render/grass_batch.h"
#include "rviz/scenery/scenery_display.h"
#include "rviz/wind/wind_properties.h"

namespace vegetation_sim {

/// Draws the wind field at the time of rviz: arrows of the velocity around the viewer, and the
/// bounds of each gust, disc, tornado, blast and wake.
class WindDisplay : public SceneryDisplay {
  Q_OBJECT
 public:
  /// Figures of the last update.
  struct Report {
    std::size_t arrows{0}, shapes{0};
    double fastest{0.0};  ///< [m/s] peak of the primitives
  };

  WindDisplay();
  ~WindDisplay() override;

  const Report& drawn() const { return report_; }

 protected:
  const view::SceneryProperties& properties() const override { return *properties_; }
  void open() override;
  void close() override;
  std::optional<std::string> frame() const override;
  void draw(Nanoseconds stamp, const view::View& view) override;
  void light(const view::Daylight& daylight, const view::Haze& haze) override;
  void dropGround() override { ground_.reset(); }
  void forgetState(Nanoseconds /*now*/) override {}  // the field has no state
  void showInputs(view::StatusBoard& board, Nanoseconds now) const override;
  InputStatus describeDrawn() const override;

 private:
  void makeGround(const Vec3& around);

  std::unique_ptr<view::WindProperties> properties_;
  std::unique_ptr<SubscribedWind> source_;
  std::unique_ptr<view::GroundSource> terrain_source_;
  std::unique_ptr<view::Material> material_;
  std::unique_ptr<view::GrassBatch> batch_;
  std::unique_ptr<view::GroundVisual> ground_;
  Ogre::SceneNode* node_{nullptr};  // Ogre's; destroyed by us
  grass::GrassMesh mesh_;
  wind::Instant instant_;
  Report report_;
};

}  // namespace vegetation_sim
