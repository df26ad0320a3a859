// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <vegetation_sim/GetWindField.h>
#include <vegetation_sim/RemoveWindPrimitive.h>
#include <vegetation_sim/SampleWind.h>
#include <vegetation_sim/SetWindPrimitive.h>
#include <vegetation_sim/WindBroadcasterConfig.h>

#include <boost/thread/recursive_mutex.hpp>
#include <optional>
#include <string>

#include "nodes/base/node_base.h"
#include "nodes/snapshots/node_snapshots.h"
#include "nodes/wind/frame_follower.h"
#include "nodes/wind/wind_probes.h"
#include "nodes/wind/wind_settings.h"
#include "ros/services/frame_listener.h"
#include "ros/time/clock_watch.h"

namespace vegetation_sim {

/// Owner of the wind law: publishes it, latched and on change, and takes edits.
class WindBroadcaster final : public NodeBase {
 public:
  /// @throws InvalidInput listing every fault of parameters and scenario.
  WindBroadcaster(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~WindBroadcaster() override { stopCallbacks(); }

 private:
  using Lock = boost::recursive_mutex::scoped_lock;

  /// Runs the body of a service; an error is counted as a rejected input.
  template <class Response, class Body>
  bool reply(const char* service, Response& response, Body body);
  bool setPrimitive(SetWindPrimitive::Request& request, SetWindPrimitive::Response& response);
  bool removePrimitive(RemoveWindPrimitive::Request& request,
                       RemoveWindPrimitive::Response& response);
  bool getField(GetWindField::Request& request, GetWindField::Response& response);
  bool sample(SampleWind::Request& request, SampleWind::Response& response);
  bool saveSnapshot(SaveSnapshot::Request& request, SaveSnapshot::Response& response);
  bool loadSnapshot(LoadSnapshot::Request& request, LoadSnapshot::Response& response);
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void reconfigure(WindBroadcasterConfig& config, std::uint32_t level);

  /// Restores the state of a start at `now`, or of the newest checkpoint at the start of the node.
  void begin(Nanoseconds now);
  void beginScenario(Nanoseconds now);
  /// Applies a source, and publishes nothing. @return its primitive; none if it follows a frame.
  /// @throws InvalidInput with `faults` and its own; nothing has changed then.
  std::optional<wind::Primitive> apply(const wind::Source& source, Faults faults = {});
  void remove(const std::string& name);
  void follow(const ros::TimerEvent& event);
  void prune(const ros::TimerEvent& event);
  void checkpoint();
  /// Writes a checkpoint and publishes the field. The state is complete by then.
  void publishField();
  /// Publishes the field after an edit, and shows a breeze that has changed.
  void publishEdit();
  void publishMarkers(const ros::TimerEvent& event);
  void publishSamples(const ros::TimerEvent& event);
  /// Shows the breeze in dynamic_reconfigure.
  void showBreeze();
  /// Takes the breeze of the schedule. @return whether an edit has changed it.
  bool updateBreeze();
  SnapshotCalls snapshotCalls();
  std::uint64_t sceneHash() const;
  SnapshotFile snapshot() const;
  CheckedState readPayload(const std::string& payload, Nanoseconds shift);
  /// Continues from the newest checkpoint. @return whether there is one, and it shall.
  bool resume(Nanoseconds now);
  void diagnose(Status& status);
  Nanoseconds earliest() const;

  boost::recursive_mutex mutex_;  // of all callbacks: they may come during construction
  WindSettings settings_;
  wind::PrimitiveSchedule schedule_;
  tf2_ros::Buffer tf_buffer_;
  FrameListener tf_listener_;
  FrameFollower follower_;
  WindProbes probes_;
  BreezeSettings breeze_;  // as dynamic_reconfigure shows it
  ros::Publisher field_publisher_, marker_publisher_, samples_publisher_;
  NodeSnapshots snapshots_;
  dynamic_reconfigure::Server<WindBroadcasterConfig> reconfigure_;  // its callback uses the above
  bool begun_{false};
  ClockWatch clock_;  // last: it may call begin()
};

}  // namespace vegetation_sim
