// Whole tiles: what comes back, what is refused, what it costs.
#include "proto/tile_codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "proto/messages.h"
#include "proto/quantize.h"
#include "proto/tile_fields.h"
#include "proto/tile_names.h"
#include "tests/proto/random_tile.h"

namespace ninefold {
namespace {

constexpr uint8_t kAllLayers = kDiffuseBit | kReflectionBit | kTransmissionBit;

TileShape shapeOf(const TileResult& tile) {
  return {tile.width, tile.height, tile.layerMask, tile.extraMask};
}

Bytes encode(const TileResult& tile, uint64_t dither = 1, int level = 1) {
  return TileEncoder().encode(tile, dither, level).bytes;
}

Vec3 at(const RgbPlane& plane, size_t i) { return Vec3(plane.r[i], plane.g[i], plane.b[i]); }

void expectLight(const RgbPlane& sent, const RgbPlane& got) {
  for (size_t i = 0; i < sent.r.size(); ++i)
    ASSERT_LE(maxComponent(glm::abs(at(sent, i) - at(got, i))), maxComponent(at(sent, i)) / 127.5f);
}

void expectFractions(const RgbPlane& sent, const RgbPlane& got, float top) {
  for (size_t i = 0; i < sent.r.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float v = at(sent, i)[c];
      ASSERT_LE(std::abs(at(got, i)[c] - v),
                top * (2 * std::sqrt(v / top) + 1 / 255.0f) / 255 * 1.0001f);
    }
}

void expectNormals(const RgbPlane& sent, const RgbPlane& got) {
  for (size_t i = 0; i < sent.r.size(); ++i)
    ASSERT_LE(glm::length(at(sent, i) - at(got, i)), 6.5e-5f);
}

void expectLengths(const std::vector<float>& sent, const std::vector<float>& got) {
  // Five decades are 16.7 octaves.
  for (size_t i = 0; i < sent.size(); ++i) ASSERT_LE(std::abs(sent[i] - got[i]), sent[i] * 2.6e-4f);
}

TEST(TileCodec, RoundTripStaysWithinTheStatedBounds) {
  TileMaker make(1);
  for (const int level : {0, 1, 3, -5}) {
    const TileResult sent = make.make(32, 32, kAllLayers, kAllExtraPlanes);
    const TileResult got = decodeAll(encode(sent, 5, level), shapeOf(sent));
    for (size_t k = 0; k < kLayers; ++k) {
      const LayerPlanes &a = sent.layers[k], &b = got.layers[k];
      expectFractions(a.reflectance, b.reflectance, kInvPi);
      expectLight(a.irradiance, b.irradiance);
      expectLight(a.unfiltered, b.unfiltered);
      expectLengths(a.distance, b.distance);
      expectNormals(a.normal, b.normal);
      EXPECT_EQ(a.chain, b.chain);
    }
    expectFractions(sent.extras.albedo, got.extras.albedo, 1);
    expectNormals(sent.extras.normal, got.extras.normal);
    expectLengths(sent.extras.depth, got.extras.depth);
    expectLight(sent.extras.caustic, got.extras.caustic);
    expectLight(sent.extras.irradiance, got.extras.irradiance);
    EXPECT_EQ(sent.extras.object, got.extras.object);
  }
}

TEST(TileCodec, EveryShapeAndMaskComesBack) {
  TileMaker make(2);
  for (const auto& [w, h] :
       {std::pair(1, 1), std::pair(32, 1), std::pair(1, 32), std::pair(17, 5), std::pair(128, 128)})
    for (uint8_t layers = 1; layers < 8; layers = static_cast<uint8_t>(layers + 2))
      for (const uint8_t extras : {uint8_t{0}, uint8_t{1}, uint8_t{14}, kAllExtraPlanes}) {
        const TileResult sent = make.make(w, h, layers, extras);
        const Bytes bytes = encode(sent);
        EXPECT_LE(bytes.size(), kMaxTileBytes);
        const TileResult got = decodeAll(bytes, shapeOf(sent));
        EXPECT_EQ(got.width, w);
        EXPECT_EQ(got.layers[0].chain, sent.layers[0].chain);
        EXPECT_EQ(got.extras.object, sent.extras.object);
      }
}

TEST(TileCodec, AnEmptyTaskIsAHeadOnly) {
  TileResult empty;
  empty.reset(0, 0, kDiffuseBit, 0);
  const Bytes bytes = encode(empty);
  EXPECT_LE(bytes.size(), 32u);
  EXPECT_EQ(decodeAll(bytes, shapeOf(empty)).count(), 0);
}

TEST(TileCodec, TheSameDitherGivesTheSameBytesAndAnotherGivesOthers) {
  const TileResult tile = TileMaker(3).make(32, 32, kAllLayers, 0);
  TileEncoder used;
  used.encode(TileMaker(4).make(32, 16, kAllLayers, kAllExtraPlanes), 9, 1);
  EXPECT_EQ(used.encode(tile, 5, 1).bytes, encode(tile, 5)) << "an encoder's past must not show";
  EXPECT_NE(encode(tile, 6), encode(tile, 5));
}

TEST(TileCodec, DitherKeysStandStillWithTheRandomization) {
  const FrameKey key{10, 3, 4, 0.1f}, later{11, 3, 4, 0.2f}, next{11, 4, 4, 0.1f};
  EXPECT_EQ(ditherKey(1, key, 5, 6), ditherKey(1, later, 5, 6));
  EXPECT_NE(ditherKey(1, key, 5, 6), ditherKey(1, next, 5, 6));
  EXPECT_NE(ditherKey(1, key, 5, 6), ditherKey(2, key, 5, 6));
  EXPECT_NE(ditherKey(1, key, 5, 6), ditherKey(1, key, 6, 5));
}

TEST(TileCodec, TheMeanOverDithersIsTheValue) {
  // Errors in units of the pixel's brightest channel, pooled over pixels and channels of E in all
  // layers: 8 x 8 x 3 x 3 x 400 independent samples, a z-test at 1e-6. Single values are
  // quantize_test's work.
  const TileResult tile = TileMaker(5).make(8, 8, kAllLayers, 0);
  double sum = 0, squares = 0, count = 0;
  TileEncoder encoder;
  for (uint64_t run = 0; run < 400; ++run) {
    const TileResult got = decodeAll(encoder.encode(tile, mixBits(run), 0).bytes, shapeOf(tile));
    for (size_t k = 0; k < kLayers; ++k)
      for (size_t i = 0; i < 64; ++i) {
        const Vec3 value = at(tile.layers[k].irradiance, i);
        if (isBlack(value)) continue;
        const Vec3 error = (at(got.layers[k].irradiance, i) - value) / maxComponent(value);
        for (int c = 0; c < 3; ++c) sum += error[c], squares += error[c] * error[c], count += 1;
      }
  }
  EXPECT_LT(std::abs(sum), 4.9 * std::sqrt(squares));
  EXPECT_GT(std::sqrt(squares / count), 1e-3) << "it is a dither, not a copy";
}

TEST(TileCodec, UnusableValuesBecomeZeroAndAreCounted) {
  TileResult tile = TileMaker(6).make(4, 4, kDiffuseBit, kDepthPlane);
  LayerPlanes& planes = tile.layers[0];
  planes.irradiance.g[0] = NAN;
  planes.unfiltered.b[1] = INFINITY;
  planes.reflectance.r[2] = -0.5f;
  planes.distance[3] = -INFINITY;
  planes.normal.g[4] = NAN;
  tile.extras.depth[5] = NAN;
  planes.irradiance.r[6] = -0.0f, planes.irradiance.g[6] = -0.0f, planes.irradiance.b[6] = -0.0f;
  const auto encoded = TileEncoder().encode(tile, 1, 1);
  EXPECT_EQ(encoded.replaced.count, 6u);
  const TileResult got = decodeAll(encoded.bytes, shapeOf(tile));
  EXPECT_EQ(got.layers[0].irradiance.g[0], 0);
  EXPECT_EQ(got.layers[0].unfiltered.b[1], 0);
  EXPECT_EQ(got.layers[0].reflectance.r[2], 0);
  EXPECT_EQ(got.layers[0].distance[3], 0);
  EXPECT_EQ(at(got.layers[0].normal, 4), Vec3(0));
  EXPECT_EQ(got.extras.depth[5], 0);
  EXPECT_EQ(at(got.layers[0].irradiance, 6), Vec3(0));
}

// Puts a value that is not finite into one field of a tile; words can hold none.
struct Spoiler {
  int target, field = 0;
  bool spoilt = false;
  void spoil(std::vector<float>& values) {
    if (field++ == target) values[0] = NAN, spoilt = true;
  }
  void fraction(RgbPlane& values, float) { spoil(values.r); }
  void light(RgbPlane& values) { spoil(values.r); }
  void length(std::vector<float>& values) { spoil(values); }
  void normal(RgbPlane& values) { spoil(values.r); }
  template <typename Word>
  void words(std::vector<Word>&) {
    ++field;
  }
};

TEST(TileCodec, EveryFieldThatMayNotBeFiniteHasANameOfItsOwn) {
  std::set<std::string> names;
  size_t spoilt = 0;
  for (int target = 0; target < kLayers * kFieldsOfLayer + kExtraPlanes; ++target) {
    TileResult tile = TileMaker(15).make(4, 4, kAllLayers, kAllExtraPlanes);
    Spoiler spoiler{target};
    forEachField(spoiler, tile);
    if (!spoiler.spoilt) continue;
    ++spoilt;
    const Replaced replaced = TileEncoder().encode(tile, 1, 1).replaced;
    EXPECT_EQ(replaced.count, 1u) << target;
    names.insert(namesOfFields(replaced.fields));
  }
  EXPECT_EQ(spoilt, 3u * 5u + 5u);  // all but chains and objects
  EXPECT_EQ(names.size(), spoilt);
  EXPECT_FALSE(names.contains(""));
}

TEST(TileCodec, PlanesOfNothingCostNothing) {
  TileResult black;
  black.reset(32, 32, kAllLayers, kAllExtraPlanes);
  EXPECT_LT(encode(black, 1, 0).size(), 200u) << "about a byte for each of some eighty planes";
}

TEST(TileCodec, AnythingButTheTasksShapeIsRefused) {
  const TileResult tile = TileMaker(7).make(8, 4, kDiffuseBit, kDepthPlane);
  const Bytes bytes = encode(tile);
  EXPECT_NO_THROW(decodeAll(bytes, shapeOf(tile)));
  EXPECT_THROW(decodeAll(bytes, {4, 8, kDiffuseBit, kDepthPlane}), Error);
  EXPECT_THROW(decodeAll(bytes, {8, 4, kAllLayers, kDepthPlane}), Error);
  EXPECT_THROW(decodeAll(bytes, {8, 4, kDiffuseBit, 0}), Error);
  EXPECT_THROW(decodeAll(bytes, {0, 0, kDiffuseBit, kDepthPlane}), Error);
}

TEST(TileCodec, EveryTruncationIsRefused) {
  const TileResult tile = TileMaker(8).make(8, 4, kAllLayers, kAllExtraPlanes);
  for (const int level : {0, 1}) {
    Bytes bytes = encode(tile, 1, level);
    for (size_t size = 0; size < bytes.size(); ++size)
      ASSERT_THROW(decodeAll(ByteView(bytes).first(size), shapeOf(tile)), Error) << size;
    bytes.push_back(std::byte{0});
    EXPECT_THROW(decodeAll(bytes, shapeOf(tile)), Error) << "one byte too many";
  }
}

TEST(TileCodec, EveryFlippedBitGivesAnErrorOrFiniteValues) {
  const TileResult tile = TileMaker(9).make(5, 3, kAllLayers, kAllExtraPlanes);
  TileDecoder decoder;
  TileResult got;
  for (const int level : {0, 1}) {
    const Bytes good = encode(tile, 1, level);
    for (size_t bit = 0; bit < good.size() * 8; ++bit) {
      Bytes bad = good;
      bad[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
      try {
        got = decodeAll(decoder.unpack(std::move(bad), shapeOf(tile)), shapeOf(tile));
      } catch (const Error&) {
        continue;
      }
      for (const LayerPlanes& planes : got.layers)
        for (size_t i = 0; i < planes.distance.size(); ++i)
          ASSERT_TRUE(isFinite(at(planes.irradiance, i)) && isFinite(at(planes.unfiltered, i)) &&
                      isFinite(at(planes.normal, i)) && std::isfinite(planes.distance[i]) &&
                      planes.distance[i] >= 0);
    }
  }
}

TEST(TileCodec, TheLevelChangesNothingThatIsDecoded) {
  const TileResult tile = TileMaker(13).make(32, 32, kAllLayers, kAllExtraPlanes);
  const TileResult stored = decodeAll(encode(tile, 5, 0), shapeOf(tile));
  for (const int level : {1, 5, 19}) {
    const TileResult got = decodeAll(encode(tile, 5, level), shapeOf(tile));
    EXPECT_EQ(got.layers, stored.layers) << level;
    EXPECT_EQ(got.extras, stored.extras) << level;
  }
}

TEST(TileCodec, RadianceComesBackWithinTheBoundOfLight) {
  const TileResult random = TileMaker(14).make(96, 96, kDiffuseBit, 0);
  const RgbImage sent{96, 96, random.layers[kDiffuse].unfiltered};
  for (const int level : {0, 1}) {
    const Bytes bytes = TileEncoder().encode(sent, 3, level).bytes;
    EXPECT_LE(bytes.size(), 96u * 96 * 4 + 64);
    RgbImage got;
    TileDecoder().unpack(Bytes(bytes), {96, 96, 0, 0}).copyRadiance(got);
    EXPECT_EQ(got.width, 96);
    expectLight(sent.pixels, got.pixels);
    EXPECT_THROW(TileDecoder().unpack(Bytes(bytes), {96, 96, kDiffuseBit, 0}), Error);
  }
}

TEST(TileCodec, CodesComeBackAsTheToneMapMadeThem) {
  const TileResult random = TileMaker(15).make(96, 64, kDiffuseBit, 0);
  const RgbImage sent{96, 64, random.layers[kDiffuse].unfiltered};
  const ToneMap toneMap(-1.5f);
  DisplayImage expected;
  toneMap.apply(sent, expected);
  const size_t stride = 100;
  for (const int level : {0, 1, 5}) {
    const TileEncoder::Encoded encoded = TileEncoder().encode(sent, toneMap, level);
    EXPECT_EQ(encoded.replaced.count, 0u);
    EXPECT_LE(encoded.bytes.size(), 96u * 64 * 3 + 64);
    const UnpackedTile tile = TileDecoder().unpack(Bytes(encoded.bytes), {96, 64, kDisplayMask, 0});
    std::vector<uint8_t> got(3 * stride * 64, 77);
    tile.copyDisplay(stride, got.data());
    for (size_t y = 0; y < 64; ++y)
      for (size_t x = 0; x < 3 * stride; ++x)
        ASSERT_EQ(got[3 * stride * y + x], x < 3 * 96 ? expected.rgb[3 * 96 * y + x] : 77);
    EXPECT_THROW(TileDecoder().unpack(Bytes(encoded.bytes), {96, 64, kRadianceMask, 0}), Error);
    EXPECT_THROW(TileDecoder().unpack(Bytes(encoded.bytes), {96, 64, kDiffuseBit, 0}), Error);
  }
}

// Off from the radiance of the other form by at most its bound, largest channel / 127.5.
TEST(TileCodec, CodesAreThoseOfTheRadianceThatTheOtherFormSendsWithinItsBound) {
  const TileResult random = TileMaker(16).make(96, 96, kDiffuseBit, 0);
  const RgbImage sent{96, 96, random.layers[kDiffuse].unfiltered};
  const ToneMap toneMap;
  DisplayImage codes;
  codes.reshape(96, 96);
  TileDecoder()
      .unpack(TileEncoder().encode(sent, toneMap, 1).bytes, {96, 96, kDisplayMask, 0})
      .copyDisplay(96, codes.rgb.data());
  RgbImage radiance;
  TileDecoder()
      .unpack(TileEncoder().encode(sent, 3, 1).bytes, {96, 96, kRadianceMask, 0})
      .copyRadiance(radiance);
  int differing = 0;
  for (size_t i = 0; i < sent.count(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float value = radiance.rgb(i)[c], off = maxComponent(sent.rgb(i)) / 127.5f;
      const int code = codes.rgb[3 * i + static_cast<size_t>(c)];
      ASSERT_GE(code, toneMap.code(value - off));
      ASSERT_LE(code, toneMap.code(value + off));
      differing += code != toneMap.code(value) ? 1 : 0;
    }
  EXPECT_GT(differing, 0);
}

TEST(TileCodec, CodesOfWhatIsNoLightAreBlackAndCounted) {
  RgbImage sent;
  sent.reset(3, 1);
  sent.pixels.r = {NAN, 1, -1}, sent.pixels.g = {1, INFINITY, 1};
  const TileEncoder::Encoded encoded = TileEncoder().encode(sent, ToneMap(), 0);
  EXPECT_EQ(encoded.replaced.count, 3u);
  std::vector<uint8_t> got(9);
  TileDecoder().unpack(Bytes(encoded.bytes), {3, 1, kDisplayMask, 0}).copyDisplay(3, got.data());
  const uint8_t one = ToneMap().code(1);
  EXPECT_EQ(got, (std::vector<uint8_t>{0, one, 0, one, 0, 0, 0, one, 0}));
}

TEST(TileCodec, PartsAreThoseOfTheWhole) {
  const TileResult tile = TileMaker(12).make(13, 9, kAllLayers, kAllExtraPlanes);
  const TileShape shape = shapeOf(tile);
  for (const int level : {0, 1}) {
    const UnpackedTile unpacked = TileDecoder().unpack(encode(tile, 1, level), shape);
    const TileResult whole = decodeAll(unpacked, shape);
    TileResult part;
    part.reset(20, 20, kAllLayers, kAllExtraPlanes);
    unpacked.copy({3, 2, 20 * 5 + 4, 9, 6}, kTransmissionBit, kTransmissionBit, 20, part);
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        const bool inside = i >= 4 && i < 13 && j >= 5 && j < 11;
        const auto to = static_cast<size_t>(20 * j + i);
        const auto from = static_cast<size_t>(inside ? 13 * (j - 5 + 2) + i - 4 + 3 : 0);
        const auto expectPlane = [&](const auto& got, const auto& all) {
          ASSERT_EQ(got[to], inside ? all[from] : 0) << i << ", " << j;
        };
        const auto& got = part.layers[kTransmission];
        const auto& all = whole.layers[kTransmission];
        expectPlane(got.reflectance.g, all.reflectance.g);
        expectPlane(got.unfiltered.b, all.unfiltered.b);
        expectPlane(got.distance, all.distance);
        expectPlane(got.normal.r, all.normal.r);
        expectPlane(got.chain, all.chain);
        expectPlane(part.extras.object, whole.extras.object);
        ASSERT_EQ(part.layers[kDiffuse].unfiltered.r[to], 0) << "not asked for";
      }
  }
}

TEST(TileCodec, DeclaredSizesAreCappedBeforeMemoryIsTaken) {
  const TileResult tile = TileMaker(10).make(8, 4, kDiffuseBit, 0);
  Bytes bytes = encode(tile);
  for (size_t i = 8; i < 12; ++i) bytes[i] = std::byte{0xff};  // the size in the head
  EXPECT_THROW(decodeAll(bytes, shapeOf(tile)), Error);
}

}  // namespace
}  // namespace ninefold
