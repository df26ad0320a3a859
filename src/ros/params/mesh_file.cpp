// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>

#include "core/config/files.h"
#include "ros/params/child_process.h"
#include "ros/params/mesh_bytes.h"
#include "ros/params/mesh_scene.h"
#include "ros/params/resources.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_MESH_FILE = 512U << 20;    // [B]
constexpr std::size_t LARGEST_MATERIAL_FILE = 1U << 20;  // [B]
constexpr std::size_t MOST_MATERIAL_FILES = 64;          // that a mesh names; others are not read
constexpr std::size_t LONGEST_PATH = 4096;               // of a material file [characters]
constexpr const char* BYTE_ORDER_MARK = "\xEF\xBB\xBF";  // of UTF-8
constexpr std::array<const char*, 4> ENDINGS{"dae", "obj", "ply", "stl"};

// What reading may take.
constexpr double LEAST_SECONDS = 20.0, SECONDS_OF_BYTE = 5e-7;
constexpr std::size_t LEAST_MEMORY = 1U << 30, MEMORY_OF_BYTE = 16;  // [B]

/// @return the ending of a mesh file in small letters. @throws InvalidInput if it is another one.
std::string endingOf(const std::string& name) {
  const std::string own = std::filesystem::path(name).extension().string();
  std::string ending = own.empty() ? own : own.substr(1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (std::find(ENDINGS.begin(), ENDINGS.end(), ending) == ENDINGS.end())
    throw InvalidInput(name + ": no mesh: it ends in " + inQuotes(own) +
                       ", allowed are .dae, .obj, .ply and .stl");
  return ending;
}

/// @return where the line end_header of a PLY file begins, or npos.
std::size_t findEndOfHeader(const std::string& bytes) {
  const std::string line = "\nend_header";
  std::size_t found = bytes.find(line);
  while (found != std::string::npos) {
    const std::size_t after = found + line.size();
    if (after < bytes.size() && (bytes[after] == '\n' || bytes[after] == '\r')) return found + 1;
    found = bytes.find(line, after);
  }
  return found;
}

/// Rejects text at which assimp does not end.
void checkText(const std::string& name, const std::string& ending, const std::string& bytes) {
  const std::size_t header = findEndOfHeader(bytes);
  const bool is_text =
      ending == "obj" || ending == "dae" ||
      (ending == "ply" && bytes.rfind("format ascii", header) != std::string::npos);
  if (is_text && bytes.find('\0') != std::string::npos)
    throw InvalidInput(name + ": no mesh: a byte of a text file is zero");
  if (ending == "ply" && header == std::string::npos)
    throw InvalidInput(name + ": no mesh: the header has no line end_header");
}

/// Returns the text of a material file; nothing if it is not there, too large or no text.
std::string readMaterialFile(const std::string& file, const FindFile& find) {
  try {
    const std::string text = readFile(find(file), LARGEST_MATERIAL_FILE);
    return text.find('\0') == std::string::npos ? text : std::string();
  } catch (const InvalidInput&) {
    return {};
  }
}

/// Reads the material files in the folder of an OBJ file that its lines "mtllib FILE" name. This
/// process does so: it knows which files may be opened.
std::map<std::string, std::string> readMaterialFiles(const std::string& bytes,
                                                     const std::filesystem::path& folder,
                                                     const FindFile& find) {
  const std::string word = "mtllib", line_ends = "\r\n\f";
  std::map<std::string, std::string> out;
  std::size_t at = bytes.find(word);
  for (; at != std::string::npos && out.size() < MOST_MATERIAL_FILES;
       at = bytes.find(word, at + word.size())) {
    if (at > 0 && line_ends.find(bytes[at - 1]) == std::string::npos) continue;
    const std::size_t begin = bytes.find_first_not_of(" \t", at + word.size());
    const std::size_t end = std::min(bytes.find_first_of(line_ends, at), bytes.size());
    if (begin >= end || end - begin > LONGEST_PATH) continue;
    const std::filesystem::path named(bytes.substr(begin, end - begin));
    if (named.extension() != ".mtl") continue;
    const auto [entry, is_new] = out.try_emplace(named.filename().string());
    if (is_new) entry->second = readMaterialFile((folder / entry->first).string(), find);
  }
  return out;
}

}  // namespace

canopy::LeafMesh loadMesh(const std::string& name, MeshAxes axes, const std::string& rigid,
                          const FindFile& find) {
  MeshSource source;
  source.ending = endingOf(name);
  const std::filesystem::path file = resolveFile(name);
  source.bytes = readFile(file.string(), LARGEST_MESH_FILE);
  checkText(name, source.ending, source.bytes);
  if (source.ending == "obj" && source.bytes.compare(0, 3, BYTE_ORDER_MARK) == 0)
    source.bytes.erase(0, 3);
  if (find && source.ending == "obj")
    source.materials = readMaterialFiles(source.bytes, file.parent_path(), find);
  const std::size_t size = source.bytes.size();
  const ChildLimits limits{"the reader of meshes",
                           LEAST_SECONDS + SECONDS_OF_BYTE * static_cast<double>(size),
                           LEAST_MEMORY + MEMORY_OF_BYTE * size, MOST_MESH_BYTES};
  const auto read = [&] { return toBytes(readScene(source, axes, rigid)); };
  try {
    return meshOfBytes(runInChild(read, limits));
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what(), error.code());
  }
}

}  // namespace vegetation_sim
