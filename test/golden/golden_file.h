// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "scenes/catalogue.h"

namespace vegetation_sim::golden {

/// A hash as the golden file has it, 16 hexadecimal digits.
std::string hexOf(std::uint64_t value);
/// A number as the golden file has it, with nine decimals.
std::string textOf(double number);

/// What the golden file says of a scene, as text.
struct Record {
  std::string number, state, reference, display;
};
Record recordOf(const scenes::Outcome& outcome);

/// Reads a golden file, scene by scene. @throws std::exception if it cannot be read.
std::map<std::string, Record> readGolden(const std::string& file);

/// Runs all scenes and writes a golden file. @throws std::exception if two instruction sets differ
/// or the file cannot be written.
void recordGolden(const std::string& file);

}  // namespace vegetation_sim::golden
