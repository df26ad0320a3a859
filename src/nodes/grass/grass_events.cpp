// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_events.h"

#include <algorithm>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_PATH_POINTS = 10000;
constexpr Range PLACES{-1e7, 1e7};
constexpr double CUT_WORK = 25.0;  // nodes that are pressed in the time of one that is cut
constexpr double MOST_WORK = 1e10;

double cutWorkOf(const GrassCut& cut, const grass::TreadSimulation& simulation) {
  try {
    return CUT_WORK * simulation.workOf(fromMsg(cut, "cut: "));
  } catch (const InvalidInput&) {
    return 0.0;
  }
}

}  // namespace

std::string applyToGrass(const GrassEvent& event, const GrassTuning& tuning,
                         grass::TreadSimulation& simulation) {
  switch (event.kind) {
    case GrassEvent::TREAD:
      return simulation.apply(fromMsg(event.tread, tuning.tread, tuning.height_gate),
                              fromMsg(event.header.stamp));
    case GrassEvent::CLEAR:
      if (event.all)
        simulation.raiseAll();
      else
        simulation.raise({event.centre.x, event.centre.y}, event.radius);
      return "";
    case GrassEvent::CUT:
      simulation.cut(fromMsg(event.cut, "cut: "));
      return "";
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 7");
  }
}

void checkCount(std::size_t count, std::size_t most) {
  if (count < 1 || count > most)
    throw InvalidInput("points has " + std::to_string(count) + " entries, allowed are 1 to " +
                       std::to_string(most));
}

void checkPoint(std::size_t index, Vec3 point, Faults& faults) {
  FieldChecker checker("points[" + std::to_string(index) + "].", faults);
  checker.number("x", point.x(), "m", PLACES);
  checker.number("y", point.y(), "m", PLACES);
}

std::pair<Range, Range> rangesOf(const grass::MapLaw& law) {
  return {{law.origin_x, law.origin_x + law.resolution * (law.columns - 1)},
          {law.origin_y, law.origin_y + law.resolution * (law.rows - 1)}};
}

GrassEvent clearingOf(const ClearGrass::Request& request, const FramePose& pose) {
  GrassEvent out;
  out.kind = GrassEvent::CLEAR;
  out.all = request.all;
  if (request.all) return out;
  Faults faults;
  FieldChecker checker("", faults);
  Vec3 centre = fromMsg(request.centre.point);
  out.radius = request.radius;
  checker.vector("centre", centre, "m", PLACES);
  checker.number("radius", out.radius, "m", {0.0, 10000.0});
  faults.throwIfAny();
  out.centre = toPoint(transformed(pose(), centre));
  return out;
}

std::vector<Vec3> pathOf(const Tread::Request& request, const grass::MapLaw& law,
                         const terrain::HeightMap& terrain, const FramePose& pose) {
  checkCount(request.points.size(), MOST_PATH_POINTS);
  const Pose to_world = pose();
  const auto [x_range, y_range] = rangesOf(law);
  Faults faults;
  for (std::size_t i = 0; i < request.points.size(); ++i)
    checkPoint(i, fromMsg(request.points[i]), faults);
  faults.throwIfAny();
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    Vec3 p = fromMsg(request.points[i]);
    p.z() = 0.0;
    p = transformed(to_world, p);
    FieldChecker checker("points[" + std::to_string(i) + "].", faults);
    checker.number("x", p.x(), "m", x_range);
    checker.number("y", p.y(), "m", y_range);
    p.z() = terrain.height(p.x(), p.y());
    out.push_back(p);
  }
  faults.throwIfAny();
  return out;
}

// Reads only what the work of a tread depends on, since each tread is counted. One of a damaged
// snapshot may have any numbers.
double workOf(const GrassEvent& event, const grass::TreadSimulation& simulation) {
  if (event.kind == GrassEvent::CUT) return cutWorkOf(event.cut, simulation);
  if (event.kind != GrassEvent::TREAD) return 0.0;
  grass::TreadInput input;
  input.action = static_cast<grass::TreadAction>(event.tread.action);
  input.start = fromMsg(event.tread.start);
  input.position = fromMsg(event.tread.position);
  input.law.reach = event.tread.law.reach;
  const double work = simulation.workOf(input);
  return work > 0.0 ? std::min(work, MOST_WORK) : 0.0;
}

}  // namespace vegetation_sim
