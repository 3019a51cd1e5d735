#include <gtest/gtest.h>
#include <sys/resource.h>

#include <span>

#include "common/image/decode.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"

namespace ninefold {
namespace {

using Bytes = std::vector<unsigned char>;
constexpr ImageLimits kLimits{1000, 100000};

DecodedImage decode(const Bytes& file, ImageLimits limits = kLimits) {
  return decodeImage(std::as_bytes(std::span(file)), limits);
}

TEST(ImageDecode, KeepsChannelsAndRowsAndDoesNotPremultiply) {
  for (int channels = 1; channels <= 4; ++channels) {
    Bytes samples(static_cast<size_t>(3 * 2 * channels));
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<unsigned char>(10 * i + 3);
    const DecodedImage image = decode(png(3, 2, channels, samples));
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.channels, channels);
    EXPECT_EQ(image.texels, samples);
  }
}

TEST(ImageDecode, RoundsSixteenBitsToEight) {
  const DecodedImage image = decode(png(2, 1, 1, {0xFF, 0xFF, 0x80, 0x00}, 16));
  EXPECT_EQ(image.texels[0], 255);
  EXPECT_NEAR(image.texels[1], 128, 1);
}

TEST(ImageDecode, ReadsTga) {
  // 2 x 1, 24 bits, from the top: blue-green-red on disk.
  const DecodedImage image =
      decode({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0x20, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(image.texels, (Bytes{3, 2, 1, 6, 5, 4}));
}

TEST(ImageDecode, ReadsBmp) {
  Bytes bmp = {'B', 'M', 58, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40,
               0,   0,   0,  1, 0, 0, 0, 1, 0, 0, 0,  1, 0, 24};
  bmp.resize(58);
  bmp[54] = 1, bmp[55] = 2, bmp[56] = 3;
  EXPECT_EQ(decode(bmp).texels, (Bytes{3, 2, 1}));
  bmp[13] = 0xFF;  // its pixels begin before its first byte
  EXPECT_FALSE(errorOf([&] { decode(bmp); }).empty());
}

TEST(ImageDecode, HoldsBothLimits) {
  const Bytes file = png(20, 10, 1, Bytes(200, 1));
  EXPECT_EQ(decode(file, {20, 200}).texels.size(), 200u);
  EXPECT_EQ(errorOf([&] {
              decode(file, {19, 200});
            }),
            "20 x 10 pixels, more than 19 on a side: scale it down");
  EXPECT_EQ(errorOf([&] {
              decode(file, {20, 199, true});
            }),
            "20 x 10 pixels are more than the 199 that are left for all textures: scale it down");
}

// The BMP was found by fuzzing: OpenImageIO takes 2 GB when it opens it.
TEST(ImageDecode, HoldsLimitsBeforeMemoryIsTaken) {
  Bytes bmp = {'B', 'M', 58,   0,    0,    0,    0, 0, 0, 0, 54, 0, 0,  0, 40, 0,
               0,   0,   0x7A, 0x66, 0x69, 0x6C, 1, 0, 0, 0, 1,  0, 24, 0, 2};  // packed by runs
  bmp.resize(58);
  const Bytes jpeg = {0xFF, 0xD8, 0xFF, 0xFF, 0xFE, 0,    2,                    // a comment
                      0xFF, 0xC2, 0,    11,   8,    0xFF, 0xDC, 0xFF, 0xDC, 1,  // 65500 x 65500
                      1,    0x22, 0,                                            // grey
                      0xFF, 0xDA, 0,    8,    1,    1,    0,    0,    0,    0, 0xFF, 0xD9};
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(errorOf([&] { decode(bmp); }),
            "1818846842 x 1 pixels, more than 1000 on a side: scale it down");
  EXPECT_EQ(errorOf([&] { decode(jpeg); }),
            "65500 x 65500 pixels, more than 1000 on a side: scale it down");
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 * 1024) << "kilobytes";
}

// What stands before a JPEG's size must be what the library takes it for, too.
// Behind what libjpeg passes over: a marker without a segment, bytes that are no marker.
TEST(ImageDecode, FindsTheSizeOfAJpegOrRefuses) {
  const Bytes frame = {0xFF, 0xC2, 0, 11, 8, 0xFF, 0xDC, 0xFF, 0xDC, 1, 1, 0x22, 0, 0xFF, 0xD9};
  for (const Bytes& before :
       {Bytes{0xFF, 0x01}, Bytes{0xFF, 0xFE, 0, 2, 7, 0xFF, 0}, Bytes{0xFF, 0xFF}}) {
    Bytes file = {0xFF, 0xD8};
    file.insert(file.end(), before.begin(), before.end());
    file.insert(file.end(), frame.begin(), frame.end());
    EXPECT_CONTAINS(errorOf([&] { decode(file); }), "65500 x 65500 pixels, more than");
  }
  EXPECT_EQ(errorOf([&] {
              decode({0xFF, 0xD8, 0xFF, 0xFE, 0, 4, 1, 2, 0xFF, 0xD9});
            }),
            "damaged: the JPEG does not say its size");
}

TEST(ImageDecode, TruncatedFilesAreErrors) {
  const Bytes whole = png(8, 8, 3, Bytes(192, 7));
  for (size_t size = 0; size < whole.size(); size += 5)
    EXPECT_FALSE(errorOf([&] {
                   decode(Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)));
                 }).empty());
  Bytes flipped = whole;
  flipped[60] ^= 1;
  EXPECT_EQ(errorOf([&] { decode(flipped); }), "damaged: a checksum of the PNG is wrong");
  const Bytes jpegWithoutEnd = {0xFF, 0xD8, 0xFF, 0xDA, 0, 4, 1, 2, 3, 4};
  EXPECT_EQ(errorOf([&] { decode(jpegWithoutEnd); }), "truncated: the JPEG ends in the middle");
  const Bytes shortTga = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0x20, 1, 2};
  EXPECT_FALSE(errorOf([&] { decode(shortTga); }).empty());
}

}  // namespace
}  // namespace ninefold
