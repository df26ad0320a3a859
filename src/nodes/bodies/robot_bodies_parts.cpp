// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <urdf/model.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "forest/contact/contact_body.h"
#include "nodes/bodies/robot_bodies.h"
#include "ros/params/mesh_file.h"
#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

using forest::Shape;

Quat fromAngles(const Vec3& roll_pitch_yaw) {
  const SinCos r = sinCos(0.5 * roll_pitch_yaw.x()), p = sinCos(0.5 * roll_pitch_yaw.y()),
               y = sinCos(0.5 * roll_pitch_yaw.z());
  return Quat{y.cos, 0.0, 0.0, y.sin} * Quat{p.cos, 0.0, p.sin, 0.0} * Quat{r.cos, r.sin, 0.0, 0.0};
}

Pose fromUrdf(const urdf::Pose& pose) {
  Quat q;
  pose.rotation.getQuaternion(q.x, q.y, q.z, q.w);
  return {Vec3(pose.position.x, pose.position.y, pose.position.z), q};
}

// A flat cylinder is a box of the same section, a long one a capsule of the same length.
void setCylinder(double radius, double length, forest::Body& body) {
  const bool flat = length < 2.0 * radius;
  const double edge = radius * std::sqrt(PI);
  body.shape = flat ? Shape::BOX : Shape::CAPSULE;
  body.size = flat ? Vec3(edge, edge, length) : Vec3(radius, 0.0, length - 2.0 * radius);
}

// Sets the shape of anything but a mesh.
void setShape(const urdf::Geometry& geometry, forest::Body& body) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      body.shape = Shape::SPHERE;
      body.size = Vec3(static_cast<const urdf::Sphere&>(geometry).radius, 0.0, 0.0);
      break;
    case urdf::Geometry::BOX: {
      const urdf::Vector3& edges = static_cast<const urdf::Box&>(geometry).dim;
      body.shape = Shape::BOX;
      body.size = Vec3(edges.x, edges.y, edges.z);
      break;
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      setCylinder(cylinder.radius, cylinder.length, body);
      break;
    }
    case urdf::Geometry::MESH:
      break;
  }
}

// Reads meshes and covers them, each once: a robot has several equal wheels.
class MeshCovering {
 public:
  MeshCovering(const MeshReader& read, const forest::CoverSettings& settings)
      : read_(read), settings_(settings) {}

  /// Returns the shapes that cover a mesh, which its URDF may stretch.
  const std::vector<forest::CoverPart>& coverOf(const urdf::Mesh& mesh) {
    const Key key{mesh.filename, mesh.scale.x, mesh.scale.y, mesh.scale.z};
    const auto known = covers_.find(key);
    return known != covers_.end() ? known->second : covers_[key] = cover(mesh);
  }

 private:
  using Key = std::tuple<std::string, double, double, double>;

  std::vector<forest::CoverPart> cover(const urdf::Mesh& mesh) const {
    forest::Triangles surface = read_(mesh.filename);
    for (Vec3& corner : surface.corners)
      corner =
          Vec3(corner.x() * mesh.scale.x, corner.y() * mesh.scale.y, corner.z() * mesh.scale.z);
    try {
      return coverTriangles(surface, settings_);
    } catch (const InvalidInput& error) {
      throw InvalidInput(mesh.filename + ": " + error.what());
    }
  }

  const MeshReader& read_;
  forest::CoverSettings settings_;
  std::map<Key, std::vector<forest::CoverPart>> covers_;
};

// A robot of many links has fewer shapes in each.
int partsPerMesh(const urdf::Model& model) {
  std::size_t collisions = 1;
  for (const auto& entry : model.links_) collisions += entry.second->collision_array.size();
  return std::clamp(static_cast<int>(MOST_PARTS / 2 / collisions), 1, 8);
}

void addMesh(const urdf::Mesh& mesh, const forest::Body& whole, MeshCovering& meshes,
             RobotParts& out) {
  const std::vector<forest::CoverPart>& cover = meshes.coverOf(mesh);
  for (std::size_t i = 0; i < cover.size(); ++i) {
    forest::Body part = whole;
    if (i > 0) part.id += "_part" + std::to_string(i);
    part.shape = cover[i].shape;
    part.size = cover[i].size;
    part.in_frame = compose(whole.in_frame, cover[i].pose);
    out.parts.push_back(part);
  }
  out.mesh_error = std::max(out.mesh_error, largestError(cover));
}

void addCollision(const urdf::Geometry& geometry, forest::Body part, MeshCovering& meshes,
                  RobotParts& out) {
  if (geometry.type == urdf::Geometry::MESH)
    addMesh(static_cast<const urdf::Mesh&>(geometry), part, meshes, out);
  else {
    setShape(geometry, part);
    out.parts.push_back(part);
  }
}

