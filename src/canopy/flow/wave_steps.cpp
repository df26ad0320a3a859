// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/wave_steps.h"

#include <cmath>

#include "vegetation_sim/canopy/plane/fourier_plane.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

// The two solutions that start with (1, 0) and (0, 1) when alpha is 0, times exp(-alpha dt).
struct Solutions {
  double cosine, sine;
};

// Near critical damping, sine and cosine or their hyperbolic forms are series in x = -(W^2 -
// alpha^2) dt^2 without a division by a root; the first omitted term is below 1e-18.
Solutions nearCritical(double x, double decay, double dt) {
  double cosine = 1.0, sine = 1.0, power = 1.0;
  for (int n = 1; n <= 8; ++n) {
    power *= x / (2.0 * n * (2.0 * n - 1.0));
    cosine += power;
    sine += power / (2.0 * n + 1.0);
  }
  return {decay * cosine, decay * sine * dt};
}

Solutions solutions(double alpha, double stiffness, double dt) {
  const double d = stiffness - alpha * alpha;
  if (std::fabs(d) * dt * dt < 0.5) return nearCritical(-d * dt * dt, exponential(-alpha * dt), dt);
  const double root = std::sqrt(std::fabs(d));
  if (d > 0.0) {
    const double decay = exponential(-alpha * dt);
    const SinCos turn = sinCos(root * dt);
    return {decay * turn.cos, decay * turn.sin / root};
  }
  // Exponents are added first, since exp(root dt) alone would overflow. The slow exponent is
  // computed without a difference of large numbers.
  const double slow = exponential(-stiffness / (alpha + root) * dt);
  const double fast = exponential(-(alpha + root) * dt);
  return {0.5 * (slow + fast), 0.5 * (slow - fast) / root};
}

}  // namespace

ModeStep modeStep(double alpha, double stiffness, double dt) {
  const Solutions s = solutions(alpha, stiffness, dt);
  return {s.cosine + alpha * s.sine, s.sine, -stiffness * s.sine, s.cosine - alpha * s.sine};
}

ModalStep::ModalStep(const WaveLaw& law, int size) : law_(law), size_(size) {
  const auto cells = static_cast<std::size_t>(size);
  steps_.resize(cells * cells);
  compliance_.resize(cells * cells);
}

// The last mode is cached, since most modes share their stiffness with seven others.
void ModalStep::setStep(double dt) {
  if (dt == dt_) return;
  dt_ = dt;
  const double square = law_.omega * law_.omega, wave = 2.0 * PI / law_.width * law_.speed;
  for (int i = 0; i <= size_ / 2; ++i)
    for (int j = 0; j <= i; ++j) {
      const double stiffness = square + wave * wave * (1.0 * i * i + 1.0 * j * j);
      const ModeStep step = modeStep(law_.damping * law_.omega, stiffness, dt);
      for (const int a : {i, (size_ - i) % size_})
        for (const int b : {j, (size_ - j) % size_})
          for (const int index : {a * size_ + b, b * size_ + a}) {
            steps_[static_cast<std::size_t>(index)] = step;
            compliance_[static_cast<std::size_t>(index)] = square / stiffness;
          }
    }
}

void ModalStep::step(double dt, const PlaneField& force, PlaneField& amplitude, PlaneField& rate) {
  setStep(dt);
  const auto advance = [&](const std::vector<double>& g, std::vector<double>& a,
                           std::vector<double>& v) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double rest = compliance_[i] * g[i], offset = a[i] - rest, speed = v[i];
      a[i] = rest + (steps_[i].keep * offset + steps_[i].from_rate * speed);
      v[i] = steps_[i].to_rate * offset + steps_[i].keep_rate * speed;
    }
  };
  advance(force.u, amplitude.u, rate.u);
  advance(force.v, amplitude.v, rate.v);
}

VerletStep::VerletStep(const WaveLaw& law, int size) : law_(law), pull_(size) {
  const double dx = law.width / size;
  longest_ = 2.0 / std::sqrt(8.0 * law.speed * law.speed / (dx * dx) + law.omega * law.omega);
}

void VerletStep::step(double dt, const PlaneField& force, PlaneField& amplitude, PlaneField& rate) {
  const int size = amplitude.size, mask = size - 1;
  const double dx = law_.width / size, wave = law_.speed * law_.speed / (dx * dx);
  const double square = law_.omega * law_.omega, drag = law_.damping * law_.omega * dt;
  const auto advance = [&](const std::vector<double>& g, std::vector<double>& a,
                           std::vector<double>& v, std::vector<double>& pull) {
    for (int row = 0; row < size; ++row) {
      const double* here = a.data() + row * size;
      const double* below = a.data() + ((row - 1) & mask) * size;
      const double* above = a.data() + ((row + 1) & mask) * size;
      for (int i = 0; i < size; ++i) {
        const double around = (here[(i - 1) & mask] + here[(i + 1) & mask]) + (below[i] + above[i]);
        const auto cell = static_cast<std::size_t>(row * size + i);
        pull[cell] = square * (g[cell] - here[i]) + wave * (around - 4.0 * here[i]);
      }
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      v[i] = ((1.0 - drag) * v[i] + dt * pull[i]) / (1.0 + drag);
      a[i] += dt * v[i];
    }
  };
  advance(force.u, amplitude.u, rate.u, pull_.u);
  advance(force.v, amplitude.v, rate.v, pull_.v);
}

}  // namespace vegetation_sim::canopy
