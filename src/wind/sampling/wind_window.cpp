// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/sampling/wind_window.h"

#include <algorithm>

#include "wind/laws.h"

namespace vegetation_sim::forest {
namespace {

bool haveSameWaves(const wind::Instant& a, const wind::Instant& b) {
  return std::equal(a.modes.begin(), a.modes.end(), b.modes.begin(), b.modes.end(),
                    [](const wind::Mode& m, const wind::Mode& n) { return m.wave == n.wave; });
}

}  // namespace

void WindWindow::sampleAt(const wind::Field& field, Nanoseconds stamp) {
  stamp_ = stamp;
  field.at(stamp - WINDOW_STEP, instants_[0]);
  field.at(stamp, instants_[1]);
  field.at(stamp + WINDOW_STEP, instants_[2]);
  const std::vector<wind::Mode>& modes = instants_[1].modes;
  for (std::vector<SinCos>& turns : turns_) turns.clear();
  same_modes_ =
      haveSameWaves(instants_[0], instants_[1]) && haveSameWaves(instants_[1], instants_[2]);
  if (!same_modes_) return;
  for (std::size_t m = 0; m < modes.size(); ++m)
    for (const std::size_t side : {0u, 1u})
      turns_[side].push_back(sinCosTurns(instants_[2 * side].modes[m].phase - modes[m].phase));
}

std::array<Vec3, 3> WindWindow::velocities(const Vec3& position) const {
  if (!hasSameModes())
    return {instants_[0].velocity(position), instants_[1].velocity(position),
            instants_[2].velocity(position)};
  std::array<Vec3, 3> out{instants_[0].mean, instants_[1].mean, instants_[2].mean};
  for (std::size_t m = 0; m < instants_[1].modes.size(); ++m) {
    const wind::Mode& mode = instants_[1].modes[m];
    const SinCos now = sinCosTurns(dot(mode.wave, position) + mode.phase);
    out[1] += mode.amplitude * now.cos;
    for (const std::size_t side : {0u, 1u}) {
      const SinCos& turn = turns_[side][m];
      out[2 * side] +=
          instants_[2 * side].modes[m].amplitude * (now.cos * turn.cos - now.sin * turn.sin);
    }
  }
  for (std::size_t instant = 0; instant < out.size(); ++instant)
    for (const wind::Term& term : instants_[instant].terms)
      out[instant] += velocityOf(term, position);
  return out;
}

}  // namespace vegetation_sim::forest
