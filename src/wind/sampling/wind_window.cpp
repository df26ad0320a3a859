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
  field.at(stamp - LOOK, looks_[0]);
  field.at(stamp, looks_[1]);
  field.at(stamp + LOOK, looks_[2]);
  const std::vector<wind::Mode>& modes = looks_[1].modes;
  for (std::vector<SinCos>& turns : turns_) turns.clear();
  turns_alike_ = haveSameWaves(looks_[0], looks_[1]) && haveSameWaves(looks_[1], looks_[2]);
  if (!turns_alike_) return;
  for (std::size_t m = 0; m < modes.size(); ++m)
    for (const std::size_t side : {0u, 1u})
      turns_[side].push_back(sinCosTurns(looks_[2 * side].modes[m].phase - modes[m].phase));
}

std::array<Vec3, 3> WindWindow::velocities(const Vec3& position) const {
  if (!turnsAlike())
    return {looks_[0].velocity(position), looks_[1].velocity(position),
            looks_[2].velocity(position)};
  std::array<Vec3, 3> out{looks_[0].mean, looks_[1].mean, looks_[2].mean};
  for (std::size_t m = 0; m < looks_[1].modes.size(); ++m) {
    const wind::Mode& mode = looks_[1].modes[m];
    const SinCos now = sinCosTurns(dot(mode.wave, position) + mode.phase);
    out[1] += mode.amplitude * now.cos;
    for (const std::size_t side : {0u, 1u}) {
      const SinCos& turn = turns_[side][m];
      out[2 * side] +=
          looks_[2 * side].modes[m].amplitude * (now.cos * turn.cos - now.sin * turn.sin);
    }
  }
  for (std::size_t look = 0; look < out.size(); ++look)
    for (const wind::Term& term : looks_[look].terms) out[look] += velocityOf(term, position);
  return out;
}

}  // namespace vegetation_sim::forest
