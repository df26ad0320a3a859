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
  double frequency{1.2};  ///< natural frequency of a leaf or twig [Hz]
  double damping{0.15};   ///< share of the critical damping
  double speed{0.4};      ///< speed of waves through the leaves [m/s]
  double limit{12.0};     ///< limit of the force: w / (1 + |w| / limit) [m/s]
};
void describe(FieldVisitor& visitor, OscillatorSettings& settings);

/// State of the leaves: spectra for the exact integrator, cells for Verlet's.
struct OscillatorState {
  PlaneField amplitude, rate;
  double depth{0.0}, depth_rate{0.0};  ///< motion along the plane's normal, equal in all cells
  void addTo(Hash& hash) const;
};

/// The leaves as a field of damped oscillators that are coupled to their neighbours and driven by
/// the wind in the plane (S3-12). Their amplitude is V_s of paper 3 [m/s].
class Oscillator {
 public:
  /// limit for Verlet; the rest of a longer step is skipped
  static constexpr int MOST_SUBSTEPS = 4096;

  /// @param size size of the field. @param width side of the square [m]. @throws InvalidInput
  Oscillator(const OscillatorSettings& settings, int size, double width);

  const OscillatorState& state() const { return state_; }
  /// Returns V_s of each cell [m/s].
  const PlaneField& motion() const { return motion_; }
  /// Returns V_s along the normal [m/s].
  double depth() const { return state_.depth; }
  /// Returns the number of steps longer than Verlet's limit, which were divided.
  std::uint64_t divided() const { return divided_; }

  void reset();
  /// @throws InvalidInput for another size or if a value is not finite.
  void restore(const OscillatorState& state);
  /// @param depth_wind wind along the normal [m/s]. A dt of 0, negative or NaN does nothing.
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
