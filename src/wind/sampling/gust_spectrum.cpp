// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/sampling/gust_spectrum.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "wind/fade.h"
#include "wind/gauss_markov.h"
#include "wind/laws.h"

namespace vegetation_sim::wind {
namespace {

constexpr Nanoseconds INTERVAL = NANOSECONDS_PER_SECOND / 10;
// A rise by smootherStep in a time T has its steepest slope 15 / 8 T, as an oscillation of half its
// height at this frequency times 1 / T.
constexpr double RISE = 15.0 / (8.0 * PI);
constexpr double LINGER = 2.0;     // [s] time that a plant still oscillates after a step
constexpr double SHORTEST = 1e-3;  // [s] shorter fades all act as steps

template <std::size_t N>
std::pair<std::size_t, double> between(const std::array<double, N>& grid, double value) {
  std::size_t i = 0;
  while (i + 2 < N && grid[i + 1] <= value) ++i;
  return {i, saturate((value - grid[i]) / (grid[i + 1] - grid[i]))};
}

// Returns the frequency [Hz] at which something of a given size that moves past a place comes and
// goes.
double passingOf(const Field& field, std::size_t index, Nanoseconds stamp, const Term& now,
                 double size) {
  Term next;
  if (!field.termAt(index, stamp + INTERVAL, next)) return 0.0;
  return length(next.centre - now.centre) / secondsBetween(0, INTERVAL) / (4.0 * size);
}

// Returns the frequency [Hz] of a term; a gust counts by its steeper side.
double frequencyOf(const Field& field, std::size_t index, Nanoseconds stamp, const Term& now) {
  const Primitive& p = field.primitives()[index];
  if (now.kind == Kind::GUST) return RISE * p.front_speed / std::min(p.rise_length, p.decay_length);
  if (now.kind != Kind::DISK) return passingOf(field, index, stamp, now, p.core_radius);
  return std::max(std::fabs(p.omega) / (2.0 * PI), passingOf(field, index, stamp, now, p.radius));
}

// Returns the frequency [Hz] at which an eddy starts or ends, or 0 if it does neither. Plants
// oscillate for a while afterwards.
double onsetOf(const Primitive& p, Nanoseconds stamp) {
  const auto fades = [&](Nanoseconds from, double duration) {
    const double since = secondsBetween(from, stamp);
    return since >= 0.0 && since < duration + LINGER;
  };
  double out = 0.0;
  if (fades(p.t_on, p.fade_in)) out = RISE / std::max(p.fade_in, SHORTEST);
  if (p.t_off != 0 && fades(p.t_off - fromSeconds(p.fade_out), p.fade_out))
    out = std::max(out, RISE / std::max(p.fade_out, SHORTEST));
  return out;
}

}  // namespace

void GustSpectrum::add(double frequency, double slowness, double square) {
  if (frequency < FREQUENCIES[0])
    square *= frequency * frequency / (FREQUENCIES[0] * FREQUENCIES[0]);
  const auto [f, across] = between(FREQUENCIES, frequency);
  const auto [s, along] = between(SLOWNESSES, slowness);
  power[s][f] += (1.0 - along) * (1.0 - across) * square;
  power[s][f + 1] += (1.0 - along) * across * square;
  power[s + 1][f] += along * (1.0 - across) * square;
  power[s + 1][f + 1] += along * across * square;
}

GustSpectrumField::GustSpectrumField(const Field& field, Nanoseconds stamp) {
  for (std::size_t i = 0; i < field.primitives().size(); ++i) {
    const Primitive& p = field.primitives()[i];
    Term term;
    if (p.kind == Kind::BREEZE) addBreeze(p, fade(p, stamp), field.breezeOf(i));
    if (!field.termAt(i, stamp, term)) continue;
    if (p.kind == Kind::GAUSS_MARKOV) {
      addGaussMarkov(p, fade(p, stamp), term);
      continue;
    }
    const bool gust = term.kind == Kind::GUST, disk = term.kind == Kind::DISK;
    has_disks_ |= disk;
    const double onset = gust || disk ? 0.0 : onsetOf(p, stamp);
    parts_.push_back({term, frequencyOf(field, i, stamp, term), gust ? 0.5 : 1.0, onset, disk});
  }
}

void GustSpectrumField::addBreeze(const Primitive& p, double weight, const Breeze& breeze) {
  mean_ += weight * p.velocity;
  const double carrier = std::max(length(p.velocity), Breeze::LEAST_CARRIER);
  for (const Breeze::Wave& wave : breeze.waves()) {
    const double rms = weight * length(wave.at_epoch.amplitude) / std::sqrt(2.0);
    breezes_.add(wave.frequency, 1.0 / carrier, PEAK * PEAK * rms * rms);
    turbulence_ += PEAK * PEAK * rms * rms;
  }
}

// Parts are one for the variance of each band, whose share is that of the Lorentzian, and one for
// what the peaks have beyond them: the steady mean.
void GustSpectrumField::addGaussMarkov(const Primitive& p, double weight, Term term) {
  const double speed = length(p.velocity), peak = PEAK * GaussMarkov(p, 0).rms();
  const auto below = [&](double f) {
    return 2.0 / PI * arcTangent(2.0 * PI * f * p.time_scale, 1.0);
  };
  const auto& frequencies = GustSpectrum::FREQUENCIES;
  double low = 0.0;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const bool last = i + 1 == frequencies.size();
    const double high = last ? 1.0 : below(std::sqrt(frequencies[i] * frequencies[i + 1]));
    term.peak = weight * peak * std::sqrt(high - low);
    parts_.push_back({term, frequencies[i], 1.0, 0.0, false});
    low = high;
  }
  term.peak = weight * std::sqrt(speed * (speed + 2.0 * peak));
  parts_.push_back({term, 0.0, 0.0, 0.0, false});
}

GustSpectrum GustSpectrumField::atOf(const Vec3& position, double reach, bool disks) const {
  GustSpectrum out = breezes_;
  double square = turbulence_;
  for (const Part& part : parts_) {
    if (part.disk && !disks) continue;
    const double bound = boundOf(part.term, position, reach), speed = part.share * bound;
    square += bound * bound;
    if (speed > 0.0) out.add(part.frequency, 0.0, speed * speed);
    if (part.onset > 0.0) out.add(part.onset, 0.0, 0.25 * bound * bound);
  }
  out.peak = length(mean_) + std::sqrt(square);
  return out;
}

}  // namespace vegetation_sim::wind
