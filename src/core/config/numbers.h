// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace vegetation_sim {

/// Returns the number that is the whole text, written with a decimal point whatever the locale of
/// the process; nothing for other text.
std::optional<double> parseNumber(const std::string& text);

}  // namespace vegetation_sim
