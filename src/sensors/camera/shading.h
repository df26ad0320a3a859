// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sensors/camera/camera.h"
#include "sensors/camera/surface.h"

namespace vegetation_sim::scan {

/// Light that comes along rays. Scene and camera must outlive it.
class Shading {
 public:
  Shading(const Scene& scene, const Camera& camera)
      : scene_(scene), camera_(camera), light_(camera.light), surfaces_(scene) {}

  /// @param hit of the ray on the scene, which may be none.
  Vec3 radiance(const Ray& ray, const Hit& hit) const;

 private:
  Surface groundAt(const Vec3& place) const;
  Vec3 beyond(const Ray& ray) const;
  double openness(const Vec3& place) const;
  double sunAt(const Vec3& place) const;
  Vec3 lit(const Vec3& place, const Surface& surface) const;

  const Scene& scene_;
  const Camera& camera_;
  Daylight light_;
  Surfaces surfaces_;
};

}  // namespace vegetation_sim::scan
