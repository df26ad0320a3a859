// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/scratch_folder.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace vegetation_sim::fuzz {

ScratchFolder& ScratchFolder::instance() {
  static ScratchFolder folder;
  return folder;
}

ScratchFolder::ScratchFolder()
    : folder_(std::filesystem::temp_directory_path().string() + "/vegetation_sim_fuzz_" +
              std::to_string(::getpid())) {
  std::filesystem::create_directories(folder_);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string ScratchFolder::write(const std::string& name, std::string_view bytes) const {
  const std::string file = folder_ + "/" + name;
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  return file;
}

void ScratchFolder::remove(const std::string& name) const {
  std::error_code ignored;
  std::filesystem::remove(folder_ + "/" + name, ignored);
}

}  // namespace vegetation_sim::fuzz
