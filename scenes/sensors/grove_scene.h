// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/canopy/canopy_scene.h"
#include "sensors/plants/plant_field.h"

namespace vegetation_sim::scan {

/// Makes two shrubs, reeds and a crown. @param place is added to the places of all plants.
inline canopy::Layout groveLayout(const Vec3& place = Vec3::Zero()) {
  canopy::Layout out = canopy::shrubScene();
  out.kinds.resize(3);
  out.kinds[1].shape = canopy::PlantShape::REED;
  out.kinds[1].leaves = 60;
  out.kinds[2].shape = canopy::PlantShape::CROWN;
  out.kinds[2].leaves = 400;
  out.kinds[2].height = 3.0;
  for (const std::uint16_t kind : {std::uint16_t{1}, std::uint16_t{2}}) {
    canopy::Plant& plant = out.plants.emplace_back();
    plant.kind = kind;
    plant.seed = 5U + kind;
    plant.position = Vec3(kind, -2.5, 0.0);
  }
  for (canopy::Plant& plant : out.plants) plant.position += place;
  return out;
}

/// A replica of a canopy in a breeze or in still air.
class Grove {
 public:
  explicit Grove(const canopy::Layout& layout, bool windy = true,
                 const std::optional<canopy::CutView>& viewer = {})
      : animator_(layout), replica_(layout) {
    if (windy) animator_.setWind(canopy::breezeFrom(Vec3(5.0, 1.0, 0.0)));
    animator_.setViewer(viewer);
    advance(0, 60);
  }
  void advance(int from, int to) {
    for (int tick = from; tick < to; ++tick) {
      animator_.advance(canopy::tickStamp(tick));
      replica_.apply(animator_.update(false));
    }
  }
  void cut(const std::vector<std::uint32_t>& plants, double height) {
    animator_.cut(plants, height);
  }
  void show(Plants& plants, ThreadPool& threads, const Vec3& centre = Vec3::Zero(),
            double radius = 60.0) {
    plants.update(replica_.layout(), replica_.layoutHash(), replica_.foliageOfPlane(), centre,
                  radius, threads);
  }

 private:
  canopy::Canopy animator_;
  canopy::Replica replica_;
};

}  // namespace vegetation_sim::scan
