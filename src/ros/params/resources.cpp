// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/resources.h"

#include <ros/init.h>
#include <ros/package.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

const std::string PACKAGE = "package://", FILE_SCHEME = "file://";

bool startsWith(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

// Both are compared by their names: links in trusted folders are trusted.
bool isIn(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path whole = file.lexically_normal(), part = folder.lexically_normal();
  if (!part.is_absolute()) return false;
  const auto end = part.filename().empty() ? std::prev(part.end()) : part.end();
  return std::mismatch(part.begin(), end, whole.begin(), whole.end()).first == end;
}

std::vector<std::string> packageFolders() {
  std::istringstream lines(ros::package::command("list"));
  std::vector<std::string> out;
  for (std::string package, folder; lines >> package && std::getline(lines >> std::ws, folder);)
    out.push_back(folder);
  return out;
}

bool isInOneOf(const std::string& file, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return isIn(file, folder); });
}

}  // namespace

bool isPackageAddress(const std::string& name) {
  return startsWith(name, PACKAGE);
}

std::string resolveFile(const std::string& name, const std::string& folder) {
  if (name.empty()) return name;
  if (startsWith(name, FILE_SCHEME)) return name.substr(FILE_SCHEME.size());
  if (!isPackageAddress(name)) {
    if (name.find("://") != std::string::npos)
      throw InvalidInput(name + ": cannot be read: allowed are paths, file:// and package://");
    return std::filesystem::absolute(std::filesystem::path(folder) / name)
        .lexically_normal()
        .string();
  }
  const std::size_t slash = name.find('/', PACKAGE.size());
  const std::string package = name.substr(PACKAGE.size(), slash - PACKAGE.size());
  const std::string path = ros::package::getPath(package);
  if (path.empty())
    throw InvalidInput(name + ": package " + inQuotes(package) + " is not known here");
  return path + (slash == std::string::npos ? "" : name.substr(slash));
}

std::string findPublishedFile(const std::string& address, const std::vector<std::string>& folders) {
  std::string file;
  if (isPackageAddress(address)) {
    const std::string package = address.substr(0, address.find('/', PACKAGE.size()));
    file = resolveFile(address);
    if (isIn(file, resolveFile(package))) return file;
  } else if (std::filesystem::path(address).is_absolute()) {
    if (isInOneOf(address, folders) || isInOneOf(address, packageFolders())) return address;
  }
  throw InvalidInput("file " + inQuotes(address, LONGEST_ADDRESS) +
                     " is in no package and in no folder of the parameter resource_folders");
}

std::vector<std::string> resourceFolders() {
  std::vector<std::string> out;
  std::string name;
  if (!ros::isStarted() ||
      !ros::param::search(ros::this_node::getNamespace(), "resource_folders", name))
    return out;
  ros::param::get(name, out);
  return out;
}

std::shared_ptr<const terrain::HeightMap> loadPublishedTerrain(
    const std::string& address, const std::vector<std::string>& folders) {
  if (address.empty()) return loadTerrain(address);
  const std::string file = findPublishedFile(address, folders);
  try {
    return loadTerrain(file);
  } catch (const InvalidInput&) {  // its text may show what is in the file
    throw InvalidInput("terrain = " + inQuotes(address, LONGEST_ADDRESS) +
                       " is no height map here");
  }
}

std::shared_ptr<const terrain::HeightMap> loadTerrain(const std::string& name) {
  return std::make_shared<const terrain::HeightMap>(terrain::HeightMap::load(resolveFile(name)));
}

}  // namespace vegetation_sim
