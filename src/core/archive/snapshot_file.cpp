// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/snapshot_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/archive/archive.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
namespace {

const std::string MAGIC = "vegetation_sim snapshot\n";
constexpr std::size_t LONGEST_NODE = 64;

std::uint64_t checksumOf(const std::string& bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

void archive(Archive& a, SnapshotHeader& header) {
  a.text("node", header.node, LONGEST_NODE);
  a.key(header.layout_hash);
  a.stamp("stamp", header.stamp);
  a.key(header.state_hash);
}

// Version first, so that other versions may have other headers.
void checkVersion(const std::string& bytes) {
  if (bytes.compare(0, MAGIC.size(), MAGIC) != 0)
    throw InvalidInput("it is no snapshot of vegetation_sim");
  Archive a = Archive::reading(bytes.substr(MAGIC.size(), sizeof(std::uint32_t)));
  std::uint32_t version = 0;
  a.integer("version", version);
  if (version != SNAPSHOT_VERSION)
    throw InvalidInput("version = " + std::to_string(version) + " of the format, allowed is " +
                       std::to_string(SNAPSHOT_VERSION));
}

SnapshotFile decode(const std::string& bytes, const std::string& node) {
  checkVersion(bytes);
  constexpr std::size_t SUM = sizeof(std::uint64_t);
  const std::size_t start = MAGIC.size() + sizeof(std::uint32_t);
  if (bytes.size() < start + SUM) throw InvalidInput("it is truncated");
  Archive end = Archive::reading(bytes.substr(bytes.size() - SUM));
  std::uint64_t checksum = 0;
  end.key(checksum);
  if (checksum != checksumOf(bytes.substr(0, bytes.size() - SUM)))
    throw InvalidInput("its checksum does not match: it is truncated or altered");
  Archive a = Archive::reading(bytes.substr(start, bytes.size() - start - SUM));
  SnapshotFile out;
  archive(a, out.header);
  if (out.header.node != node)
    throw InvalidInput("node = " + inQuotes(out.header.node) + ", allowed is " + inQuotes(node));
  a.text("payload", out.payload, LARGEST_SNAPSHOT);
  a.finish();
  return out;
}

/// Closes a file at the end of its scope.
struct OpenFile {
  int number;
  explicit OpenFile(int opened) : number(opened) {}
  ~OpenFile() {
    if (number >= 0) ::close(number);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

[[noreturn]] void failToWrite(const std::string& file) {
  throw InvalidInput(file + ": cannot be written: " + std::strerror(errno),
                     FaultCode::FILE_REJECTED);
}

void writeAll(const std::string& file, const std::string& bytes, bool durable) {
  const OpenFile out(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (out.number < 0) failToWrite(file);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(out.number, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno != EINTR) failToWrite(file);
    at += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  if (durable && ::fsync(out.number) != 0) failToWrite(file);
}

}  // namespace

std::string encodeSnapshot(const SnapshotFile& snapshot) {
  SnapshotHeader header = snapshot.header;
  Archive a;
  std::uint32_t version = SNAPSHOT_VERSION;
  a.integer("version", version);
  archive(a, header);
  a.length("payload", snapshot.payload.size(), LARGEST_SNAPSHOT, 1);
  std::string out;
  std::uint64_t checksum = 0;
  out.reserve(MAGIC.size() + a.bytes().size() + snapshot.payload.size() + sizeof checksum);
  out.append(MAGIC).append(a.bytes()).append(snapshot.payload);
  checksum = checksumOf(out);
  Archive end;
  end.key(checksum);
  return out.append(end.bytes());
}

SnapshotFile decodeSnapshot(const std::string& name, const std::string& bytes,
                            const std::string& node) {
  try {
    return decode(bytes, node);
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what(), FaultCode::FILE_REJECTED);
  }
}

void replaceFile(const std::string& file, const std::string& bytes, bool durable) {
  const std::string temporary = file + ".part";
  writeAll(temporary, bytes, durable);
  if (std::rename(temporary.c_str(), file.c_str()) != 0) failToWrite(file);
  if (!durable) return;
  const std::string folder = std::filesystem::path(file).parent_path().string();
  const OpenFile entry(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
  if (entry.number < 0 || ::fsync(entry.number) != 0) failToWrite(file);
}

void checkPlainName(const char* what, const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  const bool plain = !name.empty() && name.size() <= 64 && name[0] != '.' &&
                     std::all_of(name.begin(), name.end(), allowed);
  if (!plain)
    throw InvalidInput(std::string(what) + " = " + inQuotes(name) +
                       ", allowed are 1 to 64 letters, digits, '_', '-' and '.', not at the "
                       "beginning a '.'");
}

}  // namespace vegetation_sim
