// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/sampling/wind_sampler.h"

#include "wind/laws.h"

namespace vegetation_sim::forest {

void WindSampler::add(const Vec3& point) {
  if (count_ == points_.x.size())
    for (std::vector<double>* row : {&points_.x, &points_.y, &points_.z})
      row->resize(2 * count_ + wind::WindSamples::ROOM, 0.0);
  points_.x[count_] = point.x();
  points_.y[count_] = point.y();
  points_.z[count_] = point.z();
  ++count_;
}

wind::WindSamples WindSampler::rows(std::size_t instant) {
  Rows& air = air_[instant];
  for (std::vector<double>* row : {&air.x, &air.y, &air.z})
    if (row->size() < points_.x.size()) row->resize(points_.x.size());
  return {points_.x.data(),
          points_.y.data(),
          points_.z.data(),
          air.x.data(),
          air.y.data(),
          air.z.data(),
          count_};
}

// Modes, of which there are many, are summed in vectors; the bounded primitives one by one.
void WindSampler::sampleAt(std::size_t instant, const wind::Instant& wind) {
  wind::sampleBreeze(wind, rows(instant));
  addTerms(instant, wind);
}

void WindSampler::addTerms(std::size_t instant, const wind::Instant& wind) {
  Rows& air = air_[instant];
  for (const wind::Term& term : wind.terms)
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3 v = wind::velocityOf(term, {points_.x[i], points_.y[i], points_.z[i]});
      air.x[i] += v.x();
      air.y[i] += v.y();
      air.z[i] += v.z();
    }
}

void WindSampler::sample(const wind::Instant& wind) {
  sampleAt(0, wind);
}

// One sine and cosine per mode serve all instants.
void WindSampler::sample(const WindWindow& window) {
  if (!window.hasSameModes()) {
    for (std::size_t instant = 0; instant < air_.size(); ++instant)
      sampleAt(instant, window.instants()[instant]);
    return;
  }
  wind::sampleBreeze(window.instants(), window.turns(), {rows(0), rows(1), rows(2)});
  for (std::size_t instant = 0; instant < air_.size(); ++instant)
    addTerms(instant, window.instants()[instant]);
}

}  // namespace vegetation_sim::forest
