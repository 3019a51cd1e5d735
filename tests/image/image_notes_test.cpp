// Files with notes of cameras and programs, whole and damaged: their texels are those without notes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/base/error.h"
#include "common/image/decode.h"
#include "tests/image/library_image.h"
#include "tests/scene/png_bytes.h"

namespace ninefold {
namespace {

using Bytes = std::vector<unsigned char>;

DecodedImage decode(const Bytes& file) {
  return decodeImage(std::as_bytes(std::span(file)), {100, 10'000});
}

std::string complaint(const Bytes& file) {
  try {
    decode(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Bytes photo(const std::string& format, const Notes& notes) {
  return libraryImage(format, 3, OIIO::TypeDesc::UINT8, notes);
}

size_t find(const Bytes& file, std::string_view text) {
  return static_cast<size_t>(std::search(file.begin(), file.end(), text.begin(), text.end()) -
                             file.begin());
}

TEST(ImageNotes, DoNotMatter) {
  for (const std::string format : {"jpg", "png"}) {
    const Bytes file = photo(format, photoNotes());
    EXPECT_GT(file.size(), photo(format, {}).size() + 100) << format;
    EXPECT_EQ(decode(file).texels, decode(photo(format, {})).texels) << format;
  }
}

TEST(ImageNotes, MayBeDamagedInAJpeg) {
  const Bytes whole = photo("jpg", photoNotes());
  const size_t notes = find(whole, "Exif"), end = find(whole, "Photoshop 3.0") + 40;
  ASSERT_LT(end, whole.size());
  const auto expected = decode(whole).texels;
  int taken = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    Bytes file = whole;
    for (int i = 0; i < 8; ++i) {
      unsigned char& byte = file[notes + random() % (end - notes)];
      if (byte != 0xFF && byte != 0xE1 && byte != 0xED) byte = static_cast<unsigned char>(random());
    }
    // What breaks the lengths of segments may be refused; what is taken is right.
    try {
      EXPECT_EQ(decode(file).texels, expected) << "seed " << seed;
      ++taken;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(taken, 100);
}

// Of any kind, before the picture, between its scans and behind them; as long as they say or not.
TEST(ImageNotes, OfAnyKindMayStandAnywhereInAJpeg) {
  const Bytes whole = photo("jpg", {});
  const auto expected = decode(whole).texels;
  for (const unsigned char kind : Bytes{0xE1, 0xE2, 0xED, 0xEF, 0xFE})
    for (const std::string_view text : {"", "Exif", "Photoshop 3.0", "ICC_PROFILE"}) {
      Bytes note = {0xFF, kind, 0, static_cast<unsigned char>(2 + text.size())};
      note.insert(note.end(), text.begin(), text.end());
      for (const size_t at : {size_t{2}, find(whole, "\xff\xda"), whole.size() - 2}) {
        Bytes file = whole;
        file.insert(file.begin() + static_cast<ptrdiff_t>(at), note.begin(), note.end());
        EXPECT_EQ(decode(file).texels, expected) << int{kind} << " " << text << " " << at;
      }
    }
}

TEST(ImageNotes, MayBeDamagedInAPng) {
  const Bytes whole = png(2, 1, 3, {1, 2, 3, 4, 5, 6});
  for (const std::string_view type : {"eXIf", "iCCP", "tEXt", "iTXt", "zTXt", "gAMA", "iDOT"}) {
    Bytes note;
    appendChunk(note, type, {'M', 'M', 0, 42, 0xFF, 0xFF, 0xFF, 0});
    for (const bool isWhole : {true, false}) {
      Bytes file = whole;
      if (!isWhole) note.back() ^= 1;  // its checksum
      file.insert(file.begin() + 8 + 25, note.begin(), note.end());
      EXPECT_EQ(decode(file).texels, (Bytes{1, 2, 3, 4, 5, 6})) << type;
    }
  }
}

TEST(ImageNotes, WhatIsSeenThroughIsNone) {
  Bytes file = pngHeader(1, 1, 3, 8);
  appendChunk(file, "tRNS", {0, 1, 0, 2, 0, 3});  // this colour
  const Bytes whole = png(1, 1, 3, {1, 2, 3});
  file.insert(file.end(), whole.begin() + 8 + 25, whole.end());
  EXPECT_EQ(decode(file).texels, (Bytes{1, 2, 3, 0}));
}

// A BMP of 2 x 2 indices packed by runs, with a table of two colours.
Bytes packedBmp(unsigned char bits, unsigned char packing, const Bytes& table, const Bytes& runs) {
  Bytes file = {'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 62, 0, 0,    0, 40,     0,
                0,   0,   2, 0, 0, 0, 2, 0, 0, 0, 1,  0, bits, 0, packing};
  file.resize(46);
  file.insert(file.end(), {2, 0, 0, 0, 0, 0, 0, 0});
  file.insert(file.end(), table.begin(), table.end());
  file.insert(file.end(), runs.begin(), runs.end());
  return file;
}

TEST(PackedBmp, HasTheColoursOfItsTable) {
  const Bytes runs = {2, 1, 0, 0, 1, 0, 1, 1, 0, 1};  // from below: 11, 01
  EXPECT_EQ(decode(packedBmp(8, 1, {9, 8, 7, 0, 3, 2, 1, 0}, runs)).texels,
            (Bytes{7, 8, 9, 1, 2, 3, 1, 2, 3, 1, 2, 3}));
  const Bytes shortRuns = {2, 0x11, 0, 0, 2, 0x01, 0, 1};
  EXPECT_EQ(decode(packedBmp(4, 2, {9, 8, 7, 0, 3, 2, 1, 0}, shortRuns)).texels,
            (Bytes{7, 8, 9, 1, 2, 3, 1, 2, 3, 1, 2, 3}));
}

// A library that takes them for pictures of one channel writes three values a pixel all the same.
TEST(PackedBmp, MayBeGrey) {
  const Bytes runs = {2, 1, 0, 0, 1, 0, 1, 1, 0, 1};
  EXPECT_EQ(decode(packedBmp(8, 1, {9, 9, 9, 0, 200, 200, 200, 0}, runs)).texels,
            (Bytes{9, 9, 9, 200, 200, 200, 200, 200, 200, 200, 200, 200}));
}

// Found by fuzzing: a library looks for their colours in a table that is not there.
TEST(PackedBmp, OfTrueColoursIsRefused) {
  EXPECT_EQ(complaint(packedBmp(24, 1, {}, {2, 1, 0, 1})),
            "damaged: a BMP of 24 bits a pixel is packed by runs of 8");
  EXPECT_EQ(complaint(packedBmp(8, 2, {9, 9, 9, 0, 1, 1, 1, 0}, {2, 1, 0, 1})),
            "damaged: a BMP of 8 bits a pixel is packed by runs of 4");
}

}  // namespace
}  // namespace ninefold
