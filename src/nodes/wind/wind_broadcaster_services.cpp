// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_broadcaster.h"
#include "ros/services/request_checks.h"
#include "ros/services/service_replies.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"
#include "wind/limits.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_SAMPLES = 100000;
constexpr std::size_t MOST_FAULTS = 10;  // listed of one request

void checkSamples(const SampleWind::Request& request) {
  Faults faults;
  const std::size_t points = request.positions.size(), stamps = request.stamps.size();
  if (points > MOST_SAMPLES)
    faults.add("positions: " + std::to_string(points) + " of them, allowed are " +
               std::to_string(MOST_SAMPLES));
  if (stamps > 1 && stamps != points)
    faults.add("stamps: " + std::to_string(stamps) + " of them, allowed are 0, 1 or " +
               std::to_string(points) + " as of positions");
  for (std::size_t i = 0; i < points && faults.list().size() < MOST_FAULTS; ++i) {
    const auto& at = request.positions[i];
    Vec3 position(at.x, at.y, at.z);
    FieldChecker checker("positions[" + std::to_string(i) + "]", faults);
    checker.vector("", position, "m", wind::POSITIONS);
  }
  faults.throwIfAny();
}

}  // namespace

template <class Response, class Body>
bool WindBroadcaster::reply(const char* service, Response& response, Body body) {
  const Lock lock(mutex_);
  answer(response, body);
  if (!response.success) refusals_.add(service, response.message);
  return true;
}

bool WindBroadcaster::setPrimitive(SetWindPrimitive::Request& request,
                                   SetWindPrimitive::Response& response) {
  return reply("set_primitive", response, [&]() -> std::string {
    Faults faults;
    const wind::Source source = sourceFromMsg(request.primitive, settings_.frame_id, faults);
    const auto published = apply(source, faults);
    if (!published) {
      checkpoint();  // the field has it once tf has the frame
      return "begins once tf has a transform of " + source.attached_frame;
    }
    publishEdit();
    response.id = published->id;
    response.t_on = toStamp(published->t_on);
    return "begins at " + std::to_string(secondsBetween(0, published->t_on)) + " s";
  });
}

bool WindBroadcaster::removePrimitive(RemoveWindPrimitive::Request& request,
                                      RemoveWindPrimitive::Response& response) {
  return reply("remove_primitive", response, [&] {
    if (!request.all) {
      remove(request.name);
    } else {
      for (const std::string& name : schedule_.names(earliest())) remove(name);
      for (const std::string& name : follower_.names()) remove(name);
    }
    publishEdit();
    return "";
  });
}

void WindBroadcaster::reconfigure(WindBroadcasterConfig& config, std::uint32_t level) {
  if (level != ~0u) {
    std_srvs::Trigger::Response response;
    reply("reconfigure", response, [&] {
      if (!clock_.running())
        throw InvalidInput("time has not begun, is /clock published?", FaultCode::NOT_AVAILABLE);
      BreezeSettings wanted = fromConfig(config);
      Faults faults;
      FieldChecker checker("", faults);  // a NaN passes the server's clamp
      describe(checker, wanted);
      faults.throwIfAny();
      wind::Primitive base;
      base.velocity = Vec3::Zero();
      if (const auto now = schedule_.find(BreezeSettings::NAME, earliest())) base = *now;
      base.t_on = base.t_off = 0;
      apply({wanted.applyTo(base), ""});
      breeze_ = wanted;
      publishField();
      return "";
    });
  }
  config = toConfig(breeze_);
}

bool WindBroadcaster::getField(GetWindField::Request&, GetWindField::Response& response) {
  return reply("get_field", response, [&] {
    response.field = toMsg(schedule_.field(), settings_.frame_id, clock_.now());
    return "";
  });
}

bool WindBroadcaster::sample(SampleWind::Request& request, SampleWind::Response& response) {
  return reply("sample", response, [&] {
    checkSamples(request);
    const ros::Time& common = request.header.stamp;
    const Pose to_world =
        poseInWorld(tf_buffer_, settings_.frame_id, request.header.frame_id, common);
    const Nanoseconds now = common.isZero() ? clock_.now() : fromMsg(common);
    response.header.frame_id = settings_.frame_id;
    response.header.stamp = toStamp(now);
    const auto stampOf = [&](std::size_t i) {
      const Nanoseconds stamp = request.stamps.empty()       ? 0
                                : request.stamps.size() == 1 ? fromMsg(request.stamps[0])
                                                             : fromMsg(request.stamps[i]);
      return stamp == 0 ? now : stamp;
    };
    Nanoseconds stamp = 0;
    wind::Instant instant;
    for (std::size_t i = 0; i < request.positions.size(); ++i) {
      if (i == 0 || stampOf(i) != stamp) instant = schedule_.field().at(stamp = stampOf(i));
      const Vec3 position = transformed(to_world, fromMsg(request.positions[i]));
      response.velocities.push_back(toVector(instant.velocity(position)));
    }
    return "";
  });
}

bool WindBroadcaster::saveSnapshot(SaveSnapshot::Request& request,
                                   SaveSnapshot::Response& response) {
  return reply("save_snapshot", response, [&] { return snapshots_.save(request.name, response); });
}

bool WindBroadcaster::loadSnapshot(LoadSnapshot::Request& request,
                                   LoadSnapshot::Response& response) {
  return reply("load_snapshot", response, [&] {
    return snapshots_.load(request, clock_.now(), response, [](const NodeSnapshots::Loadable&) {});
  });
}

bool WindBroadcaster::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return reply("reset", response, [&] {
    begin(clock_.now());
    return "";
  });
}

}  // namespace vegetation_sim
