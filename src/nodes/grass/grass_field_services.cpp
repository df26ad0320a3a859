// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "grass/lod/node_wind.h"
#include "grass/map/tile_owners.h"
#include "nodes/cutters/cut_request.h"
#include "nodes/grass/grass_events.h"
#include "nodes/grass/grass_field.h"
#include "nodes/grass/waiting_areas.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SAMPLES = 100000;

// Refuses an area of which no corner is near enough to the map to reach it.
void checkReach(const grass::CutArea& area, const grass::MapLaw& law) {
  const auto [x, y] = rangesOf(law);
  grass::Point low = area.outline.front(), high = low;
  for (const grass::Point& point : area.outline) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  const double r = area.radius;
  if (low.x - r > x.high || high.x + r < x.low || low.y - r > y.high || high.y + r < y.low)
    throw InvalidInput("outline is beyond the meadow, which is from (" + std::to_string(x.low) +
                       ", " + std::to_string(y.low) + ") to (" + std::to_string(x.high) + ", " +
                       std::to_string(y.high) + ") m in the world frame");
}

double flatLength(const Vec3& a, const Vec3& b) {
  const double x = b.x() - a.x(), y = b.y() - a.y();
  return std::sqrt(x * x + y * y);
}

}  // namespace

// The path is a source of its own that comes down, moves and leaves within one tick.
void GrassField::queuePath(const std::vector<Vec3>& path, const grass::TreadLaw& law,
                           const ros::Time& stamp) {
  const double longest = 0.5 * options_.scene.grass.treading.longest_stroke;
  const std::size_t room = inputs_.room(fromMsg(stamp));
  std::vector<Vec3> steps{path[0]};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double pieces = 1.0 + std::floor(flatLength(path[i - 1], path[i]) / longest);
    if (pieces + static_cast<double>(steps.size() + 2) > static_cast<double>(room))
      throw InvalidInput("the path needs more steps of " + std::to_string(longest) +
                             " m than the " + std::to_string(room) + " that have room",
                         FaultCode::NO_ROOM);
    for (int k = 1; k <= static_cast<int>(pieces); ++k)
      steps.push_back(path[i - 1] + (k / pieces) * (path[i] - path[i - 1]));
  }
  grass::TreadInput input;
  input.source = PATH + std::to_string(++paths_);
  input.law = law;
  input.height_gate = 1000.0;  // a path is on the ground
  checkWorkToWait(inputs_, static_cast<double>(steps.size()) * field_->workOf(input));
  const auto add = [&] {
    GrassEvent event = treadEvent(input);
    event.header.stamp = stamp;
    inputs_.add(std::move(event));
  };
  for (const Vec3& step : steps) {
    input.position = step;
    add();
  }
  input.action = grass::TreadAction::LIFT;
  add();
}

bool GrassField::onTreadPath(Tread::Request& request, Tread::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    Faults faults;
    const grass::TreadLaw law = fromMsg(request.law, tuning_.tread, "law: ", faults);
    check(law, "law: ", faults);
    faults.throwIfAny();
    const ros::Time stamp = effectOf(request.header.stamp, clock_);
    const std::vector<Vec3> path = pathOf(request, field_->layout().map->law(), field_->terrain(),
                                          [&] { return poseOf(request.header.frame_id); });
    queuePath(path, law, stamp);
    for (std::size_t i = 1; i < path.size(); ++i)
      response.length += flatLength(path[i - 1], path[i]);
    return describeEffect(stamp);
  });
}

