// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vegetation_sim/canopy/flow/wave_steps.h"
#include "vegetation_sim/canopy/plane/fourier_plane.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::canopy {

/// EXACT integrates mode by mode; VERLET is the paper's scheme (S3-12).
enum class LeafIntegrator { EXACT, VERLET };

struct OscillatorSettings {
  LeafIntegrator integrator{LeafIntegrator::EXACT};
  double frequency{1.2};  ///< of a leaf or twig [Hz]
  double damping{0.15};   ///< share of the critical one
  double speed{0.4};      ///< of waves through the leaves [m/s]
  double limit{12.0};     ///< force that even a storm does not pass: w / (1 + |w| / limit) [m/s]
};
void describe(FieldVisitor& visitor, OscillatorSettings& settings);

/// What the leaves remember: spectra of the exact integrator, cells of Verlet's.
struct OscillatorState {
  PlaneField amplitude, rate;
  double depth{0.0}, depth_rate{0.0};  ///< of the motion along the plane's normal, all cells alike
  void addTo(Hash& hash) const;
};

/// The leaves as a field of damped oscillators that pull at their neighbours, driven by the wind in
/// the plane (S3-12). Their amplitude is paper 3's velocity V_s [m/s].
class Oscillator {
 public:
  static constexpr int MOST_SUBSTEPS = 4096;  ///< of Verlet; beyond, the rest of a step is skipped

  /// @param size a field size. @param width of the square [m]. @throws InvalidInput
  Oscillator(const OscillatorSettings& settings, int size, double width);

  const OscillatorState& state() const { return state_; }
  /// V_s, cell by cell [m/s].
  const PlaneField& motion() const { return motion_; }
  /// V_s along the normal [m/s].
  double depth() const { return state_.depth; }
  /// Steps that were longer than Verlet's limit, and divided.
  std::uint64_t divided() const { return divided_; }

  void reset();
  /// @throws InvalidInput for another size or for what is no number.
  void restore(const OscillatorState& state);
  /// @param depth_wind wind along the normal [m/s]. A dt of 0, less or no number does nothing.
  void advance(double dt, const PlaneField& wind, double depth_wind);

 private:
  void load(const PlaneField& wind);
  void show();

  OscillatorSettings settings_;
  WaveLaw law_;
  int size_;
  FourierPlane fourier_;
  ModalStep modal_;
  VerletStep verlet_;
  OscillatorState state_;
  PlaneField motion_, force_;
  std::uint64_t divided_{0};
};

}  // namespace vegetation_sim::canopy
