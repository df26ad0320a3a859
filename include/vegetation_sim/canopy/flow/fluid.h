// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vegetation_sim/canopy/flow/projection_step.h"
#include "vegetation_sim/canopy/flow/wind_sources.h"
#include "vegetation_sim/canopy/plane/advection.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/reference/canopy/paper_solver.h"

namespace vegetation_sim::canopy {

/// Numerical scheme of the air in the plane. docs/canopy.md compares cost and error.
enum class Scheme : int {
  REFLECTION = 0,  ///< advection-reflection, cubic: the default
  FAST = 1,        ///< bilinear advection and one exact projection
  PAPER = 2        ///< Stam's with Gauss-Seidel sweeps, as in paper 3 (S3-11)
};

struct FluidSettings {
  Scheme scheme{Scheme::REFLECTION};
  int cells{64};           ///< cells along a side, a power of two
  double width{4.0};       ///< side of the square [m]
  double viscosity{1e-3};  ///< kinematic viscosity, including eddies below a cell [m^2/s]
  int sweeps{20};          ///< Gauss-Seidel sweeps of the paper's scheme
};
/// Visits all fields but the width, which is the plane's.
void describe(FieldVisitor& visitor, FluidSettings& settings);
/// Adds all faults, including the width and a number of cells that is not a power of two.
void check(FluidSettings settings, const std::string& context, Faults& faults);

/// State of the air.
struct FluidState {
  PlaneField flow;  ///< [m/s]
  Turbulence turbulence{};
  std::uint64_t steps{0};
  void addTo(Hash& hash) const;
};

/// Faults that were contained so far.
struct FluidFigures {
  std::uint64_t resets{0};  ///< steps whose result was not finite; the flow before them was kept
  double skipped{0.0};      ///< time skipped by steps that were too long [s]
};

/// Wind in a periodic square of the simulation plane (S3-09, S3-11). Stable for any step: a step
/// that is too long is divided, and one whose result is not finite is undone.
class Fluid {
 public:
  static constexpr double LONGEST_SUBSTEP = 0.034;  ///< [s]
  static constexpr int MOST_SUBSTEPS = 300;         ///< The rest of a longer step is skipped.

  /// @throws InvalidInput for settings out of range.
  Fluid(const FluidSettings& settings, const SourceSettings& sources, std::uint64_t seed);

  const FluidSettings& settings() const { return settings_; }
  const FluidState& state() const { return state_; }
  const FluidFigures& figures() const { return figures_; }

  /// Replaces the wind sources from the next step on.
  void setSources(const Sources& sources) { sources_ = sources; }
  /// Sets the air to rest.
  void reset();
  /// @throws InvalidInput for another size or if a value is not finite.
  void restore(const FluidState& state);

  /// @param from start of the step since the epoch [s]. @param dt length [s]; 0, negative or NaN
  /// does nothing. @param air wind on the plane, or null.
  void advance(double from, double dt, const PlaneAir* air = nullptr);

 private:
  void substep(const Interval& interval, const PlaneAir* air);
  void reflect(const Interval& interval, const PlaneAir* air, double cells, double decay);
  void blow(const Interval& interval, const PlaneAir* air, PlaneField& flow);
  void limitEnergy(double most);

  FluidSettings settings_;
  Sources sources_;
  ProjectionStep projection_;
  PaperSolver paper_;
  FluidState state_;
  FluidFigures figures_;
  PlaneField last_good_, half_, reflected_;
  double given_{0.0};  // energy that the sources added in this step
};

}  // namespace vegetation_sim::canopy
