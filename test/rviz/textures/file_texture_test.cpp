// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/file_texture.h"

#include <gtest/gtest.h>

#include <QBuffer>
#include <QImage>

#include "core/error_text.h"
#include "rviz/canopy/plant_textures.h"
#include "rviz/textures/foliage_texture.h"

namespace vegetation_sim::view {
namespace {

std::string fileOf(const QImage& image, const char* format = "PNG") {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, format);
  return bytes.toStdString();
}

/// Returns a picture whose upper half is red and whose lower half is transparent.
QImage halfRed() {
  QImage out(8, 8, QImage::Format_ARGB32);
  out.fill(qRgba(0, 0, 255, 0));
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 8; ++column) out.setPixel(column, row, qRgba(255, 0, 0, 255));
  return out;
}

// S3-29: colours and alpha of a file survive.
TEST(FileTexture, HasTheColoursAndTheAlphaOfTheFile) {
  const Image picture = readPicture(fileOf(halfRed()), 32);
  EXPECT_EQ(picture.columns, 32);
  EXPECT_GT(picture.at(16, 4)[0], 0.99f);
  EXPECT_LT(picture.at(16, 4)[1], 0.01f);
  EXPECT_GT(picture.at(16, 4)[3], 0.99f);
  EXPECT_LT(picture.at(16, 28)[3], 0.01f);
  EXPECT_GT(
      readPicture(fileOf(halfRed().convertToFormat(QImage::Format_RGB32), "JPG"), 32).at(16, 28)[3],
      0.99f);
}

TEST(FileTexture, HostileFilesAreRefused) {
  const auto text = [](const std::string& bytes) {
    return errorOf([&] { readPicture(bytes, 32); });
  };
  EXPECT_EQ(text(""), "is no picture of a known format");
  EXPECT_EQ(text("root:x:0:0:root"), "is no picture of a known format");
  const std::string good = fileOf(halfRed());
  EXPECT_EQ(text(good.substr(0, good.size() - 20)), "is damaged");
  std::string huge = good;  // a header of 2^30 x 2^30 pixels
  huge[16] = huge[20] = '\x40';
  EXPECT_NE(text(huge), "");
  QImage wide(LARGEST_PICTURE + 1, 1, QImage::Format_RGB32);
  wide.fill(Qt::green);
  EXPECT_EQ(text(fileOf(wide)), "has 8193 x 1 pixels, allowed are 8192 x 8192");
}

canopy::Layout layoutOf(const std::vector<canopy::FaceMaterial>& materials) {
  canopy::Layout out;
  out.kinds.resize(1);
  auto form = std::make_shared<canopy::Form>();
  form->materials = materials;
  out.kinds[0].name = "fern";
  out.kinds[0].form = form;
  return out;
}

canopy::FaceMaterial materialOf(const std::string& texture, const std::string& bytes) {
  canopy::FaceMaterial out;
  out.texture = texture;
  out.picture = std::make_shared<const std::string>(bytes);
  return out;
}

// S3-29: textures lie in the atlas beside the painted leaves; those that cannot be read are named
// and replaced by the plain picture.
TEST(PlantTextures, AreInTheAtlasOrRefusedByName) {
  canopy::FaceMaterial missing;
  missing.texture = "no.png";
  missing.fault = "texture 'no.png' cannot be opened here";
  canopy::FaceMaterial brown;
  brown.colour = Vec3(0.4, 0.2, 0.1);
  const PlantTextures textures(layoutOf({materialOf("leaf.png", fileOf(halfRed())),
                                         materialOf("bad.png", "GIF89a"), missing, brown}));
  ASSERT_EQ(textures.faults().size(), 2u);
  EXPECT_EQ(textures.faults()[0], "kind fern: texture 'bad.png' is no picture of a known format");
  EXPECT_EQ(textures.faults()[1], "kind fern: texture 'no.png' cannot be opened here");
  EXPECT_EQ(textures.lookOf(0, 0).place, firstPicturePlace());
  EXPECT_GT(textures.lookOf(0, 0).mean.x(), 0.99);
  EXPECT_LT(textures.lookOf(0, 0).mean.z(), 0.01);
  EXPECT_EQ(textures.lookOf(0, 1).place, -1);
  EXPECT_EQ(textures.lookOf(0, 3).colour, brown.colour);
  const std::vector<Image> atlas = textures.atlas(64);
  const auto pixelAt = [&](int place, float u, float v) {
    const std::array<float, 2> at = foliagePlace(place, u, v);
    return atlas[0].at(static_cast<int>(at[0] * static_cast<float>(atlas[0].columns)),
                       static_cast<int>(at[1] * static_cast<float>(atlas[0].rows)));
  };
  EXPECT_GT(pixelAt(firstPicturePlace(), 0.5f, 0.2f)[0], 0.99f);
  EXPECT_GT(pixelAt(firstPicturePlace(), 0.5f, 0.2f)[3], 0.99f);
  EXPECT_LT(pixelAt(firstPicturePlace(), 0.5f, 0.8f)[3], 0.01f);
  EXPECT_LT(pixelAt(static_cast<int>(LeafCut::PLAIN), 0.5f, 0.5f)[0], 0.9f);
}

TEST(PlantTextures, HaveALimitedNumber) {
  std::vector<canopy::FaceMaterial> many;
  for (int i = 0; i <= MOST_PICTURES; ++i)
    many.push_back(materialOf("leaf" + std::to_string(i) + ".png", fileOf(halfRed())));
  const PlantTextures textures(layoutOf(many));
  ASSERT_EQ(textures.faults().size(), 1u);
  EXPECT_EQ(textures.faults()[0],
            "kind fern: texture 'leaf11.png' is one more than the 11 allowed");
}

}  // namespace
}  // namespace vegetation_sim::view
