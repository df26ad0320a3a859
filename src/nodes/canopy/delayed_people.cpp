// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/delayed_people.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim {
namespace {

constexpr double PAUSE = 5e-4;  // [s] between two looks

ReplicaOptions delayed(ReplicaOptions options) {
  options.delayed = true;
  return options;
}

}  // namespace

DelayedPeople::DelayedPeople(ReplicaOptions options, double wait)
    : wait_(wait), crowd_(delayed(std::move(options))) {}

void DelayedPeople::subscribe(ros::NodeHandle handle, const std::string& topic) {
  handle.setCallbackQueue(&queue_);
  crowd_.subscribe(handle, topic);
}

// Messages come in the order of their stamps: after one of a later tick none is due. A message of a
// far stamp is of another clock.
bool DelayedPeople::isDue(Nanoseconds before) const {
  return crowd_.isPublished() && !crowd_.hasWaiting(before + NANOSECONDS_PER_SECOND) &&
         crowd_.stamp() + std::max<Nanoseconds>(1, period_) <= before;
}

void DelayedPeople::take(Nanoseconds before) {
  queue_.callAvailable();
  const Nanoseconds last = crowd_.stamp();
  crowd_.advance(before);
  const Nanoseconds passed = crowd_.stamp() - last;
  if (last > 0 && passed > 0) period_ = period_ > 0 ? std::min(period_, passed) : passed;
}

void DelayedPeople::advance(Nanoseconds before) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(wait_);
  take(before);
  if (!(wait_ > 0.0)) return;
  for (; isDue(before); take(before)) {
    if (ros::WallTime::now() >= deadline) {
      ++late_;
      return;
    }
    ros::WallDuration(PAUSE).sleep();
  }
}

void DelayedPeople::forgetLater(Nanoseconds now) {
  queue_.callAvailable();
  crowd_.forgetLater(now);
}

}  // namespace vegetation_sim
