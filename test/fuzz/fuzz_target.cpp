// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"

#include <algorithm>
#include <cstring>

#include "fuzz/targets/target_lists.h"

namespace vegetation_sim::fuzz {

const std::vector<Target>& allTargets() {
  static const std::vector<Target> ALL = [] {
    std::vector<Target> out;
    for (const auto list :
         {forestMessageTargets, meadowMessageTargets, canopyMessageTargets, worldMessageTargets,
          shardMessageTargets, requestTargets, snapshotTargets, eventTargets, textTargets,
          pictureTargets, plantFileTargets}) {
      const std::vector<Target> targets = list();
      out.insert(out.end(), targets.begin(), targets.end());
    }
    return out;
  }();
  return ALL;
}

const Target& findTarget(const std::string& name) {
  std::string known;
  for (const Target& target : allTargets()) {
    if (target.name == name) return target;
    known += std::string(known.empty() ? "" : ", ") + target.name;
  }
  throw std::invalid_argument("target '" + name + "' is none of " + known);
}

std::vector<Piece> splitPieces(std::string_view input) {
  std::vector<Piece> out;
  while (input.size() > 3 && out.size() < MOST_PIECES) {
    Numbers head(input);
    const int kind = head.byte();
    const std::size_t length = std::min<std::size_t>(head.word(), input.size() - 3);
    out.push_back({kind, input.substr(3, length)});
    input.remove_prefix(3 + length);
  }
  return out;
}

std::string pieceOf(int kind, std::string_view bytes) {
  if (bytes.size() > 0xffff) throw std::invalid_argument("a piece is longer than 65535 bytes");
  std::string out{static_cast<char>(kind), static_cast<char>(bytes.size() & 0xff),
                  static_cast<char>(bytes.size() >> 8)};
  return out.append(bytes);
}

std::uint8_t Numbers::byte() {
  if (bytes_.empty()) return 0;
  const auto out = static_cast<std::uint8_t>(bytes_.front());
  bytes_.remove_prefix(1);
  return out;
}

double Numbers::real() {
  double out = 0.0;
  const std::size_t size = std::min(bytes_.size(), sizeof(out));
  std::memcpy(&out, bytes_.data(), size);
  bytes_.remove_prefix(size);
  return out;
}

}  // namespace vegetation_sim::fuzz
