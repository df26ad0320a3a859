// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/file_texture.h"

#include <QBuffer>
#include <QByteArray>
#include <QImageReader>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::view {

// The size is known from the header, before the pixels are read.
Image readPicture(const std::string& bytes, int edge) {
  QByteArray data = QByteArray::fromRawData(bytes.data(), static_cast<int>(bytes.size()));
  QBuffer buffer(&data);
  buffer.open(QIODevice::ReadOnly);
  QImageReader reader(&buffer);
  const QSize size = reader.size();
  if (!reader.canRead() || !size.isValid() || size.isEmpty())
    throw InvalidInput("is no picture of a known format");
  if (size.width() > LARGEST_PICTURE || size.height() > LARGEST_PICTURE)
    throw InvalidInput("has " + std::to_string(size.width()) + " x " +
                       std::to_string(size.height()) + " pixels, allowed are " +
                       std::to_string(LARGEST_PICTURE) + " x " + std::to_string(LARGEST_PICTURE));
  const QImage picture = reader.read();
  if (picture.isNull()) throw InvalidInput("is damaged");
  const QImage scaled = picture.convertToFormat(QImage::Format_RGBA8888)
                            .scaled(edge, edge, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                            .convertToFormat(QImage::Format_RGBA8888);
  Image out(edge, edge, {});
  for (int row = 0; row < edge; ++row) {
    const uchar* line = scaled.constScanLine(row);
    for (int column = 0; column < edge; ++column)
      for (std::size_t k = 0; k < 4; ++k)
        out.at(column, row)[k] =
            static_cast<float>(line[4 * static_cast<std::size_t>(column) + k]) / 255.f;
  }
  return out;
}

}  // namespace vegetation_sim::view
