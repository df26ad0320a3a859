// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstddef>
#include <string>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// TRIANGLE_LISTs with ids from 0, each filled up to a constant size by triangles without area:
/// rviz updates such lists in place. A list without triangles is deleted.
class TriangleLists {
 public:
  /// Position of unused points; the first point keeps the bounding box of the list.
  enum class Padding { ORIGIN, FIRST_POINT };

  /// Adds a list of `size` points; a list of size 0 is not published.
  void addList(const std::string& ns, std::size_t size, Padding padding = Padding::ORIGIN);
  void setSize(std::size_t list, std::size_t size) { lists_[list].size = size; }
  void clear(std::size_t list);

  /// Adds a corner of a triangle. Requires room for it.
  void add(std::size_t list, const Vec3& point, const std_msgs::ColorRGBA& colour);
  /// Whether so many points more fit into a list.
  bool hasRoom(std::size_t list, std::size_t points) const {
    return lists_[list].marker.points.size() + points <= lists_[list].size;
  }
  std::size_t size(std::size_t list) const { return lists_[list].size; }
  /// Number of points in use in all lists, and the largest number.
  std::size_t used() const;
  std::size_t budget() const;

  /// The stamp is zero: rviz uses the newest transform, and tf does not wait for another.
  visualization_msgs::MarkerArray message(const std::string& frame_id) const;

 private:
  struct List {
    visualization_msgs::Marker marker;
    std::size_t size{0};
    Padding padding{Padding::ORIGIN};
  };
  std::vector<List> lists_;
};

std_msgs::ColorRGBA opaque(const Vec3& rgb);

}  // namespace vegetation_sim
