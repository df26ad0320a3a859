// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/files.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t MOST_NAMES = 30;

// Returns the names of the files of the same kind in the folder of a file, as a text for errors.
std::string namesBeside(const std::string& file) {
  std::error_code error;
  const fs::path path(file);
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), error))
    if (entry.path().extension() == path.extension())
      names.insert(entry.path().filename().string());
  if (names.empty() || names.size() > MOST_NAMES) return "";
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "; in its folder are " : ", ") + name;
  return out;
}

}  // namespace

std::string readFile(const std::string& file, std::uintmax_t largest) {
  std::error_code error;
  const bool regular = fs::is_regular_file(file, error);
  if (error) throw InvalidInput(file + ": cannot be read: " + error.message() + namesBeside(file));
  if (!regular) throw InvalidInput(file + ": cannot be read: it is no regular file");
  const std::uintmax_t size = fs::file_size(file, error);
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
