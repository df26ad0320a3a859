// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/lod/response_error.h"

#include <algorithm>
#include <cmath>

#include "dynamics/modes/harmonic_chain.h"
#include "tree/growth/branch_mass.h"
#include "tree/lod/bending.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/growth/response.h"
#include "vegetation_sim/tree/modal/modal_tree.h"
#include "vegetation_sim/wind/breeze.h"

namespace vegetation_sim::forest {
namespace {

using wind::GustSpectrum;

constexpr int TREES_PER_SCALE = 2;     // trees measured per species and scale
constexpr double RESPONSE_WIND = 0.5;  // [m/s] weak enough that no joint nears its limit

// A wave of the breezes at unit speed: its parts along and across, and its spread (wind/breeze.h).
// For uniform wind, along only.
wind::Mode waveOf(double frequency, double slowness, const Vec3& along) {
  using wind::Breeze;
  const Vec3 across(-along.y(), along.x(), 0.0), up = Vec3::UnitZ();
  wind::Mode out;
  out.amplitude = RESPONSE_WIND * along;
  if (slowness == 0.0) return out;
  out.amplitude += RESPONSE_WIND * (Breeze::LATERAL * across + Breeze::VERTICAL * up);
  out.amplitude *= RESPONSE_WIND / length(out.amplitude);
  const double spread = Breeze::DECAY / (2.0 * PI);
  out.wave = frequency * slowness * (along + spread * (across + up));
  return out;
}

/// Parts in phase with the cosine and the sine of a wave.
struct Pair {
  std::vector<double> cosine, sine;
};

/// Values of each tip in one wave.
struct TipSquares {
  std::vector<double> procedural, modal, fine;
};
using Row = std::array<TipSquares, GustSpectrum::FREQUENCIES.size()>;

/// A sample tree and the responses of all its tiers to a wave.
class Sample {
 public:
  Sample(const Tree& tree, const Species& species)
      : tree_(tree),
        links_(chainOf(tree.skeleton, species)),
        grips_(gripsOf(woodOf(tree.skeleton, species, Material::BEAM))),
        linear_(links_),
        full_(links_, grips_),
        modal_{ModalTree(tree, species), {}},
        fine_{ModalTree(tree, species, FINE_MODES), {}} {}

  void setFrequency(double frequency) {
    w_ = 2.0 * PI * frequency;
    full_.setFrequency(w_);
  }

  // Squares of the tips' distances from the full chain, per speed.
  TipSquares squaresIn(const wind::Mode& wave) {
    wind::Instant even, odd;
    even.modes = odd.modes = {wave};
    odd.modes[0].phase = 0.75;  // a quarter of a cycle later
    Pair right{torques(even), torques(odd)};
    full_.solve(right.cosine, right.sine);
    const Pair shown{proceduralBends(even), proceduralBends(odd)};
    return {squares(right, shown), squares(right, modalBends(modal_, even, odd)),
            squares(right, modalBends(fine_, even, odd))};
  }

  Bending bending(const Vec3& along) const {
    return bendingOf({tree_, links_, grips_, linear_, modal_.modes}, along);
  }

 private:
  /// The modal tree and its cache of waves.
  struct ModalTreeRig {
    ModalTree modes;
    ModalAir air;
  };

  static std::vector<physics::Grip> gripsOf(const Wood& wood) {
    std::vector<physics::Grip> out(wood.own.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Composite& body = wood.own[i];
      out[i].steady = body.drag;
      if (body.drag > 0.0) out[i].centre = body.drag_moment / body.drag;
    }
    return out;
  }

  // Load of uniform wind on the crown at rest.
  std::vector<double> torques(const wind::Instant& air) const {
    std::vector<physics::Wrench> out(links_.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Pose& rest = tree_.skeleton.branches[i].rest;
      const Vec3 arm = rotate(rest.orientation, grips_[i].centre);
      const Vec3 force = grips_[i].steady * air.velocity(rest.position + arm);
      out[i] = {force, cross(arm, force)};
    }
    return linear_.torquesOf(out);
  }

  std::vector<double> proceduralBends(const wind::Instant& air) const {
    return flat(allDepths(tree_, air));
  }

  Pair modalBends(ModalTreeRig& modal_tree, const wind::Instant& even,
                  const wind::Instant& odd) const {
    const ModalTree& tree = modal_tree.modes;
    Pair load;
    tree.loadOf(even, modal_tree.air, load.cosine);
    tree.loadOf(odd, modal_tree.air, load.sine);
    for (std::size_t m = 0; m < tree.size(); ++m) {
      const double own = tree.modes().frequency[m];
      const double in = own * own - w_ * w_, late = w_ * tree.modes().damping[m];
      const double size = in * in + late * late;
      const double c = load.cosine[m], s = load.sine[m];
      load.cosine[m] = (in * c - late * s) / size;
      load.sine[m] = (in * s + late * c) / size;
    }
    return {flat(tree.bendsOf(load.cosine)), flat(tree.bendsOf(load.sine))};
  }

