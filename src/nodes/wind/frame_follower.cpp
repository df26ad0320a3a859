// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/frame_follower.h"

#include "core/archive/archive.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "wind/limits.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t ATTACHMENT_BYTES = 100;

}  // namespace

FrameFollower::FrameFollower(const tf2_ros::Buffer& buffer, const WindSettings& settings)
    : buffer_(buffer),
      frame_id_(settings.frame_id),
      period_(1.0 / settings.attach_rate),
      horizon_(settings.attach_horizon),
      lead_(settings.lead) {}

void FrameFollower::set(const wind::Source& source) {
  const std::string& name = source.primitive.name;
  if (!follows(name) && attachments_.size() >= WindSettings::MAX_FOLLOWED)
    throw InvalidInput("primitive " + inQuotes(name) + ": " + std::to_string(attachments_.size()) +
                           " frames are followed already, allowed are " +
                           std::to_string(WindSettings::MAX_FOLLOWED),
                       FaultCode::NO_ROOM);
  attachments_.erase(name);
  attachments_.emplace(name, wind::Attachment(source, period_, horizon_));
}

void FrameFollower::clear() {
  attachments_.clear();
  missing_.clear();
}

bool FrameFollower::sample(wind::Attachment& attachment, Nanoseconds now, const Report& report) {
  const std::string& frame = attachment.source().attached_frame;
  try {
    const auto transform = buffer_.lookupTransform(frame_id_, frame, ros::Time(0));
    // A chain of static transforms has no stamp; the current time stands for it.
    const Nanoseconds stamp = fromMsg(transform.header.stamp);
    const auto& at = transform.transform.translation;
    wind::Waypoint point{stamp == 0 ? now : stamp, Vec3(at.x, at.y, at.z)};
    if (secondsBetween(point.stamp, now) > 0.5 * horizon_) return false;
    Faults faults;
    FieldChecker checker("", faults);
    checker.vector("position", point.position, "m", wind::POSITIONS);
    if (faults.empty())
      if (std::optional<double> jump = attachment.add(point))
        checker.number("speed", *jump, "m/s", wind::BODY_SPEEDS);
    if (!faults.empty()) report("frame " + inQuotes(frame), faults.text());
    return true;
  } catch (const tf2::TransformException&) {
    return false;
  }
}

bool FrameFollower::update(wind::PrimitiveSchedule& schedule, Nanoseconds now,
                           const Report& report) {
  bool changed = false;
  missing_.clear();
  const Nanoseconds earliest = now + fromSeconds(lead_);
  for (auto& [name, attachment] : attachments_) {
    if (!sample(attachment, now, report))
      missing_.add(describeMissingTransform(attachment.source().attached_frame, frame_id_));
    const bool goes_on = attachment.started();
    const auto piece = attachment.piece(earliest);
    if (!piece) continue;
    goes_on ? schedule.follow(*piece, earliest) : schedule.set(*piece, earliest);
    changed = true;
  }
  return changed;
}

void FrameFollower::restore(const Attachments& attachments) {
  clear();
  attachments_ = attachments;
}

void FrameFollower::archive(Archive& a, Attachments& attachments) const {
  const std::size_t size =
      a.length("followed frames", attachments.size(), WindSettings::MAX_FOLLOWED, ATTACHMENT_BYTES);
  if (!a.reads()) {
    for (auto& entry : attachments) entry.second.archive(a);
    return;
  }
  for (std::size_t i = 0; i < size; ++i) {
    wind::Attachment attachment({}, period_, horizon_);
    attachment.archive(a);
    const std::string name = attachment.source().primitive.name;
    if (!attachments.emplace(name, std::move(attachment)).second)
      Archive::reject("followed source = " + inQuotes(name), "is there twice");
  }
}

std::vector<std::string> FrameFollower::names() const {
  std::vector<std::string> names;
  for (const auto& entry : attachments_) names.push_back(entry.first);
  return names;
}

}  // namespace vegetation_sim
