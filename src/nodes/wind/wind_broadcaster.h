// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <vegetation_sim/GetWindField.h>
#include <vegetation_sim/RemoveWindPrimitive.h>
#include <vegetation_sim/SampleWind.h>
#include <vegetation_sim/SetWindPrimitive.h>
#include <vegetation_sim/WindBroadcasterConfig.h>

#include <boost/thread/recursive_mutex.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nodes/wind/frame_follower.h"
#include "nodes/wind/wind_settings.h"
#include "ros/time/clock_watch.h"

namespace vegetation_sim {

/// Owner of the wind law: publishes it, latched and on change, and takes edits. Program and nodelet
/// are thin shells around it. Its callbacks come from one queue and one thread.
class WindBroadcaster {
 public:
  /// @throws InvalidInput listing every fault of parameters and scenario.
  WindBroadcaster(ros::NodeHandle nh, ros::NodeHandle private_nh);

 private:
  using Lock = boost::recursive_mutex::scoped_lock;

  template <class Response>
  bool answer(const char* service, Response& response, const std::function<void()>& action);
  bool setPrimitive(SetWindPrimitive::Request& request, SetWindPrimitive::Response& response);
  bool removePrimitive(RemoveWindPrimitive::Request& request,
                       RemoveWindPrimitive::Response& response);
  bool getField(GetWindField::Request& request, GetWindField::Response& response);
  bool sample(SampleWind::Request& request, SampleWind::Response& response);
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void reconfigure(WindBroadcasterConfig& config, std::uint32_t level);

  /// Becomes what a fresh start at `now` is.
  void begin(Nanoseconds now);
  /// Edits the law, with the faults found so far. @return id, 0 for a frame that is to be followed.
  /// @throws InvalidInput with those and its own, before anything has changed.
  std::optional<wind::Primitive> apply(const wind::Source& source, Faults faults = {});
  void remove(const std::string& name);
  void follow();
  void forget();
  void publishField();
  void publishMarkers();
  /// Tells dynamic_reconfigure what the breeze has become.
  void showBreeze(const BreezeSettings& breeze);
  void noteBreeze();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void refuse(const std::string& what, const std::string& why);
  Nanoseconds earliest() const;

  // A nodelet's first callbacks may come while it is still being built.
  boost::recursive_mutex mutex_;
  WindSettings settings_;
  ros::NodeHandle nh_, private_nh_;
  wind::PrimitiveSchedule schedule_;
  FrameFollower follower_;
  BreezeSettings breeze_;  // as dynamic_reconfigure shows it
  std::uint64_t refused_{0};
  std::string last_refusal_;

  ros::Publisher field_publisher_, marker_publisher_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer follow_timer_, forget_timer_, marker_timer_;
  ros::WallTimer diagnostics_timer_;
  diagnostic_updater::Updater diagnostics_;
  dynamic_reconfigure::Server<WindBroadcasterConfig> reconfigure_;
  ClockWatch clock_;  // last: it may call begin()
};

}  // namespace vegetation_sim
