// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/terrain/grey_image.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "terrain/image_fixture.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::terrain {
namespace {

using Samples = std::vector<std::uint16_t>;

std::string refusal(const std::string& bytes) {
  return errorOf([&] { parseGreyImage(bytes, "hill.png"); });
}

/// Returns the bytes of a number as in PNG and 16-bit PGM: the most significant first.
std::string bigEndian(std::uint32_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i));
  return out;
}

TEST(GreyImage, EightBitPngKeepsItsSamplesWhateverGammaItNames) {
  const GreyImage image = parseGreyImage(grey8({0, 1, 100, 128, 254, 255}, 3), "hill.png");
  EXPECT_EQ(image.columns, 3);
  EXPECT_EQ(image.rows, 2);
  EXPECT_EQ(image.white, 255);
  EXPECT_EQ(image.samples, (Samples{0, 1, 100, 128, 254, 255}));
}

TEST(GreyImage, SixteenBitPngKeepsBothBytes) {
  const GreyImage image = parseGreyImage(grey16({0, 255, 256, 65535}, 2), "hill.png");
  EXPECT_EQ(image.white, 65535);
  EXPECT_EQ(image.samples, (Samples{0, 255, 256, 65535}));
}

TEST(GreyImage, PgmIsReadAsTextAndAsBytes) {
  const GreyImage text = parseGreyImage("P2\n# by hand\n3 2\n9\n0 1 2\n3 4 9", "hill.pgm");
  EXPECT_EQ(text.columns, 3);
  EXPECT_EQ(text.white, 9);
  EXPECT_EQ(text.samples, (Samples{0, 1, 2, 3, 4, 9}));
  EXPECT_EQ(parseGreyImage("P5 2 1 255\n\x01\xff", "hill.pgm").samples, (Samples{1, 255}));
  EXPECT_EQ(parseGreyImage("P5 2 1 65535\n" + bigEndian(258, 2) + bigEndian(65535, 2), "h").samples,
            (Samples{258, 65535}));
}

TEST(GreyImage, OtherFilesAreRejectedWithTheirName) {
  EXPECT_EQ(refusal(""), "hill.png: neither a PNG nor a PGM (P2 or P5) image");
  EXPECT_EQ(refusal("GIF89a"), "hill.png: neither a PNG nor a PGM (P2 or P5) image");
  EXPECT_EQ(refusal("P6 1 1 255\nabc"), "hill.png: neither a PNG nor a PGM (P2 or P5) image");
}

TEST(GreyImage, MissingFilesAndFoldersAreRejectedWithTheirName) {
  EXPECT_EQ(errorOf([] { loadGreyImage("nowhere/hill.png"); }),
            "nowhere/hill.png: cannot be read: No such file or directory");
  EXPECT_EQ(errorOf([] { loadGreyImage("/"); }), "/: cannot be read: it is no regular file");
}

TEST(GreyImage, PngCutShortIsRefusedAtEveryLength) {
  const std::string whole = grey8({10, 20, 30, 40, 50, 60}, 3);
  for (std::size_t length = 8; length < whole.size(); ++length)
    EXPECT_EQ(refusal(whole.substr(0, length)), "hill.png: PNG image: the file is cut short")
        << length;
}

TEST(GreyImage, PngOfHugeSizeIsRefusedBeforeMemoryIsTaken) {
  std::string bytes = grey8({10, 20, 30, 40}, 2);
  bytes.replace(16, 8, bigEndian(70000, 4) + bigEndian(70000, 4));
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + 12), 17);
  bytes.replace(29, 4, bigEndian(static_cast<std::uint32_t>(crc), 4));
  EXPECT_EQ(refusal(bytes), "hill.png: PNG image of 70000 x 70000 pixels, more than 8192 a side");
}

