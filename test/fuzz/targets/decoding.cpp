// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/decoding.h"

#include <cctype>
#include <cstdlib>

namespace vegetation_sim::fuzz {

std::uint64_t otherHashIn(const std::string& text, std::uint64_t sent) {
  constexpr std::uint64_t SMALLEST = std::uint64_t{1} << 32;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!std::isdigit(static_cast<unsigned char>(text[i]))) continue;
    char* end = nullptr;
    const std::uint64_t number = std::strtoull(text.c_str() + i, &end, 10);
    if (number > SMALLEST && number != sent) return number;
    i = static_cast<std::size_t>(end - text.c_str());
  }
  return 0;
}

}  // namespace vegetation_sim::fuzz
