// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/wind_markers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "wind/fade.h"
#include "wind/laws.h"

namespace vegetation_sim {
namespace {

using visualization_msgs::Marker;
using wind::Kind;
using wind::Term;

constexpr int CORNERS = 48;            // number in a ring
constexpr double LINE = 0.15;          // [m] width
constexpr double SHAFT = 0.4;          // [m] width of an arrow
constexpr double BREEZE_HEIGHT = 8.0;  // [m] of the arrow of a breeze
constexpr double TORNADO_HEIGHT = 20.0;

std_msgs::ColorRGBA colourOf(Kind kind, double alpha) {
  constexpr std::array<std::array<float, 3>, 6> COLOURS = {{{0.20f, 0.55f, 0.95f},
                                                            {0.55f, 0.80f, 0.95f},
                                                            {0.95f, 0.70f, 0.20f},
                                                            {0.75f, 0.40f, 0.85f},
                                                            {0.95f, 0.40f, 0.35f},
                                                            {0.35f, 0.80f, 0.55f}}};
  const auto& rgb = COLOURS[static_cast<std::size_t>(kind)];
  std_msgs::ColorRGBA colour;
  colour.r = rgb[0];
  colour.g = rgb[1];
  colour.b = rgb[2];
  colour.a = static_cast<float>(alpha);
  return colour;
}

/// Adds the markers of one primitive, all with its id, each in a namespace of its own.
class Painter {
 public:
  Painter(const Marker& base, Kind kind, double weight, std::vector<Marker>& out)
      : base_(base), kind_(kind), weight_(weight), out_(out) {}

  void arrow(const Vec3& from, const Vec3& velocity) {
    if (length(velocity) < 0.05) return;
    Marker& marker = add("direction", Marker::ARROW, 1.0);
    marker.points = {toPoint(from), toPoint(from + velocity)};
    marker.scale.x = SHAFT;
    marker.scale.y = 2.5 * SHAFT;
    marker.scale.z = std::min(3.0 * SHAFT, 0.4 * length(velocity));
  }
  void solid(const char* part, std::int32_t type, const Vec3& centre, const Vec3& size,
             double alpha) {
    Marker& marker = add(part, type, alpha);
    marker.pose.position = toPoint(centre);
    marker.scale.x = size.x();
    marker.scale.y = size.y();
    marker.scale.z = size.z();
  }
  void ring(const char* part, const Vec3& centre, double radius) {
    std::vector<Vec3> corners;
    for (int i = 0; i <= CORNERS; ++i) {
      const SinCos turn = sinCosTurns(static_cast<double>(i) / CORNERS);
      corners.push_back(centre + Vec3(turn.cos, turn.sin, 0.0) * radius);
    }
    line(part, corners);
  }
  void line(const char* part, const std::vector<Vec3>& corners) {
    Marker& marker = add(part, Marker::LINE_STRIP, 0.9);
    for (const Vec3& corner : corners) marker.points.push_back(toPoint(corner));
    marker.scale.x = LINE;
  }

 private:
  Marker& add(const char* part, std::int32_t type, double alpha) {
    Marker marker = base_;
    marker.ns += part;
    marker.type = type;
    marker.color = colourOf(kind_, alpha * (0.15 + 0.85 * weight_));
    out_.push_back(marker);
    return out_.back();
  }

  Marker base_;
  Kind kind_;
  double weight_;
  std::vector<Marker>& out_;
};

void paintGust(Painter& painter, const Term& term) {
  const Vec3 across(-term.direction.y(), term.direction.x(), 0.0);
  const Vec3 side = across * term.radius, front = term.centre;
  const Vec3 full = front - term.direction * term.rise;
  const Vec3 tail = full - term.direction * term.plateau;
  painter.line("front", {front - side, front + side});
  painter.line("plateau", {full - side, full + side, tail + side, tail - side, full - side});
  painter.arrow((full + tail) * 0.5, term.amplitude);
}

void paintWake(Painter& painter, const Term& term) {
  const wind::Strip strip = stripOf(term);
  const Vec3 across(-term.direction.y(), term.direction.x(), 0.0);
  const Vec3 tail = term.centre - term.direction * strip.behind;
  const Vec3 near = across * term.radius, far = across * (strip.side / wind::WAKE_EDGE);
  painter.ring("influence", term.centre, term.radius);
  painter.line("plateau", {term.centre + near, term.centre - near, tail - far, tail + far,
                           term.centre + near});
  painter.arrow(term.centre, term.amplitude);
}

void paintTerm(Painter& painter, const Term& term) {
  const double wide = 2.0 * term.radius, core = 2.0 * term.core;
  switch (term.kind) {
    case Kind::GUST:
      return paintGust(painter, term);
    case Kind::WAKE:
      return paintWake(painter, term);
    case Kind::TORNADO:
      painter.ring("influence", term.centre, term.radius);
      painter.solid("core", Marker::CYLINDER, term.centre + Vec3(0.0, 0.0, 0.5 * TORNADO_HEIGHT),
                    Vec3(core, core, TORNADO_HEIGHT), 0.35);
      return painter.arrow(term.centre + Vec3(term.core, 0.0, 0.0),
                           velocityOf(term, term.centre + Vec3(term.core, 0.0, 0.0)));
    case Kind::BLAST:
      painter.solid("core", Marker::SPHERE, term.centre, Vec3(core, core, core), 0.5);
      return painter.solid("influence", Marker::SPHERE, term.centre, Vec3(wide, wide, wide), 0.12);
    default:
      painter.ring("influence", term.centre, term.radius);
      painter.solid("disc", Marker::CYLINDER, term.centre, Vec3(wide, wide, 0.05), 0.12);
      painter.arrow(term.centre, term.amplitude);
  }
}

}  // namespace

visualization_msgs::MarkerArray windMarkers(const wind::Field& field, const std::string& frame_id,
                                            Nanoseconds stamp, double lifetime) {
  visualization_msgs::MarkerArray array;
  for (const wind::Primitive& p : field.primitives()) {
    const double weight = wind::fade(p, stamp);
    if (weight == 0.0) continue;
    Marker base;
    base.header.frame_id = frame_id;
    base.header.stamp = toStamp(stamp);
    base.ns = "wind/";
    base.id = static_cast<std::int32_t>(p.id);
    base.pose.orientation.w = 1.0;
    base.lifetime = ros::Duration(lifetime);
    Painter painter(base, p.kind, weight, array.markers);
    const wind::Instant alone = wind::Field({p}, field.seed()).at(stamp);
    for (const Term& term : alone.terms) paintTerm(painter, term);
    const Vec3 hook(0.0, 0.0, BREEZE_HEIGHT);
    if (alone.breezes > 0) painter.arrow(hook, alone.velocity(hook));
  }
  return array;
}

}  // namespace vegetation_sim
