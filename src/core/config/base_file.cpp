// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/base_file.h"

#include <filesystem>

namespace vegetation_sim {

void readBase(YamlSection& map, const std::string& folder,
              const std::function<void(YamlSection&)>& read) {
  std::string name;
  map.text("base", name);
  if (name.empty()) return;
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    return map.fault("base", "= " + inQuotes(name) +
                                 " has other letters than a to z, 0 to 9 "
                                 "and _");
  const std::string file =
      (std::filesystem::path(folder) / (name + ".yaml")).lexically_normal().string();
  try {
    Faults faults;
    YamlSection base(loadYamlFile(file), file, faults);
    read(base);
    base.finish();
    for (const std::string& fault : faults.list())
      map.fault("base", "= " + inQuotes(name) + ": " + fault);
  } catch (const InvalidInput& error) {
    map.fault("base", "= " + inQuotes(name) + ": " + error.what());
  }
}

}  // namespace vegetation_sim
