// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "forest/contact/mesh_cover.h"
#include "ros/params/parameters.h"
#include "ros/services/frame_listener.h"
#include "ros/services/frame_lookup.h"
#include "ros/services/missing_inputs.h"
#include "tree/physical/interaction.h"

namespace vegetation_sim {

/// Parts of a robot that touch branches, and links that cannot.
struct RobotParts {
  std::vector<forest::Body> parts;  ///< id, frame, shape, size and in_frame
  /// Links whose collision geometry cannot be read, and why: they touch nothing.
  std::vector<std::string> left_out;
  double mesh_error{0.0};  ///< largest distance of a shape from the convex hull of its mesh [m]
};
/// Reads the file of a mesh. @throws InvalidInput naming it.
using MeshReader = std::function<forest::Triangles(const std::string& name)>;
/// Reads any file that assimp reads, in metres, with the axes of the file.
forest::Triangles readRobotMesh(const std::string& name);
/// Most parts in all.
constexpr std::size_t MOST_PARTS = 200;
/// A body whose newest transform is older than this is removed [s].
constexpr double STALE_BODY = 0.5;

/// Collision geometry of a URDF: spheres and boxes as they are; a cylinder becomes a capsule of the
/// same length or, if it is flat, a box of the same section; a mesh becomes up to eight boxes and
/// capsules (coverTriangles). Frames get `prefix` in front.
RobotParts partsOfUrdf(const std::string& urdf, const std::string& prefix, Faults& faults,
                       const MeshReader& read = readRobotMesh);

/// Reads the parameter `bodies`, one list or a map of lists. An entry is a shape (id, frame, shape,
/// its sizes, position, rotation about x, y, z in the frame) or a robot (`robot_description`, the
/// name of the parameter that holds its URDF, and `prefix` of its frames).
RobotParts readRobotParts(const ros::NodeHandle& private_handle, Parameters& parameters);

/// A body that came or moved, or that is gone.
struct BodyChange {
  bool gone{false};
  forest::Body body;
};

/// Follows the frames of the parts in tf, once per tick.
class RobotBodies {
 public:
  /// @param wait for the transforms of a tick [s], see FrameLookup.
  RobotBodies(const ros::NodeHandle& nh, std::string frame_id, std::vector<forest::Body> parts,
              double wait = 0.0);

  /// Returns the bodies at their transforms, with the velocity between the last two.
  std::vector<forest::Body> update(Nanoseconds now);
  /// Updates, and returns how the bodies that it follows differ from those known.
  std::vector<BodyChange> changes(const forest::Bodies& known, Nanoseconds now);
  /// A body at its last transform.
  struct Sample {
    Nanoseconds stamp{0};
    Pose pose;
    Vec3 velocity{Vec3::Zero()}, spin{Vec3::Zero()};
  };
  /// The bodies that are known, by id.
  using Seen = std::map<std::string, Sample>;
  Seen seen() const;
  /// Continues from these; others are unknown, as are bodies that it does not follow.
  void restore(const Seen& seen);
  static void archive(Archive& a, Seen& seen);

  /// Transforms that the last update missed.
  MissingInputs& missing() { return missing_; }
  /// Number of transforms that have not come in time for their tick.
  std::size_t late() const { return lookup_.late(); }
  /// Forgets all transforms, after a jump of time.
  void clear();

 private:
  struct Followed {
    forest::Body part;
    std::optional<forest::Body> last;
  };
  bool sample(Followed& followed, Nanoseconds now);

  std::string frame_id_;
  std::vector<Followed> followed_;
  tf2_ros::Buffer buffer_;
  FrameLookup lookup_;
  std::unique_ptr<FrameListener> listener_;  // if there is anything to follow
  MissingInputs missing_;
};

}  // namespace vegetation_sim
