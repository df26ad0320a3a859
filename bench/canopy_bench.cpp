// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures leafy masses: the cost of a fluid step by scheme and size with its error, oscillators,
// layers, the cost of a tick over the number of leaves, layers against leaves that each move alone,
// two ways to give layers behind the first one its past, and pictures of layers against leaves.
// usage: canopy_bench [ROUNDS] [--quick] [--part steps,errors,leaves,truth,delays,pictures] [--csv
// FILE]

#include <cmath>
#include <cstdio>
#include <memory>

#include "options.h"
#include "processor_time.h"
#include "scenes/canopy/canopy_scene.h"
#include "scenes/canopy/delay_scene.h"
#include "scenes/canopy/leaf_truth.h"
#include "scenes/canopy/plane_scene.h"
#include "scenes/canopy/shrub_bank.h"
#include "scenes/canopy/spectral_reference.h"
#include "table.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::canopy {
namespace {

using bench::Candidate;

constexpr double TICK = 1.0 / 30.0;  // [s]
constexpr int SCHEMES = 3;
const char* const NAMES[SCHEMES] = {"reflection", "fast", "paper"};

FluidSettings settingsOf(int scheme, int cells, double width, double viscosity) {
  FluidSettings out;
  out.scheme = static_cast<Scheme>(scheme);
  out.cells = cells;
  out.width = width;
  out.viscosity = viscosity;
  return out;
}

std::shared_ptr<Fluid> fluidWith(const FluidSettings& settings, const PlaneField& flow) {
  auto out = std::make_shared<Fluid>(settings, SourceSettings(), 1);
  FluidState state;
  state.flow = flow;
  out->restore(state);
  return out;
}

void report(std::vector<Candidate>& candidates, int rounds, int cells, bench::Table& table) {
  bench::timeOnProcessor(candidates, rounds);
  const double unit = candidates.back().seconds;  // the paper's step is the last one
  for (const Candidate& candidate : candidates) {
    std::printf("%4d  %-28s %9.4f ms   %7.2f x faster than the paper's step\n", cells,
                candidate.name.c_str(), 1e3 * candidate.seconds, unit / candidate.seconds);
    table.row(candidate.name, cells, 1e3 * candidate.seconds, unit / candidate.seconds);
  }
}

// Measures steps with viscosity, as scenes have it; the paper's solver then relaxes three times.
void benchSteps(const bench::Options& options, bench::Table& table) {
  for (const int cells : {64, 128, 256}) {
    std::vector<Candidate> candidates;
    const PlaneField flow = smoothFlow(cells, 1);
    auto leaves = std::make_shared<Oscillator>(OscillatorSettings(), cells, 4.0);
    OscillatorSettings verlet;
    verlet.integrator = LeafIntegrator::VERLET;
    auto stepped = std::make_shared<Oscillator>(verlet, cells, 4.0);
    auto history = std::make_shared<History>(cells, 31);
    for (int i = 0; i < 31; ++i) history->push(toFrame(smoothFlow(cells, 1), 0.1));
    candidates.push_back({"leaves, exact", [=] { leaves->advance(TICK, flow, 0.1); }});
    candidates.push_back({"leaves, Verlet", [=] { stepped->advance(TICK, flow, 0.1); }});
    candidates.push_back({"five layers from history", [=] {
                            const LayerSettings settings;
                            const LayerView view{&settings,           history.get(), TICK,
                                                 Vec3(0.0, 0.0, 1.0), 1.0,           4.0 / cells};
                            static LayerMotion out;
                            for (int i = 0; i < 5; ++i) layerMotion(view, 0.4 * i, 1.6, 2.0, out);
                          }});
    auto projection = std::make_shared<ProjectionStep>(cells);
    auto projected = std::make_shared<PlaneField>(flow);
    candidates.push_back({"projection, exact", [=] { projection->project(*projected, 0.0); }});
    for (int scheme = 0; scheme < SCHEMES; ++scheme) {
      auto fluid = fluidWith(settingsOf(scheme, cells, 4.0, 1e-3), flow);
      candidates.push_back(
          {std::string("air, ") + NAMES[scheme], [=] { fluid->advance(0.0, TICK); }});
    }
    report(candidates, options.quick ? 5 : 10 * options.rounds, cells, table);
  }
}

double fastest(const PlaneField& flow) {
  double out = 0.0;
  for (std::size_t i = 0; i < flow.u.size(); ++i)
    out = std::max(out, std::sqrt(flow.u[i] * flow.u[i] + flow.v[i] * flow.v[i]));
  return out;
}

double errorOf(int scheme, int cells, double cfl, std::uint64_t seed, SpectralReference& truth) {
  const double end = 0.25;
  const PlaneField start = smoothFlow(cells, seed);
  const auto fluid = fluidWith(settingsOf(scheme, cells, 1.0, 0.0), start);
  const double steps = std::ceil(end * cells * fastest(start) / cfl);
  for (double i = 0.0; i < steps; i += 1.0) fluid->advance(0.0, end / steps);
  return relativeError(fluid->state().flow, truth.flow(128 / cells));
}

void benchErrors(const bench::Options& options, bench::Table& table) {
  std::printf("\nerror after 0.25 s of a smooth flow of 1 m/s rms on 1 m, %s\n",
              options.quick ? "one seed" : "mean of three seeds");
  const std::uint64_t seeds = options.quick ? 1 : 3;
  double error[SCHEMES][2][2] = {};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SpectralReference truth(smoothFlow(128, seed));
    for (int i = 0; i < 128; ++i) truth.step(0.25 / 128);
    for (int scheme = 0; scheme < SCHEMES; ++scheme)
      for (int large = 0; large < 2; ++large)
        for (int fast = 0; fast < 2; ++fast)
          error[scheme][large][fast] +=
              errorOf(scheme, large ? 128 : 64, fast ? 4.0 : 1.0, seed, truth) /
              static_cast<double>(seeds);
  }
  for (int scheme = 0; scheme < SCHEMES; ++scheme)
    for (int large = 0; large < 2; ++large)
      for (int fast = 0; fast < 2; ++fast) {
        const double value = error[scheme][large][fast], paper = error[SCHEMES - 1][large][fast];
        std::printf("%4d  CFL %d  %-12s %.4f   %.3f of the paper's\n", large ? 128 : 64,
                    fast ? 4 : 1, NAMES[scheme], value, value / paper);
        table.row(std::string("error, ") + NAMES[scheme] + (fast ? ", CFL 4" : ", CFL 1"),
                  large ? 128 : 64, value, value / paper);
      }
}

