// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/scratch_folder.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "terrain/png_fixture.h"
#include "vegetation_sim/grass/map/feature_map.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::fuzz {
namespace {

/// Pieces of a file with pictures: the YAML, and pictures a.png and b.pgm that it may name.
enum PieceKind { YAML_TEXT, PICTURE_A, PICTURE_B, KINDS };
const char* const NAMES[] = {"map.yaml", "a.png", "b.pgm"};

/// Writes the pieces of an input and returns the path of the YAML file.
std::string writePieces(std::string_view input) {
  const ScratchFolder& folder = ScratchFolder::instance();
  for (const char* name : NAMES) folder.remove(name);
  std::string file = folder.write(NAMES[0], "");
  for (const Piece& piece : splitPieces(input))
    folder.write(NAMES[piece.kind % KINDS], piece.bytes);
  return file;
}

void runPicture(std::string_view input) {
  try {
    const terrain::GreyImage image = terrain::parseGreyImage(std::string(input), "picture");
    if (image.samples.size() != static_cast<std::size_t>(image.columns) * image.rows)
      throw BrokenPromise("a picture has another number of samples than its size");
  } catch (const InvalidInput&) {
  }
}

void runTerrain(std::string_view input) {
  try {
    const terrain::HeightMap map = terrain::HeightMap::load(writePieces(input));
    for (const double at : {-1e9, -1.0, 0.0, 0.5, 3.0, 1e9}) {
      requireFinite(Vec3(0.0, 0.0, map.height(at, at)), "height of the ground");
      requireFinite(map.normal(at, at), "normal of the ground");
    }
  } catch (const InvalidInput&) {
  }
}

void runMeadow(std::string_view input) {
  try {
    const grass::FeatureMap map = grass::FeatureMap::load(writePieces(input));
    for (const double at : {-1e9, 0.0, 0.5, 3.0, 1e9}) {
      const grass::Features features = map.at(at, at);
      requireFinite(Vec3(features.height, features.density, features.colour), "feature of grass");
    }
  } catch (const InvalidInput&) {
  }
}

const std::string PGM("P5\n3 2\n255\n\x10\x80\xff\x20\x40\x60");
const std::string PLAIN_PGM = "P2\n# a comment\n2 2\n1000\n0 10 500 1000\n";

std::string png() {
  return terrain::grey8({16, 128, 255, 32, 64, 96}, 3);
}

std::vector<std::string> pictureSeeds() {
  return {PGM, PLAIN_PGM, png(), terrain::grey16({10, 20000, 30000, 65535}, 2)};
}

std::vector<std::string> terrainSeeds() {
  const std::string text =
      "image: a.png\nresolution: 0.5\norigin: [1, 2, 0]\nheight_min: -1\nheight_max: 3\n";
  std::string other = text;
  other.replace(other.find("a.png"), 5, "b.pgm");
  return {pieceOf(YAML_TEXT, text) + pieceOf(PICTURE_A, png()),
          pieceOf(YAML_TEXT, other) + pieceOf(PICTURE_B, PGM)};
}

std::vector<std::string> meadowSeeds() {
  const std::string text =
      "resolution: 1.0\norigin_x: 0\norigin_y: 0\nheight: {image: a.png, black: 0.1, white: 0.5}\n"
      "density: {image: b.pgm, black: 0, white: 300}\ncolour: {value: 0.2}\n";
  return {
      pieceOf(YAML_TEXT, text) + pieceOf(PICTURE_A, png()) + pieceOf(PICTURE_B, PGM),
      pieceOf(YAML_TEXT,
              "columns: 5\nrows: 4\nheight: {value: 0.3}\ndensity: {value: 100}\nspecies:\n"
              "  - {name: clover, mix: {value: 1.0}, width: 0.004, colour: [0.1, 0.2, 0.3]}\n")};
}

}  // namespace

std::vector<Target> pictureTargets() {
  return {{"picture", "a grey PNG or PGM", runPicture, pictureSeeds},
          {"terrain", "a height map: YAML and pictures", runTerrain, terrainSeeds},
          {"meadow", "a feature map: YAML and pictures", runMeadow, meadowSeeds}};
}

}  // namespace vegetation_sim::fuzz
