// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/schedule/attachment.h"

#include <algorithm>

#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

constexpr std::size_t SAMPLES = 4;  // per piece; the end slope of the spline needs a few

}  // namespace

Attachment::Attachment(const Source& source, double period, double horizon)
    : source_(source), period_(period), horizon_(horizon) {}

std::optional<double> Attachment::add(const Waypoint& sample) {
  std::optional<double> jump;
  if (!samples_.empty()) {
    const double gap = secondsBetween(samples_.back().stamp, sample.stamp);
    if (!(gap > 0.0)) return {};
    const double speed = levelSpeed(samples_.back(), sample);
    if (gap <= horizon_ && speed > BODY_SPEEDS.high) jump = speed;
    if (gap > horizon_ || jump) {
      samples_.clear();
      started_ = false;
    }
  }
  samples_.push_back(sample);
  if (samples_.size() > SAMPLES) samples_.pop_front();
  return jump;
}

std::optional<Primitive> Attachment::piece(Nanoseconds earliest) {
  Primitive p = source_.primitive;
  if (samples_.size() < 2 || earliest < p.t_on) return {};
  const Nanoseconds last = samples_.back().stamp;
  if (secondsBetween(last, earliest) > 0.5 * horizon_) return {};
  // Once the source fades out, its last piece goes straight on.
  if (p.t_off != 0 && earliest >= p.t_off - fromSeconds(p.fade_out)) return {};
  const Nanoseconds horizon = last + fromSeconds(horizon_);
  if (p.t_off == 0 || horizon < p.t_off - fromSeconds(p.fade_out)) {
    p.t_off = horizon;
    p.fade_out = 0.25 * horizon_;
  }
  p.fade_in = started_ ? 0.5 * period_ : std::min(p.fade_in, 0.5 * horizon_);
  p.t_on = earliest;
  p.trajectory.assign(samples_.begin(), samples_.end());
  started_ = true;
  return p;
}

}  // namespace vegetation_sim::wind