struct Crowd {
  double faces;
  int instances;  // of every plant, each moved alone
};

Layout threeShrubs(double faces) {
  Layout out = shrubScene(64);
  out.plants.push_back(out.plants[1]);
  out.plants[2].position = Vec3(1.0, -1.5, 0.0);
  out.kinds[0].leaves = static_cast<int>(faces / 6.0);  // each leaf has two faces
  return out;
}

double moveAll(const Foliage& foliage, const std::vector<GrownPlant>& grown, int instances) {
  double sum = 0.0;
  for (int instance = 0; instance < instances; ++instance) {
    const Vec3 offset(0.3 * instance, 0.2 * instance, 0.0);
    for (std::size_t plant = 0; plant < grown.size(); ++plant)
      for (Leaf leaf : grown[plant].leaves) {
        leaf.anchor += offset;
        leaf.root += offset;
        leaf.tip += offset;
        sum += foliage.move(leaf, plant).tip.x();
      }
  }
  return sum;
}

// S3-28: measures a tick of the simulation and the motion of every leaf over the number of faces.
void benchLeaves(const bench::Options& options, bench::Table& table) {
  std::printf("\nwhole tick (air, leaves, history, layers) and moving all leaves, 64 x 64\n");
  std::vector<Crowd> crowds{{80e3, 1}, {5e6, 1}, {5e6, 10}};
  if (options.quick) crowds = {{80e3, 1}, {2e5, 1}};
  for (const Crowd& crowd : crowds) {
    const Layout layout = threeShrubs(crowd.faces);
    auto canopy = std::make_shared<Canopy>(layout);
    canopy->setWind(breezeFrom(Vec3(1.0, 5.0, 0.0)));
    auto grown = std::make_shared<std::vector<GrownPlant>>();
    for (const Plant& plant : layout.plants) grown->push_back(grow(layout.kinds[0], plant));
    int tick = 0;
    double sum = 0.0;
    std::vector<Candidate> parts{
        {"tick",
         [=, &tick] {
           for (int i = 0; i < 20; ++i) {
             canopy->advance(tickStamp(++tick));
             canopy->foliage();
           }
         }},
        {"leaves", [=, &sum] { sum += moveAll(canopy->foliage(), *grown, crowd.instances); }}};
    bench::timeOnProcessor(parts, options.quick ? 3 : std::min(5, options.rounds));
    const double faces = crowd.faces * crowd.instances, simulated = parts[0].seconds / 20.0;
    std::printf("%9.0f faces: tick %.3f ms, leaves %.2f ms (%.0f ns each)%s\n", faces,
                1e3 * simulated, 1e3 * parts[1].seconds, 2e9 * parts[1].seconds / faces,
                std::isfinite(sum) ? "" : "!");
    table.row("tick", faces, 1e3 * simulated, 0.0);
    table.row("leaves", faces, 1e3 * parts[1].seconds, 0.0);
  }
}

