// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/vegetation_scanner.h"
#include "ros/services/request_checks.h"
#include "ros/services/service_replies.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SKY_PLACES = 64;  // of a request
constexpr Range PLACES{-1e7, 1e7};

void checkPlace(const std::string& name, Vec3 place, Faults& faults) {
  FieldChecker checker(name + ".", faults);
  checker.number("x", place.x(), "m", PLACES);
  checker.number("y", place.y(), "m", PLACES);
  checker.number("z", place.z(), "m", PLACES);
}

std::string nameOf(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

}  // namespace

Vec3 VegetationScanner::placeOf(const std::string& frame) const {
  const Vec3 out =
      poseInWorld(tf_buffer_, options_.frame_id, frame, toStamp(clock_.stamp())).position;
  Faults faults;
  checkPlace("the origin of " + inQuotes(frame), out, faults);
  faults.throwIfAny();
  return out;
}

// The places are announced whether or not anybody listens, so that listening changes nothing.
void VegetationScanner::viewSky() {
  std::vector<Vec3> places;
  std::vector<std::string> frames;
  for (const std::string& frame : options_.sky_frames) {
    try {
      places.push_back(placeOf(frame));
      frames.push_back(frame);
    } catch (const InvalidInput&) {
      missing_.add(describeMissingTransform(frame, options_.frame_id));
      continue;
    }
    announce("/sky/" + frame, places.back(), options_.sky_range);
  }
  if (options_.sky_frames.empty() || sky_publisher_.getNumSubscribers() == 0) return;
  const ros::WallTime start = ros::WallTime::now();
  SkyViews message;
  message.header = skyHeader();
  message.views = sky_of_frames_.view(places, clock_.stamp());
  for (std::size_t i = 0; i < frames.size(); ++i) message.views[i].frame = frames[i];
  sky_publisher_.publish(message);
  views_ += frames.size();
  sky_cost_ = (ros::WallTime::now() - start).toSec();
}

std_msgs::Header VegetationScanner::skyHeader() const {
  std_msgs::Header out;
  out.stamp = toStamp(clock_.stamp());
  out.frame_id = options_.frame_id;
  return out;
}

std::vector<Vec3> VegetationScanner::placesOf(const GetSkyView::Request& request) const {
  const std::size_t count = request.points.size() + request.frames.size();
  if (count < 1 || count > MOST_SKY_PLACES)
    throw InvalidInput("points and frames have " + std::to_string(count) +
                       " entries, allowed are 1 to " + std::to_string(MOST_SKY_PLACES));
  Faults faults;
  for (std::size_t i = 0; i < request.points.size(); ++i)
    checkPlace(nameOf("points", i), fromMsg(request.points[i]), faults);
  for (std::size_t i = 0; i < request.frames.size(); ++i)
    if (request.frames[i].empty()) faults.add(nameOf("frames", i) + " is empty");
  faults.throwIfAny();
  std::vector<Vec3> out;
  const Pose to_world =
      poseInWorld(tf_buffer_, options_.frame_id, request.header.frame_id, toStamp(clock_.stamp()));
  for (const geometry_msgs::Point& point : request.points)
    out.push_back(transformed(to_world, fromMsg(point)));
  for (std::size_t i = 0; i < request.frames.size(); ++i) {
    try {
      out.push_back(placeOf(request.frames[i]));
    } catch (const InvalidInput& error) {
      throw InvalidInput(nameOf("frames", i) + ": " + error.what(), error.code());
    }
  }
  return out;
}

bool VegetationScanner::onSkyView(GetSkyView::Request& request, GetSkyView::Response& response) {
  return answer(response, [&] {
    if (!clock_.hasBegun()) throw InvalidInput("the clock has not begun", FaultCode::NOT_AVAILABLE);
    if (!request.header.stamp.isZero() && fromMsg(request.header.stamp) != clock_.stamp())
      throw InvalidInput("stamp is not that of the last tick; others are not kept",
                         FaultCode::NOT_AVAILABLE);
    if (const std::string why = landscape_.rejectedLayout(); !why.empty())
      throw InvalidInput(why, FaultCode::NOT_AVAILABLE);
    const std::uint64_t incomplete = landscape_.incomplete();
    response.views = sky_of_requests_.view(placesOf(request), clock_.stamp());
    if (landscape_.incomplete() > incomplete)
      throw InvalidInput(
          "the people or tracks there are not known yet; they are after the next ticks",
          FaultCode::NOT_AVAILABLE);
    for (std::size_t i = 0; i < request.frames.size(); ++i)
      response.views[request.points.size() + i].frame = request.frames[i];
    response.header = skyHeader();
    return std::to_string(response.views.size()) + " views";
  });
}

}  // namespace vegetation_sim