void addLink(const urdf::Link& link, const std::string& prefix, MeshCovering& meshes,
             RobotParts& out) {
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const urdf::Collision& collision = *link.collision_array[i];
    forest::Body part;
    part.id = prefix + link.name + (i ? "_" + std::to_string(i) : "");
    part.frame = prefix + link.name;
    part.in_frame = fromUrdf(collision.origin);
    try {
      if (!collision.geometry) throw InvalidInput("has no geometry");
      addCollision(*collision.geometry, part, meshes, out);
    } catch (const InvalidInput& error) {
      out.left_out.push_back("link " + inQuotes(prefix + link.name) +
                             " touches nothing: " + error.what());
    }
  }
}

forest::Body readPart(YamlSection section) {
  const Range sizes{forest::SMALLEST_BODY, forest::LARGEST_BODY};
  forest::Body body;
  section.text("frame", body.frame);
  body.id = body.frame;
  section.text("id", body.id);
  section.choice("shape", body.shape, {"sphere", "capsule", "box"});
  if (body.shape == Shape::BOX) {
    body.size = Vec3(0.1, 0.1, 0.1);
    section.vector("size", body.size, "m", sizes);
  } else {
    section.number("radius", body.size.x(), "m", sizes);
    if (body.shape == Shape::CAPSULE)
      section.number("length", body.size.z(), "m", {0.0, forest::LARGEST_BODY});
  }
  Vec3 angles = Vec3::Zero();
  section.vector("position", body.in_frame.position, "m", {-1000.0, 1000.0});
  section.vector("rotation", angles, "rad", {-2.0 * PI, 2.0 * PI});
  body.in_frame.orientation = fromAngles(angles);
  if (body.frame.empty() || body.frame[0] == '/')
    section.fault("frame", "= " + inQuotes(body.frame) + " is empty or begins with '/'");
  section.finish();
  return body;
}

// The parameter is looked for in the namespace of the node and above it, as usual for a robot.
void readRobot(const ros::NodeHandle& handle, YamlSection& section, Faults& faults,
               RobotParts& out) {
  std::string name, prefix, found, urdf;
  section.text("robot_description", name);
  section.text("prefix", prefix);
  section.finish();
  if (!handle.searchParam(name, found) || !ros::param::get(found, urdf))
    return section.fault(
        "robot_description",
        "= " + inQuotes(name) +
            " is not a parameter whose value is a URDF; it must be set before this node starts");
  const RobotParts robot = partsOfUrdf(urdf, prefix, faults);
  out.parts.insert(out.parts.end(), robot.parts.begin(), robot.parts.end());
  out.left_out.insert(out.left_out.end(), robot.left_out.begin(), robot.left_out.end());
  out.mesh_error = std::max(out.mesh_error, robot.mesh_error);
}

void readList(const ros::NodeHandle& handle, Parameters& parameters, RobotParts& out) {
  YAML::Node top;
  if (!parameters.list("bodies", top)) return;
  YamlSection section(top, handle.getNamespace(), parameters.faults());
  for (YamlSection& entry : section.sections("bodies")) {
    if (entry.has("robot_description"))
      readRobot(handle, entry, parameters.faults(), out);
    else
      out.parts.push_back(readPart(entry));
  }
}

}  // namespace

forest::Triangles readRobotMesh(const std::string& name) {
  canopy::LeafMesh mesh = loadMesh(name, MeshAxes::KEPT);
  return {std::move(mesh.vertices), std::move(mesh.faces)};
}

RobotParts partsOfUrdf(const std::string& urdf, const std::string& prefix, Faults& faults,
                       const MeshReader& read) {
  RobotParts out;
  urdf::Model model;
  if (!model.initString(urdf)) {
    faults.add("robot_description: is no URDF; see the log for what urdf says of it");
    return out;
  }
  MeshCovering meshes(read, {forest::CoverSettings().tolerance, partsPerMesh(model)});
  for (const auto& entry : model.links_) addLink(*entry.second, prefix, meshes, out);
  return out;
}

RobotParts readRobotParts(const ros::NodeHandle& private_handle, Parameters& parameters) {
  RobotParts out;
  readList(private_handle, parameters, out);
  std::set<std::string> ids;
  for (const forest::Body& part : out.parts) {
    forest::check(part, parameters.faults());
    if (!ids.insert(part.id).second)
      parameters.fault("bodies", "names " + inQuotes(part.id) + " twice");
  }
  if (out.parts.size() > MOST_PARTS)
    parameters.fault("bodies", "are " + std::to_string(out.parts.size()) + " parts, allowed are " +
                                   std::to_string(MOST_PARTS));
  return out;
}

}  // namespace vegetation_sim
