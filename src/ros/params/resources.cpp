// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/resources.h"

#include <ros/package.h>

#include <filesystem>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

std::string resolveFile(const std::string& name, const std::string& folder) {
  static const std::string SCHEME = "package://";
  if (name.empty()) return name;
  if (name.compare(0, SCHEME.size(), SCHEME) != 0)
    return (std::filesystem::path(folder) / name).lexically_normal().string();
  const std::size_t slash = name.find('/', SCHEME.size());
  const std::string package = name.substr(SCHEME.size(), slash - SCHEME.size());
  const std::string path = ros::package::getPath(package);
  if (path.empty()) throw InvalidInput(name + ": package '" + package + "' is not known here");
  return path + (slash == std::string::npos ? "" : name.substr(slash));
}

std::shared_ptr<const terrain::HeightMap> loadTerrain(const std::string& name) {
  return std::make_shared<const terrain::HeightMap>(terrain::HeightMap::load(resolveFile(name)));
}

}  // namespace vegetation_sim
