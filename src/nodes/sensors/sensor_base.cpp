// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/sensor_base.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "ros/services/request_checks.h"
#include "ros/services/service_replies.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

// How far ahead of the clock an announcement takes effect, so that it arrives before its tick.
constexpr double ANNOUNCED_AHEAD = 0.2;  // [s]

}  // namespace

SensorBase::SensorBase(const std::string& name, const ros::NodeHandle& handle,
                       const ros::NodeHandle& private_handle, const SensorOptions& options,
                       const char* task, std::string measurements)
    : NodeBase(name, handle, private_handle),
      common_(options),
      landscape_({common_.frame_id, true,
                  [this](const std::string& input, const std::string& why) {
                    refusals_.add(input, why);
                  }}),
      scene_(makeScene(common_)),
      threads_(
          std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, common_.threads)),
      tf_buffer_(ros::Duration(tf2::BufferCore::DEFAULT_CACHE_TIME),
                 true),  // with the service that shows its frames
      clock_(name_, common_.rate, common_.delay,
             {{},
              [this](std::int64_t tick) { acceptInput("tick", [&] { this->tick(tick); }); },
              [this](Nanoseconds now) { acceptInput("clock", [&] { restart(now); }); }},
             LateTicks::NEWEST),
      measurements_(std::move(measurements)),
      tf_listener_(tf_buffer_),
      interest_publisher_(handle_.advertise<SensorInterest>("forest/sensors", 40)) {
  diagnostics_.add(task, this, &SensorBase::diagnose);
}

void SensorBase::start() {
  // The callbacks of a nodelet may start from here on.
  landscape_.subscribe(handle_);
  serve("reset", &SensorBase::onReset);
  startDiagnostics();
  clock_.listen(handle_);
}

void SensorBase::stop() {
  stopCallbacks();
  clock_.stop();
}

void SensorBase::tick(std::int64_t tick) {
  openServices();
  landscape_.advance(clock_.stamp());
  missing_.clear();
  measure(tick);
}

bool SensorBase::findPose(const std::string& frame, Nanoseconds stamp, bool wanted, Pose& pose) {
  try {
    pose = poseInWorld(tf_buffer_, common_.frame_id, frame, toStamp(stamp));
    return true;
  } catch (const InvalidInput&) {
    unplaced_ += wanted;
    missing_.add(describeMissingTransform(frame, common_.frame_id));
    return false;
  }
}

void SensorBase::announce(const std::string& id, const Vec3& place, double range) {
  SensorInterest message =
      toMsg(forest::Sensor{private_handle_.getNamespace() + id, place, range, common_.tolerance,
                           clock_.stamp() + fromSeconds(common_.delay + ANNOUNCED_AHEAD)});
  message.header.frame_id = common_.frame_id;
  interest_publisher_.publish(message);
}

void SensorBase::restartScene() {
  scene_ = makeScene(common_);
}

void SensorBase::restart(Nanoseconds now) {
  landscape_.forgetLater(now);
  restartScene();
  tf_buffer_.clear();
}

bool SensorBase::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, [&]() -> std::string {
    restartScene();
    return "trees are grown again for the next of the " + measurements_;
  });
}

// Reports only what has happened since the last report.
void SensorBase::reportProblems(Status& status) {
  const Counts counts{unplaced_, landscape_.lost(), landscape_.incomplete(), clock_.counts()};
  warnOfRefusals(status);
  warnOfInterruptions(status);
  warnOfMore(status, counts.unplaced, reported_.unplaced,
             measurements_ + " without a transform of the sensor");
  missing_.warn(name_, status);
  warnOfMore(status, counts.lost, reported_.lost,
             "messages lost that are stamped ahead of the clock");
  warnOfMore(status, counts.incomplete, reported_.incomplete,
             measurements_ + " without all people or tracks in range");
  warnOfClock(status, counts.clock, reported_.clock);
  warnOfMore(status, scene_.trees.leftOut(), 0, "trees in range left out because of branch_budget");
  warnOfMore(status, scene_.plants.leftOut(), 0, "plants in range left out because of leaf_budget");
  warnOfMore(status, scene_.crowns.leftOut(), 0, "crowns in range left out because of leaf_budget");
  if (const auto& faults = scene_.plants.textureFaults(); !faults.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        faults.front() + "; rays do not pass its faces");
  if (const std::string why = landscape_.why(); !why.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "waiting for a key frame: " + why);
  if (const std::string rivals = landscape_.rivals(); !rivals.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        rivals + ": the last message wins");
  reported_ = counts;
}

void SensorBase::diagnose(Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "running");
  if (!clock_.hasBegun()) status.summary(DiagnosticStatus::WARN, "waiting for the clock");
  reportProblems(status);
  reportValues(status);
  status.add("Trees", scene_.trees.all().size());
  status.add("Branches", scene_.trees.branches());
  status.add("Trees left out", scene_.trees.leftOut());
  status.add("Plants", scene_.plants.all().size());
  status.add("Leaves of plants", scene_.plants.leaves());
  status.add("Plants left out", scene_.plants.leftOut());
  status.add("Crowns", scene_.crowns.all().size());
  status.add("Leaves of crowns", scene_.crowns.leaves());
  status.add("People", landscape_.people());
  status.add("Messages ahead of the clock", landscape_.waiting());
  clock_.report(status);
  addRefusals(status);
}

}  // namespace vegetation_sim
