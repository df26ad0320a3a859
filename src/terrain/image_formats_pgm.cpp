// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "terrain/image_formats.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::terrain {
namespace {

constexpr int LARGEST_SAMPLE = 65535;

/// Reads one file from its start to its end; every error names the file.
class PgmReader {
 public:
  PgmReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  GreyImage read() {
    const bool binary = bytes_[1] == '5';
    GreyImage out;
    out.columns = number("width", 1, LONGEST_SIDE);
    out.rows = number("height", 1, LONGEST_SIDE);
    out.white = static_cast<std::uint16_t>(number("largest sample", 1, LARGEST_SAMPLE));
    const std::size_t count = static_cast<std::size_t>(out.columns) * out.rows;
    const std::size_t sample_bytes = binary && out.white < 256 ? 1 : 2;
    if (binary) ++at_;  // the one blank after the header
    // A text sample takes a digit and a blank; the last one needs no blank.
    const std::size_t wanted = count * sample_bytes - (binary ? 0 : 1);
    if (at_ > bytes_.size() || bytes_.size() - at_ < wanted) fail("is cut short");
    out.samples.resize(count);
    for (auto& sample : out.samples) sample = binary ? rawSample(sample_bytes) : textSample();
    for (const auto sample : out.samples)
      if (sample > out.white)
        fail("has a sample of " + std::to_string(sample) + ", above its own largest of " +
             std::to_string(out.white));
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InvalidInput(name_ + ": PGM image " + problem);
  }

  bool atBlank() const {
    const char c = bytes_[at_];
    return c == ' ' || (c >= '\t' && c <= '\r');
  }

  void skipBlanks() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#')
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      else if (atBlank())
        ++at_;
      else
        return;
    }
  }

  int number(const char* what, int low, int high) {
    skipBlanks();
    const std::size_t start = at_;
    long value = 0;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_)
      value = value > high ? value : value * 10 + (bytes_[at_] - '0');
    if (at_ == start) fail(std::string("has no number for its ") + what);
    if (value < low || value > high)
      fail(std::string(what) + " = " +
           bytes_.substr(start, std::min<std::size_t>(at_ - start, 20)) + " is outside " +
           std::to_string(low) + " to " + std::to_string(high));
    return static_cast<int>(value);
  }

  std::uint16_t textSample() {
    return static_cast<std::uint16_t>(number("sample", 0, LARGEST_SAMPLE));
  }

  std::uint16_t rawSample(std::size_t sample_bytes) {
    unsigned value = 0;  // the most significant byte comes first
    for (std::size_t i = 0; i < sample_bytes; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
    return static_cast<std::uint16_t>(value);
  }

  const std::string& bytes_;
  const std::string& name_;
  std::size_t at_{2};
};

}  // namespace

bool looksLikePgm(const std::string& bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5');
}

GreyImage parsePgm(const std::string& bytes, const std::string& name) {
  return PgmReader(bytes, name).read();
}

}  // namespace vegetation_sim::terrain
