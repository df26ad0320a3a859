// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  constexpr unsigned char MASK = 0xc0, CONTINUES = 0x80;  // a byte within a letter of UTF-8
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & MASK) == CONTINUES) --end;
  return text.substr(0, end) + "...";
}

std::string inQuotes(const std::string& value, std::size_t most) {
  return "'" + shortened(value, most) + "'";
}

std::string Faults::text() const {
  std::string out;
  for (const auto& fault : list_) out += (out.empty() ? "" : "\n") + fault;
  return out;
}

void Faults::throwIfAny() const {
  if (!empty()) throw InvalidInput(text(), code_);
}

}  // namespace vegetation_sim
