// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "nodes/canopy/canopy_animator.h"
#include "nodes/canopy/waiting_cuts.h"
#include "nodes/cutters/cut_request.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SAMPLES = 100000;
constexpr Range PLACES{-1e7, 1e7};

std::vector<Vec3> placesOf(const SampleCanopy::Request& request, const Pose& to_world) {
  if (request.points.empty() || request.points.size() > MOST_SAMPLES)
    throw InvalidInput("points has " + std::to_string(request.points.size()) +
                       " entries, allowed are 1 to " + std::to_string(MOST_SAMPLES));
  Faults faults;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    Vec3 point = fromMsg(request.points[i]);
    FieldChecker checker("points[" + std::to_string(i) + "].", faults);
    checker.number("x", point.x(), "m", PLACES);
    checker.number("y", point.y(), "m", PLACES);
    checker.number("z", point.z(), "m", PLACES);
    out.push_back(transformed(to_world, point));
  }
  faults.throwIfAny();
  return out;
}

}  // namespace

CanopySample CanopyAnimator::sampleAt(const Vec3& place) {
  const canopy::Layout& layout = canopy_.layout();
  const canopy::Foliage& foliage = canopy_.foliage();
  const canopy::Plane plane(layout.motion.plane);
  const canopy::PlaneVector cell = plane.cellAt(place, layout.motion.fluid.cells);
  const canopy::PlaneVector wind = canopy::bilinear(canopy_.wind(), cell.u, cell.v);
  CanopySample out;
  out.wind = toVector(canopy::outOf(plane.axes, Vec3(wind.u, wind.v, 0.0)));
  const canopy::CutView& eye = canopy_.snapshot().cuts.now;
  out.motion =
      toVector(canopy::outOf(canopy::axesOf(eye.orientation), foliage.motion(place, place)));
  out.layer = static_cast<std::uint8_t>(foliage.layerAt(place));
  out.plant = plants_.nearest(place);
  if (out.plant >= 0)
    out.displacement =
        toVector(foliage.displacement(place, place, static_cast<std::size_t>(out.plant)));
  return out;
}

bool CanopyAnimator::onSample(SampleCanopy::Request& request, SampleCanopy::Response& response) {
  return answer(response, [&] {
    if (!request.header.stamp.isZero() && fromMsg(request.header.stamp) != clock_.stamp())
      throw InvalidInput("stamp is not that of the last tick; others are not kept",
                         FaultCode::NOT_AVAILABLE);
    for (const Vec3& place : placesOf(request, poseOf(request.header.frame_id)))
      response.samples.push_back(sampleAt(place));
    response.layers = static_cast<std::uint8_t>(canopy_.foliage().layers());
    return std::to_string(response.samples.size()) + " samples";
  });
}

bool CanopyAnimator::onCut(CutPlants::Request& request, CutPlants::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    CanopyEvent event = cutEvent(areaOf(request.cut, poseOf(request.header.frame_id)));
    const ros::Time effect = event.header.stamp = effectOf(request.header.stamp, clock_);
    const bool is_next = effect.isZero();
    response.plants = countHigher(event);
    if (event.cut_plants.empty() || (is_next && response.plants == 0)) return "no plant is cut";
    checkRoomToWait(inputs_, event.cut_plants.size());
    enqueue(std::move(event));
    return describeEffect(effect);
  });
}

bool CanopyAnimator::onCutting(std_srvs::SetBool::Request& request,
                               std_srvs::SetBool::Response& response) {
  // No event shows it.
  if (switchCutters(request, options_.replay, cutters_, response)) checkpointNow();
  return true;
}

}  // namespace vegetation_sim
