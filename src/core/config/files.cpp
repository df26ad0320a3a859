// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/files.h"

#include <filesystem>
#include <fstream>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

std::string readFile(const std::string& file, std::uintmax_t largest) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(file, error);
  if (error) throw InvalidInput(file + ": cannot be read: " + error.message());
  if (!regular) throw InvalidInput(file + ": cannot be read: it is no regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InvalidInput(file + ": cannot be read: " + error.message());
  if (size > largest)
    throw InvalidInput(file + ": " + std::to_string(size) + " bytes, more than the " +
                       std::to_string(largest) + " allowed");
  std::string out(static_cast<std::size_t>(size), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(out.data(), static_cast<std::streamsize>(size));
  if (!in) throw InvalidInput(file + ": cannot be read");
  return out;
}

}  // namespace vegetation_sim