TEST(GreyImage, ColouredAndTransparentPngAreRefused) {
  const std::string wanted =
      "hill.png: PNG image is coloured or transparent; only grey images are supported";
  EXPECT_EQ(refusal(pngOf(std::vector<std::uint8_t>{1, 2, 3}, 1, PNG_FORMAT_RGB)), wanted);
  EXPECT_EQ(refusal(pngOf(std::vector<std::uint8_t>{1, 2}, 1, PNG_FORMAT_GA)), wanted);
}

TEST(GreyImage, FaultyPgmIsRefusedWithWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"P5 0 2 255\n", "width = 0 is outside 1 to 8192"},
      {"P5 2 8193 255\n", "height = 8193 is outside 1 to 8192"},
      {"P5 99999999999999999999 2 255\n", "width = 99999999999999999999 is outside 1 to 8192"},
      {"P5 2 2 65536\n", "largest sample = 65536 is outside 1 to 65535"},
      {"P5 2 2", "has no number for its largest sample"},
      {"P5 two 2 255\n", "has no number for its width"},
      {"P5 -2 2 255\n", "has no number for its width"},
      {"P5 2 2 255\nabc", "is cut short"},
      {"P5 8192 8192 65535\nabc", "is cut short"},
      {"P2 2 2 255\n1 2 3", "is cut short"},
      {"P2 2 2 255\n1 2 3    ", "has no number for its sample"},
      {"P2 1 1 9\n10", "has a sample of 10, above its own largest of 9"},
  };
  for (const auto& [bytes, problem] : cases)
    EXPECT_EQ(refusal(bytes), "hill.png: PGM image " + problem);
}

/// Flips, drops, doubles or overwrites a few bytes.
std::string mutate(std::string bytes, const Random& random) {
  const auto changes = 1 + random.bits(0) % 4;
  for (std::uint64_t i = 0; i < changes && !bytes.empty(); ++i) {
    const auto at = static_cast<std::size_t>(random.bits(4 * i + 1) % bytes.size());
    const auto value = static_cast<char>(random.bits(4 * i + 2));
    switch (random.bits(4 * i + 3) % 4) {
      case 0:
        bytes[at] = value;
        break;
      case 1:
        bytes.erase(at, 1 + static_cast<unsigned char>(value) % 8);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 1 + static_cast<unsigned char>(value) % 8));
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

/// Corrects the checksum of each PNG chunk, so that a changed chunk is not rejected for it alone.
std::string withChecksums(std::string bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    std::uint32_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    if (length > bytes.size() - at - 12) break;
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const auto crc = static_cast<std::uint32_t>(crc32(0, data, length + 4));
    bytes.replace(at + 8 + length, 4, bigEndian(crc, 4));
    at += 12 + length;
  }
  return bytes;
}

TEST(GreyImage, MutatedFilesAreReadOrRefusedButNeverHarm) {
  const std::vector<std::string> seeds = {
      grey8({0, 50, 100, 150, 200, 250}, 3), grey16({0, 5000, 10000, 15000, 20000, 65535}, 2),
      "P2\n# text\n3 2\n9\n0 1 2\n3 4 9\n", "P5 2 2 65535\n" + bigEndian(0x01020304, 4) + "abcd"};
  int refused = 0;
  constexpr int CASES = 2000;
  for (int i = 0; i < CASES; ++i) {
    const std::string bytes =
        mutate(seeds[static_cast<std::size_t>(i) % seeds.size()], Random(7).child(i));
    const std::string file = i % 8 < 4 ? withChecksums(bytes) : bytes;
    try {
      const GreyImage image = parseGreyImage(file, "mutant");
      ASSERT_EQ(image.samples.size(), static_cast<std::size_t>(image.columns) * image.rows);
      for (const auto sample : image.samples) ASSERT_LE(sample, image.white);
    } catch (const InvalidInput& error) {
      ASSERT_EQ(std::string(error.what()).rfind("mutant: ", 0), 0u) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, CASES / 4);
  EXPECT_LT(refused, CASES);
}

}  // namespace
}  // namespace vegetation_sim::terrain