GrassSample GrassField::sampleAt(const Vec3& place, Nanoseconds stamp) const {
  GrassSample out;
  const double x = place.x(), y = place.y();
  const grass::FeatureMap& map = *field_->layout().map;
  const grass::MapLaw& law = map.law();
  const Vec3 ground(x, y, field_->terrain().height(x, y));
  out.position = toPoint(ground);
  out.age = -1.0;
  const double u = (x - law.origin_x) / law.resolution, v = (y - law.origin_y) / law.resolution;
  out.inside = u >= 0.0 && v >= 0.0 && u <= law.columns - 1.0 && v <= law.rows - 1.0;
  out.inside = out.inside && field_->tread().owners().ownsPlace(x, y);
  if (!out.inside) return out;
  const grass::Features f = map.at(x, y);
  const grass::CutNode cut = field_->tread().cuts().at({x, y});
  out.height = field_->heightAt({x, y});
  out.cut = cut.height < grass::UNCUT;
  out.swath = cut.swath;
  out.density = f.density;
  out.colour = grass::averageColour(f.colour, colours_.at(stamp), x, y);
  out.shape = f.shape;
  double sum = 0.0;
  for (std::size_t s = 0; s < map.species().size(); ++s) sum += f.mix[s];
  for (std::size_t s = 0; s < map.species().size(); ++s)
    out.shares.push_back(sum > 0.0 ? f.mix[s] / sum : 0.0);
  const grass::TreadNode node = field_->tread().at({x, y}, stamp);
  out.tilt = double{node.tilt};
  if (node.tilt > 0.f) {
    out.direction = toVector(Vec3(double{node.x}, double{node.y}, 0.0));
    out.age = secondsBetween(node.stamp, stamp);
  }
  out.crush = out.tilt / grass::BEND_LIMIT;
  out.resistance = field_->resistanceAt({x, y}, stamp);
  const Vec3 air = wind_.at(stamp).velocity(ground);
  out.wind = toVector(air);
  const grass::Point bend = grass::bendIn(air, map.species()[0].species.compliance);
  out.bend = toVector(Vec3(bend.x, bend.y, 0.0));
  return out;
}

bool GrassField::onSample(SampleGrass::Request& request, SampleGrass::Response& response) {
  return answer(response, [&]() -> std::string {
    checkCount(request.points.size(), MOST_SAMPLES);
    const Nanoseconds last = field_->stamp();
    const Nanoseconds stamp = request.header.stamp.isZero() ? last : fromMsg(request.header.stamp);
    if (stamp < last)
      throw InvalidInput("stamp is " + std::to_string(secondsBetween(stamp, last)) +
                             " s before the last tick: the past is not kept",
                         FaultCode::NOT_AVAILABLE);
    const Pose to_world = poseOf(request.header.frame_id);
    Faults faults;
    for (std::size_t i = 0; i < request.points.size(); ++i)
      checkPoint(i, fromMsg(request.points[i]), faults);
    faults.throwIfAny();
    for (const geometry_msgs::Point& point : request.points) {
      Vec3 p = fromMsg(point);
      p.z() = 0.0;
      response.samples.push_back(sampleAt(transformed(to_world, p), stamp));
    }
    return std::to_string(response.samples.size()) + " samples";
  });
}

bool GrassField::onCut(CutGrass::Request& request, CutGrass::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    const grass::CutArea area = areaOf(request.cut, poseOf(request.header.frame_id));
    checkReach(area, field_->layout().map->law());
    field_->checkCut(area);
    GrassEvent event;
    event.kind = GrassEvent::CUT;
    const ros::Time effect = event.header.stamp = effectOf(request.header.stamp, clock_);
    event.cut = toMsg(area);
    checkRoomToWait(inputs_, event.cut, workOf(event, *field_));
    enqueue(std::move(event));
    return describeEffect(effect);
  });
}

bool GrassField::onCutting(std_srvs::SetBool::Request& request,
                           std_srvs::SetBool::Response& response) {
  // No event shows it.
  if (switchCutters(request, options_.replay, cutters_, response)) checkpointNow();
  return true;
}

bool GrassField::onSetColours(SetGrassColours::Request& request,
                              SetGrassColours::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    GrassEvent event = coloursEvent(masksOf(request.colours, 0));
    checkDiscsToWait(inputs_, event.colours.size());
    enqueue(std::move(event));
    return std::to_string(request.colours.size()) + " discs from the next tick on";
  });
}

bool GrassField::onClear(ClearGrass::Request& request, ClearGrass::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    const auto& header = request.centre.header;
    enqueue(clearingOf(request, [&] { return poseOf(header.frame_id, header.stamp); }));
    return "takes effect at the next tick";
  });
}

}  // namespace vegetation_sim
