// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/numbers.h"

#include <locale>
#include <sstream>

namespace vegetation_sim {

std::optional<double> parseNumber(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double out;
  if (in >> out && in.peek() == std::istringstream::traits_type::eof()) return out;
  return std::nullopt;
}

}  // namespace vegetation_sim
