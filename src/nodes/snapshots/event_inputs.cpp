// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/event_inputs.h"

#include "wind/field_archive.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_NAMES = 256, LONGEST_NAME = 256;

}  // namespace

void archiveNames(Archive& a, NamedValues& named) {
  a.list("names", named.names, MOST_NAMES, sizeof(std::uint32_t),
         [&a](std::string& name) { a.text("name", name, LONGEST_NAME); });
  a.numbers("values", named.values, MOST_NAMES);
}

std::string windBytes(const HashedCache<wind::Field>& winds, std::uint64_t hash) {
  const wind::Field* found = winds.find(hash);
  if (!found) return {};
  wind::Field wind = *found;
  Archive a;
  wind::archive(a, wind);
  return a.takeBytes();
}

wind::Field windOfBytes(const std::string& bytes, Nanoseconds shift) {
  Archive a = Archive::reading(bytes, shift);
  wind::Field out;
  wind::archive(a, out);
  a.finish();
  return out;
}

}  // namespace vegetation_sim
