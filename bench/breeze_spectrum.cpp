// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Simulates a breeze for ten minutes at one point and compares mean, rms and spectral density with
// the law in docs/wind.md.
// usage: breeze_spectrum [--quick | --full] --csv FILE
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "options.h"
#include "table.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/breeze.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::wind {
namespace {

constexpr double RATE = 8.0, DURATION = 600.0;  // [Hz], [s]
constexpr int COMPONENTS = 3;
constexpr double SPEED = 5.0, TURBULENCE = 0.3;
constexpr double BAND = 1.25;  // ratio of the edges of a band of the density
const std::array<const char*, COMPONENTS> NAMES = {"along", "across", "up"};
const std::array<double, COMPONENTS> SHARES = {1.0, Breeze::LATERAL, Breeze::VERTICAL};

using Record = std::vector<double>;

Primitive breeze() {
  Primitive p;
  p.name = "breeze";
  p.kind = Kind::BREEZE;
  p.fade_in = 0.0;
  p.velocity = Vec3(SPEED, 0.0, 0.0);
  p.turbulence = TURBULENCE;
  return p;
}

std::array<Record, COMPONENTS> record(std::uint64_t seed) {
  const Field field({breeze()}, seed);
  std::array<Record, COMPONENTS> out;
  for (int i = 0; i < static_cast<int>(RATE * DURATION); ++i) {
    const Vec3 air = field.velocity(Vec3(0.0, 0.0, 2.0), fromSeconds(i / RATE));
    for (int c = 0; c < COMPONENTS; ++c) out[static_cast<std::size_t>(c)].push_back(air[c]);
  }
  return out;
}

double meanOf(const Record& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double rmsOf(const Record& x) {
  const double mean = meanOf(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// Adds the one-sided density [(m/s)^2/Hz] at multiples of 1 / DURATION, by Hann's window.
void addDensity(Record x, Record& density) {
  const double mean = meanOf(x), n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = (x[i] - mean) * (1.0 - sinCosTurns(static_cast<double>(i) / n).cos);
  for (std::size_t k = 1; k < density.size(); ++k) {
    const SinCos step = sinCosTurns(static_cast<double>(k) / n);
    double re = 0.0, im = 0.0, c = 1.0, s = 0.0;
    for (const double value : x) {
      re += value * c;
      im += value * s;
      const double next = c * step.cos - s * step.sin;
      s = s * step.cos + c * step.sin;
      c = next;
    }
    density[k] +=
        2.0 * (re * re + im * im) / (n * n * 1.5) * DURATION;  // 1.5: mean square of the window
  }
}

/// Returns the factor from von Karman's density to that of the band with the whole variance in it.
double bandFactor() {
  double sum = 0.0;
  const double ratio = 1.0005;
  for (double f = Breeze::LOWEST_HZ; f < Breeze::HIGHEST_HZ; f *= ratio)
    sum += vonKarmanDensity(f, 1.0, breeze().length_scale, SPEED) * f * (ratio - 1.0);
  return 1.0 / sum;
}

void writeDensity(const Record& density, int component, int seeds, bench::Table& table) {
  const auto c = static_cast<std::size_t>(component);
  const double sigma = TURBULENCE * SPEED * SHARES[c], factor = bandFactor();
  for (double low = 0.004; low < 3.0; low *= BAND) {
    const auto first = static_cast<std::size_t>(std::ceil(low * DURATION));
    const auto last = static_cast<std::size_t>(std::ceil(low * BAND * DURATION));
    if (first == last || last > density.size()) continue;
    double sum = 0.0;
    for (std::size_t k = first; k < last; ++k) sum += density[k] / seeds;
    const double f = low * std::sqrt(BAND);
    const bool inside = f > Breeze::LOWEST_HZ && f < Breeze::HIGHEST_HZ;
    table.row(std::string("density_") + NAMES[c], f, sum / static_cast<double>(last - first),
              inside ? factor * vonKarmanDensity(f, sigma, breeze().length_scale, SPEED) : 0.0);
  }
}

void run(const bench::Options& options) {
  const int seeds = options.quick ? 4 : 64;
  bench::Table table(options.csv, "quantity,seed_or_hz,measured,stated");
  std::array<Record, COMPONENTS> density;
  density.fill(Record(static_cast<std::size_t>(0.5 * RATE * DURATION), 0.0));
  for (int seed = 0; seed < seeds; ++seed) {
    const auto air = record(static_cast<std::uint64_t>(seed));
    for (std::size_t c = 0; c < COMPONENTS; ++c) {
      const std::string name = NAMES[c];
      table.row("mean_" + name, seed, meanOf(air[c]), c == 0 ? SPEED : 0.0);
      table.row("rms_" + name, seed, rmsOf(air[c]), TURBULENCE * SPEED * SHARES[c]);
      addDensity(air[c], density[c]);
    }
  }
  for (int c = 0; c < COMPONENTS; ++c)
    writeDensity(density[static_cast<std::size_t>(c)], c, seeds, table);
}

}  // namespace
}  // namespace vegetation_sim::wind

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    wind::run(bench::readOptions(argc, argv, {}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "breeze_spectrum: %s\n", error.what());
    return 1;
  }
  return 0;
}
