// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/air_sampler.h"

#include "vegetation_sim/wind/air_rows.h"
#include "vegetation_sim/wind/laws.h"

namespace vegetation_sim::forest {

void AirSampler::add(const Vec3& point) {
  if (count_ == x_.size())
    for (std::vector<double>* row : {&x_, &y_, &z_, &vx_, &vy_, &vz_})
      row->resize(2 * count_ + wind::AirRows::ROOM, 0.0);
  x_[count_] = point.x();
  y_[count_] = point.y();
  z_[count_] = point.z();
  ++count_;
}

// Modes, which are many, in vectors; the bounded primitives by their law.
void AirSampler::sample(const wind::Instant& wind) {
  wind::sampleBreeze(wind,
                     {x_.data(), y_.data(), z_.data(), vx_.data(), vy_.data(), vz_.data(), count_});
  for (const wind::Term& term : wind.terms)
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3 v = wind::velocityOf(term, {x_[i], y_[i], z_[i]});
      vx_[i] += v.x();
      vy_[i] += v.y();
      vz_[i] += v.z();
    }
}

}  // namespace vegetation_sim::forest
