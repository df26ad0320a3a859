// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "terrain/image_formats.h"
#include "vegetation_sim/core/config/faults.h"

// libpng's short interface would apply a gamma that the file names; a height map needs the samples
// unchanged, so this uses the long one. libpng reports errors by longjmp, which skips destructors:
// the functions that it may leave hold no objects that need one.

namespace vegetation_sim::terrain {
namespace {

constexpr png_byte HALF_ALPHA = 128;  // displays draw a pixel from here on

/// The data that libpng's callbacks use.
struct Source {
  const std::string& bytes;
  std::size_t at{0};
  char problem[128]{};
};

void readBytes(png_structp png, png_bytep to, std::size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->bytes.size() - source->at < count) png_error(png, "the file is cut short");
  std::memcpy(to, source->bytes.data() + source->at, count);
  source->at += count;
}

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->problem, message, sizeof source->problem - 1);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

/// The bytes of an image, row after row.
struct Raster {
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;

  Raster(std::size_t row_bytes, int count)
      : bytes(row_bytes * static_cast<std::size_t>(count)), rows(static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = bytes.data() + i * row_bytes;
  }
};

/// Owns libpng's two structures.
class PngFile {
 public:
  explicit PngFile(Source& source) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning);
    if (png_) info_ = png_create_info_struct(png_);
    if (png_) png_set_read_fn(png_, &source, readBytes);
  }
  ~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  bool readHeader() {
    if (!png_ || !info_ || setjmp(png_jmpbuf(png_))) return false;
    png_read_info(png_, info_);
    return true;
  }

  bool isGrey() const { return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY; }
  int columns() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int rows() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  int bits() const { return png_get_bit_depth(png_, info_); }

  bool hasAlpha() const {
    return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
           png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
  }

  /// Asks for samples of one byte, or of two if bits() is 16.
  void unpack() { png_set_packing(png_); }
  /// Asks for pixels of rowBytes() / columns() samples of one byte, the last of which is alpha.
  /// Requires hasAlpha().
  bool expand() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_expand(png_);
    png_set_strip_16(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }

  /// @param rows has one pointer per row, each to what unpack() or expand() asked for.
  bool readRows(png_bytep* rows) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  png_structp png_{nullptr};
  png_infop info_{nullptr};
};

}  // namespace

bool looksLikePng(const std::string& bytes) {
  return bytes.size() >= 8 &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) == 0;
}

GreyImage parsePng(const std::string& bytes, const std::string& name) {
  Source source{bytes};
  PngFile png(source);
  if (!png.readHeader()) throw InvalidInput(name + ": PNG image: " + source.problem);
  if (std::max(png.columns(), png.rows()) > LONGEST_SIDE)
    throw InvalidInput(name + ": PNG image of " + std::to_string(png.columns()) + " x " +
                       std::to_string(png.rows()) + " pixels, more than " +
                       std::to_string(LONGEST_SIDE) + " a side");
  if (!png.isGrey())
    throw InvalidInput(name +
                       ": PNG image is coloured or transparent; only grey images are supported");

  GreyImage out;
  out.columns = png.columns();
  out.rows = png.rows();
  out.white = static_cast<std::uint16_t>((1u << png.bits()) - 1);
  const std::size_t sample_bytes = png.bits() == 16 ? 2 : 1;
  const std::size_t row_bytes = static_cast<std::size_t>(out.columns) * sample_bytes;
  Raster raster(row_bytes, out.rows);
  png.unpack();
  if (!png.readRows(raster.rows.data()))
    throw InvalidInput(name + ": PNG image: " + source.problem);

  const std::vector<png_byte>& raw = raster.bytes;
  out.samples.resize(raw.size() / sample_bytes);
  for (std::size_t i = 0; i < out.samples.size(); ++i)
    out.samples[i] =
        sample_bytes == 1 ? raw[i] : static_cast<std::uint16_t>(raw[2 * i] << 8 | raw[2 * i + 1]);
  return out;
}

OpacityMask parsePngOpacity(const std::string& bytes) {
  Source source{bytes};
  PngFile png(source);
  if (!png.readHeader()) throw InvalidInput("is damaged");
  OpacityMask out;
  if (!png.hasAlpha()) return out;
  if (std::max(png.columns(), png.rows()) > LONGEST_MASK_SIDE)
    throw InvalidInput("has " + std::to_string(png.columns()) + " x " + std::to_string(png.rows()) +
                       " pixels, allowed are " + std::to_string(LONGEST_MASK_SIDE) + " x " +
                       std::to_string(LONGEST_MASK_SIDE));
  if (!png.expand()) throw InvalidInput("is damaged");
  Raster raster(png.rowBytes(), png.rows());
  if (!png.readRows(raster.rows.data())) throw InvalidInput("is damaged");

  out.columns = png.columns();
  out.rows = png.rows();
  const std::size_t samples = png.rowBytes() / static_cast<std::size_t>(out.columns);
  out.opaque.reserve(raster.bytes.size() / samples);
  for (std::size_t at = samples - 1; at < raster.bytes.size(); at += samples)
    out.opaque.push_back(raster.bytes[at] >= HALF_ALPHA);
  return out;
}

}  // namespace vegetation_sim::terrain