// S3-06: compares a shrub of 5 000 leaves in layers with leaves that each move alone.
void benchTruth(const bench::Options& options, bench::Table& table) {
  const int leaves = options.quick ? 800 : 5000, from = 120, to = options.quick ? 240 : 480;
  std::printf("\nlayers against every leaf on its own, a shrub of %d leaves\n", leaves);
  const AirRecord air(lonelyShrub(1, 1), to + 60);
  for (const double variety : {0.0, 0.15})
    for (int layers = 1; layers <= 9; ++layers) {
      const TruthError got =
          compareWithTruth(leaves, layers, variety, from, to, air, bench::processorTime);
      std::printf(
          "own frequencies +-%2.0f %%  %d layers: error %.4f, %.3f ms; on its own %.2f ms\n",
          100.0 * variety, layers, got.error, 1e3 * got.model, 1e3 * got.truth);
      table.row(variety > 0.0 ? "truth, own" : "truth, alike", layers, got.error, 1e3 * got.model);
      if (layers == 9) table.row("truth, cost", 0, got.error, 1e3 * got.truth);
    }
}

// S3-18, S3-22: measures a layer some time behind the first, from the history and by the one
// look-up.
void benchDelays(const bench::Options& options, bench::Table& table) {
  History history(64, 31);
  for (int i = 0; i < 31; ++i) history.push(toFrame(smoothFlow(64, 1), 0.0));
  const auto layerBy = [&](int model) {
    return [&history, model] {
      LayerSettings settings;
      settings.model = static_cast<LayerModel>(model);
      LayerMotion layer;
      layerMotion(viewOf(settings, history), 1.0, 1.0, 2.0, layer);
    };
  };
  std::vector<Candidate> candidates{{"history", layerBy(0)}, {"lookup", layerBy(1)}};
  bench::timeOnProcessor(candidates, options.rounds);
  const double costs[3] = {1e3 * candidates[0].seconds, 1e3 * candidates[1].seconds, 0.0};
  std::printf("\na layer of 64 x 64 behind the first one in gusts, error by delay\n");
  for (const int quarters : {1, 3, 7, 15, 31, 61, 91, 117}) {
    if (options.quick && quarters % 4 == 1 && quarters > 1) continue;
    const double delay = quarters / 120.0;
    const GustErrors errors = errorsInGusts(delay);
    std::printf("%.3f s: history %.4f (%.4f ms), look-up %.3f (%.4f ms), no delay %.3f\n", delay,
                errors.history, costs[0], errors.lookup, costs[1], errors.nothing);
    table.row("history", delay, errors.history, costs[0]);
    table.row("lookup", delay, errors.lookup, costs[1]);
    table.row("nothing", delay, errors.nothing, costs[2]);
  }
}

// S3-27: compares pictures of layers, warped on grids, with every leaf in the same layers.
void benchPictures(const bench::Options& options, bench::Table& table) {
  std::printf("\npictures of layers against their leaves, at %.0f pixels per radian\n", PIXELS);
  for (const int layers : {1, 3, 5, 9}) {
    ShrubBank bank(layers);
    bank.blow(Vec3(0.0, 8.0, 0.0), 200);
    bank.makeGrids();
    for (const double shift : {0.0, 0.3, 1.0}) {
      const Vec3 eye = ShrubBank::eye() + Vec3(0.0, shift, 0.0);
      const std::vector<double> errors = bank.errors(eye);
      const double most = errors[errors.size() * 99 / 100];
      std::printf("%d layers, eye moved by %.1f m: rms %.3f, 99 %% %.3f, predicted %.3f pixels\n",
                  layers, shift, bank.rms(eye), most, bank.predicted(eye));
      char name[32];
      std::snprintf(name, sizeof name, "pictures, %.1f m", shift);
      table.row(name, layers, bank.rms(eye), most);
      std::snprintf(name, sizeof name, "predicted, %.1f m", shift);
      table.row(name, layers, bank.predicted(eye), 0.0);
    }
    std::vector<Candidate> candidates{{"grids", [&bank] { bank.moveGrids(); }},
                                      {"leaves", [&bank] { bank.moveLeaves(); }}};
    bench::timeOnProcessor(candidates, options.rounds);
    std::printf("%d layers: grids %.2f ms, %zu leaves %.2f ms\n", layers,
                1e3 * candidates[0].seconds, bank.leafCount(), 1e3 * candidates[1].seconds);
    table.row("cost, grids", layers, 1e3 * candidates[0].seconds, 0.0);
    table.row("cost, leaves", layers, 1e3 * candidates[1].seconds, 0.0);
  }
}

}  // namespace
}  // namespace vegetation_sim::canopy

int main(int argc, char** argv) {
  using namespace vegetation_sim;
  const bench::Options options =
      bench::readOptions(argc, argv, {"steps", "errors", "leaves", "truth", "delays", "pictures"});
  bench::Table table(options.csv, "what,size,value,ratio");
  if (options.wants("steps")) canopy::benchSteps(options, table);
  if (options.wants("errors")) canopy::benchErrors(options, table);
  if (options.wants("leaves")) canopy::benchLeaves(options, table);
  if (options.wants("truth")) canopy::benchTruth(options, table);
  if (options.wants("delays")) canopy::benchDelays(options, table);
  if (options.wants("pictures")) canopy::benchPictures(options, table);
  return 0;
}
