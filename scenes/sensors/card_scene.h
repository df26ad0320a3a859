// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "canopy/plants/mesh_leaves.h"
#include "scenes/canopy/canopy_scene.h"

namespace vegetation_sim::scan {

/// Makes a square card, 1 m high and wide, that stands in the plane x = 0.
/// @param picture bytes of its texture, whose columns go from y = -0.5 to y = 0.5.
inline std::shared_ptr<const canopy::Form> cardWith(const std::string& picture) {
  canopy::LeafMesh mesh;
  mesh.vertices = {{0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}, {0.0, 0.5, 1.0}, {0.0, -0.5, 1.0}};
  mesh.uv = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.materials.resize(1);
  mesh.materials[0].texture = "card.png";
  mesh.materials[0].picture = std::make_shared<const std::string>(picture);
  mesh.material = {1, 1};
  return std::make_shared<const canopy::Form>(canopy::formOf(mesh, false));
}

/// Two cards, the second 2 m behind the first as seen along x and turned about its upright axis.
inline canopy::Layout cardLayout(const std::string& picture) {
  canopy::Layout out = canopy::shrubScene();
  canopy::PlantKind& kind = out.kinds[0];
  kind.name = "card";
  kind.shape = canopy::PlantShape::MESH;
  kind.file = "card.obj";
  kind.height = 1.0;
  kind.form = cardWith(picture);
  kind.radius = kind.form->radius;
  out.plants[1].position = Vec3(2.0, 0.0, 0.0);
  out.plants[1].yaw = PI;
  return out;
}

}  // namespace vegetation_sim::scan