  static std::vector<double> flat(const std::vector<JointAngles>& bends) {
    std::vector<double> out;
    out.reserve(2 * bends.size());
    for (const JointAngles& bend : bends) out.insert(out.end(), {bend.first, bend.second});
    return out;
  }

  std::vector<double> squares(const Pair& right, const Pair& shown) {
    std::vector<double> out(links_.size(), 0.0), off(2 * links_.size());
    for (const auto part : {&Pair::cosine, &Pair::sine}) {
      for (std::size_t k = 0; k < off.size(); ++k) off[k] = (shown.*part)[k] - (right.*part)[k];
      linear_.motionOf(off.data(), motion_);
      for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3 along = links_[i].length * axisZ(linear_.rest()[i].orientation);
        const Vec3 tip = motion_[i].move + cross(motion_[i].turn, along);
        out[i] += dot(tip, tip) / (RESPONSE_WIND * RESPONSE_WIND);
      }
    }
    return out;
  }

  const Tree& tree_;
  std::vector<physics::Link> links_;
  std::vector<physics::Grip> grips_;
  physics::LinearChain linear_;
  physics::HarmonicChain full_;
  ModalTreeRig modal_, fine_;
  std::vector<physics::SmallMotion> motion_;
  double w_{0.0};
};

// Returns the largest error of any tip in a breeze, whose power decreases with f^(-2/3) per band of
// frequencies.
std::size_t farthestIn(const Row& row, std::vector<double> TipSquares::*kind) {
  std::vector<double> sum((row[0].*kind).size(), 0.0);
  for (std::size_t f = 0; f < row.size(); ++f) {
    const double root = cubeRoot(GustSpectrum::FREQUENCIES[f]);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += (row[f].*kind)[i] / (root * root);
  }
  return static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

// A breeze excites all frequencies at once, so one tip has the largest error; uniform wind has one
// frequency, with a different tip at each.
template <std::size_t N>
void addRow(const Row& row, bool breeze, std::array<ErrorSquares, N>& out) {
  using Kinds = std::pair<std::vector<double> TipSquares::*, double ErrorSquares::*>;
  for (const auto& [kind, to] : {Kinds{&TipSquares::procedural, &ErrorSquares::procedural},
                                 Kinds{&TipSquares::modal, &ErrorSquares::modal},
                                 Kinds{&TipSquares::fine, &ErrorSquares::fine}}) {
    const std::size_t tip = farthestIn(row, kind);
    for (std::size_t f = 0; f < N; ++f) {
      const std::vector<double>& tips = row[f].*kind;
      out[f].*to +=
          (breeze ? tips[tip] : *std::max_element(tips.begin(), tips.end())) / TREES_PER_SCALE;
    }
  }
}

}  // namespace

PredictedError ResponseError::in(const GustSpectrum& spectrum) const {
  PredictedError out;
  for (std::size_t s = 0; s < spectrum.power.size(); ++s)
    for (std::size_t f = 0; f < spectrum.power[s].size(); ++f) {
      out.procedural += squares[s][f].procedural * spectrum.power[s][f];
      out.modal += squares[s][f].modal * spectrum.power[s][f];
      out.fine += squares[s][f].fine * spectrum.power[s][f];
    }
  return {std::sqrt(out.procedural), std::sqrt(out.modal), std::sqrt(out.fine), bend};
}

ResponseError measureResponseError(const Species& species, const MotionLaw& law, double scale) {
  ResponseError out;
  if (law.joint_model != JointModel::SWING) return out;
  for (int i = 0; i < TREES_PER_SCALE; ++i) {
    TreeSeed seed;
    seed.seed = static_cast<std::uint64_t>(i) + 1;
    seed.scale = scale;
    const Tree tree = growTree(seed, species, law);
    Sample sample(tree, species);
    const Vec3 along = i % 2 ? Vec3::UnitY() : Vec3::UnitX();
    std::array<Row, GustSpectrum::SLOWNESSES.size()> rows;
    for (std::size_t f = 0; f < GustSpectrum::FREQUENCIES.size(); ++f) {
      sample.setFrequency(GustSpectrum::FREQUENCIES[f]);
      for (std::size_t s = 0; s < rows.size(); ++s)
        rows[s][f] = sample.squaresIn(
            waveOf(GustSpectrum::FREQUENCIES[f], GustSpectrum::SLOWNESSES[s], along));
    }
    for (std::size_t s = 0; s < rows.size(); ++s)
      addRow(rows[s], GustSpectrum::SLOWNESSES[s] > 0.0, out.squares[s]);
    if (law.gain == Gain::COMPLIANCE) {
      const Bending bending = sample.bending(along);
      out.bend.procedural += bending.procedural / TREES_PER_SCALE;
      out.bend.modal += bending.modal / TREES_PER_SCALE;
    }
  }
  return out;
}

}  // namespace vegetation_sim::forest
