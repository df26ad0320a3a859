// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/chain_parts.h"

#include <algorithm>

namespace vegetation_sim::physics {
namespace {

constexpr std::size_t STEM = 0;

// Joints from each on to its tips.
std::vector<std::size_t> sizesOf(const std::vector<int>& parents) {
  std::vector<std::size_t> out(parents.size(), 1);
  for (std::size_t i = parents.size(); i-- > 0;)
    if (parents[i] >= 0) out[static_cast<std::size_t>(parents[i])] += out[i];
  return out;
}

// The part of each joint.
std::vector<std::size_t> partsOf(const std::vector<int>& parents, std::size_t most) {
  std::vector<std::size_t> out(parents.size(), STEM);
  if (parents.size() <= most) return out;
  const std::vector<std::size_t> sizes = sizesOf(parents);
  std::size_t last = STEM, room = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0 || sizes[i] > most / 2) continue;
    out[i] = out[static_cast<std::size_t>(parents[i])];
    if (out[i] != STEM) continue;
    if (room < sizes[i]) {
      ++last;
      room = most;
    }
    room -= sizes[i];
    out[i] = last;
  }
  return out;
}

struct Sorted {
  std::vector<std::vector<int>> joints;  // of each part
  std::vector<int> place;                // of each joint in its part
};

Sorted sorted(const std::vector<std::size_t>& part_of) {
  Sorted out;
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    if (part_of[i] >= out.joints.size()) out.joints.resize(part_of[i] + 1);
    out.place.push_back(static_cast<int>(out.joints[part_of[i]].size()));
    out.joints[part_of[i]].push_back(static_cast<int>(i));
  }
  return out;
}

// The parents of a part's joints in it; those of `joints` that hang on another go to `cut`.
std::vector<int> parentsWithin(const std::vector<int>& joints, const std::vector<int>& parents,
                               const std::vector<std::size_t>& part_of,
                               const std::vector<int>& place, std::vector<int>& cut) {
  std::vector<int> out;
  for (const int joint : joints) {
    const auto i = static_cast<std::size_t>(joint);
    const auto parent = static_cast<std::size_t>(parents[i]);
    const bool root = parents[i] < 0, inside = !root && part_of[parent] == part_of[i];
    out.push_back(inside ? place[parent] : -1);
    if (!inside && !root) cut.push_back(joint);
  }
  return out;
}

}  // namespace

int sortIntoParts(const std::vector<int>& parents, std::size_t most, int begin,
                  std::vector<ChainPart>& parts, std::vector<JointRows>& hung,
                  std::vector<int>& slots) {
  const std::vector<std::size_t> part_of = partsOf(parents, most);
  const Sorted all = sorted(part_of);
  std::vector<int> slot_of(parents.size()), cut;
  for (const std::vector<int>& joints : all.joints) {
    std::vector<int> own;
    parts.emplace_back();
    ChainPart& part = parts.back();
    part.begin = begin;
    part.end = begin = sortIntoLevels(parentsWithin(joints, parents, part_of, all.place, cut),
                                      begin, part.levels, own);
    for (std::size_t i = 0; i < joints.size(); ++i)
      slot_of[static_cast<std::size_t>(joints[i])] = own[i];
  }
  const auto below = [&](int joint) {
    return slot_of[static_cast<std::size_t>(parents[static_cast<std::size_t>(joint)])];
  };
  std::stable_sort(cut.begin(), cut.end(), [&](int a, int b) { return below(a) < below(b); });
  for (const int joint : cut) {
    const auto i = static_cast<std::size_t>(joint);
    ChainPart& part = parts[part_of[i]];
    part.roots.resize(static_cast<std::size_t>(part.levels[0].count));
    part.roots[static_cast<std::size_t>(slot_of[i] - part.begin)] = static_cast<int>(hung.size());
    hung.emplace_back();
    hung.back().slot = below(joint);
  }
  slots.insert(slots.end(), slot_of.begin(), slot_of.end());
  return begin;
}

}  // namespace vegetation_sim::physics
