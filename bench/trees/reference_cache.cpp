// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "trees/reference.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::bench {
namespace {

bool read(const std::string& path, std::size_t tips, int intervals, Reference& out) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  const auto number = [&] {
    double value = 0.0;
    file.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  };
  out.converged = number();
  out.steps = static_cast<int>(number());
  out.seconds = number();
  out.motion.assign(static_cast<std::size_t>(intervals), std::vector<Vec3>(tips));
  for (auto& instant : out.motion)
    for (Vec3& tip : instant)
      for (int axis = 0; axis < 3; ++axis) tip[axis] = number();
  return file.good() && out.steps >= 1 && out.converged >= 0.0 && out.seconds >= 0.0;
}

void write(const std::string& path, const Reference& reference) {
  std::ofstream file(path, std::ios::binary);
  const auto number = [&](double value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  number(reference.converged);
  number(reference.steps);
  number(reference.seconds);
  for (const auto& instant : reference.motion)
    for (const Vec3& tip : instant) number(tip.x()), number(tip.y()), number(tip.z());
}

std::string fileOf(const TestTree& tree, const TestLoad& load, Bend bend, double tolerance,
                   int intervals) {
  Hash hash;
  hash.add(std::uint64_t{2});  // layout of the file
  hash.add(tree.hash());
  hash.add(tolerance);
  if (intervals != INTERVALS) hash.add(static_cast<std::uint64_t>(intervals));
  for (const std::string& word : {std::string(load.name()), std::string(nameOf(bend))})
    hash.add(word);
  for (std::size_t i = 0; i < load.links.size(); ++i) {
    hash.add(static_cast<std::uint64_t>(load.links[i]));
    hash.add(load.force[i]);
    hash.add(load.along[i]);
  }
  char name[40];
  std::snprintf(name, sizeof name, "/%016llx.motion",
                static_cast<unsigned long long>(hash.value()));
  return name;
}

int finer(int steps) {
  return steps + (steps + 1) / 2;
}

// Returns whether the tolerance holds, or the next run would take more than `cap` seconds.
bool isEnough(const Reference& reference, double tolerance, double cap) {
  return reference.converged <= tolerance ||
         (reference.converged < 1e-4 && 1.5 * reference.seconds > cap);
}

}  // namespace

Reference referenceOf(const TestTree& tree, const TestLoad& load, Bend bend, double tolerance,
                      double cap, const std::string& folder, int intervals) {
  Reference out;
  ReferenceChain chain(tree, load, bend);
  out.rest = {chain.tips(std::vector<double>(4 * tree.links.size(), 0.0))};
  const std::string path = folder + fileOf(tree, load, bend, tolerance, intervals),
                    whole = folder + fileOf(tree, load, bend, tolerance, INTERVALS);
  out.converged = 1.0;
  // A shorter window is the beginning of the whole, so the file of the whole serves too.
  for (const std::string& kept : {whole, path}) {
    Reference found = out;
    if (folder.empty() || !read(kept, out.rest[0].size(), intervals, found)) continue;
    if (kept == whole) found.seconds *= static_cast<double>(intervals) / INTERVALS;
    if (isEnough(found, tolerance, cap)) return found;
    if (found.converged < out.converged) out = found;
  }
  for (int steps = std::max(4, finer(out.steps));; steps = finer(steps)) {
    const auto start = std::chrono::steady_clock::now();
    Reference next;
    next.rest = out.rest;
    next.motion = chain.run(steps, intervals);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (next.motion.empty()) continue;  // unstable
    if (!out.motion.empty()) {
      const double gain = std::pow(static_cast<double>(steps) / out.steps, 4.0) - 1.0;
      out.converged = relativeError(out.motion, next) / gain;
    }
    out.motion = std::move(next.motion);
    out.steps = steps;
    out.seconds = spent.count();
    if (isEnough(out, tolerance, cap)) break;
  }
  if (!folder.empty()) write(path, out);
  return out;
}

}  // namespace vegetation_sim::bench
