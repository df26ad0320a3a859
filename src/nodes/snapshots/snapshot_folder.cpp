// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/snapshot_folder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

namespace vegetation_sim {
namespace {

namespace fs = std::filesystem;

std::string folderOfRos() {
  if (const char* folder = std::getenv("ROS_HOME")) return folder;
  const char* home = std::getenv("HOME");
  return std::string(home ? home : "") + "/.ros";
}

// The name of a node as that of a file.
std::string stemOf(std::string node) {
  if (!node.empty() && node[0] == '/') node.erase(0, 1);
  std::replace(node.begin(), node.end(), '/', '.');
  checkPlainName("node", node);
  return node;
}

}  // namespace

void readSnapshotOptions(Parameters& parameters, SnapshotOptions& options) {
  options.folder = folderOfRos() + "/vegetation_sim";
  parameters.text("snapshot_folder", options.folder);
  if (options.folder.empty() || options.folder[0] != '/')
    parameters.fault("snapshot_folder",
                     "= '" + options.folder + "', allowed is a path that begins with '/'");
  parameters.number("checkpoint_period", options.checkpoint_period, "s", {0.0, 86400.0});
  parameters.flag("checkpoint", options.checkpoint);
}

SnapshotFolder::SnapshotFolder(std::string folder, std::string kind, const std::string& node)
    : folder_(std::move(folder)), kind_(std::move(kind)), node_(node) {}

std::string SnapshotFolder::pathOf(const std::string& name, const std::string& node,
                                   const char* ending) const {
  checkPlainName("name", name);
  return folder_ + "/" + name + "/" + stemOf(node) + ending;
}

std::string SnapshotFolder::fileOf(const std::string& name, const char* ending) const {
  return pathOf(name, node_, ending);
}

std::size_t SnapshotFolder::write(const std::string& name, const SnapshotFile& snapshot,
                                  bool durable) const {
  const std::string file = fileOf(name);
  std::error_code error;
  fs::create_directories(fs::path(file).parent_path(), error);
  if (error)
    throw InvalidInput(file + ": its folder cannot be made: " + error.message(),
                       FaultCode::FILE_REJECTED);
  const std::string bytes = encodeSnapshot(snapshot);
  replaceFile(file, bytes, durable);
  return bytes.size();
}

bool SnapshotFolder::has(const std::string& name) const {
  std::error_code error;
  return fs::exists(fileOf(name), error);
}

SnapshotFile SnapshotFolder::read(const std::string& name, const std::string& node) const {
  const std::string file = pathOf(name, node.empty() ? node_ : node, ".snapshot");
  const std::optional<std::string> bytes = contentOf(file, LARGEST_SNAPSHOT);
  if (!bytes) throw InvalidInput(file + ": there is no such file", FaultCode::UNKNOWN);
  return decodeSnapshot(file, *bytes, kind_);
}

std::optional<std::string> contentOf(const std::string& file, std::size_t most) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  if (!fs::is_regular_file(file, error))
    throw InvalidInput(file + ": it is no file", FaultCode::FILE_REJECTED);
  const std::uintmax_t size = fs::file_size(file, error);
  if (error)
    throw InvalidInput(file + ": cannot be read: " + error.message(), FaultCode::FILE_REJECTED);
  if (size > most)
    throw InvalidInput(file + ": size = " + std::to_string(size) + " bytes is outside 0 to " +
                           std::to_string(most),
                       FaultCode::FILE_REJECTED);
  std::string out(static_cast<std::size_t>(size), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  if (!in) throw InvalidInput(file + ": cannot be read", FaultCode::FILE_REJECTED);
  return out;
}

}  // namespace vegetation_sim
