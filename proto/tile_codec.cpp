#include "proto/tile_codec.h"

#include <zstd.h>

#include "common/base/prefetch.h"
#include "proto/messages.h"
#include "proto/tile_fields.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

constexpr uint8_t kVersion = 2;
enum Storage : uint8_t { kStored = 0, kZstd = 1 };
constexpr size_t kHeadBytes = 1 + 1 + 1 + 1 + 2 + 2 + 4;

bool isTileShape(int width, int height) {
  return (width == 0 && height == 0) ||
         (width > 0 && height > 0 && int64_t{width} * height <= kMaxTilePixels);
}

void writeHead(const TileShape& tile, Storage storage, size_t fieldBytes, Bytes& out) {
  ByteWriter writer(out);
  writer.number(kVersion);
  writer.number(tile.layerMask);
  writer.number(tile.extraMask);
  writer.number<uint8_t>(storage);
  writer.number(static_cast<uint16_t>(tile.width));
  writer.number(static_cast<uint16_t>(tile.height));
  writer.number(static_cast<uint32_t>(fieldBytes));
}

struct Head {
  uint8_t version, layerMask, extraMask, storage;
  uint16_t width, height;
  uint32_t fieldBytes;
};

Head readHead(ByteReader& in) {
  Head head{};
  head.version = in.number<uint8_t>("version");
  head.layerMask = in.number<uint8_t>("layer mask");
  head.extraMask = in.number<uint8_t>("extra mask");
  head.storage = in.number<uint8_t>("storage");
  head.width = in.number<uint16_t>("width");
  head.height = in.number<uint16_t>("height");
  head.fieldBytes = in.number<uint32_t>("size");
  return head;
}

void checkHead(const Head& head, const TileShape& expected) {
  if (head.version != kVersion) fail("tile: version {} is unknown", head.version);
  if (head.width != expected.width || head.height != expected.height)
    fail("tile: is {} x {} pixels, the task has {} x {}", head.width, head.height, expected.width,
         expected.height);
  if (head.layerMask != expected.layerMask || head.extraMask != expected.extraMask)
    fail("tile: has layers {:#x} and planes {:#x}, the task wants {:#x} and {:#x}", head.layerMask,
         head.extraMask, expected.layerMask, expected.extraMask);
  const auto pixels = static_cast<size_t>(expected.width) * static_cast<size_t>(expected.height);
  if (head.fieldBytes > mostFieldBytes(pixels, head.layerMask, head.extraMask))
    fail("tile: declares {} bytes, more than its planes can take", head.fieldBytes);
}

}  // namespace

uint64_t ditherKey(uint64_t seed, const FrameKey& frame, uint32_t tile, uint32_t phase) {
  const uint64_t moment =
      mixBits(seed ^ mixBits(uint64_t{frame.randomization} << 32 | frame.rotation));
  return mixBits(moment ^ mixBits(uint64_t{tile} << 32 | phase));
}

Replaced replaceUnusable(TileResult& tile) {
  FieldMender mender;
  forEachField(mender, tile);
  return {mender.replaced(), fieldBits(mender.replacedIn(), tile.layerMask, tile.extraMask)};
}

struct TileEncoder::Impl {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{ZSTD_createCCtx(), ZSTD_freeCCtx};
  BytePlanes scratch;
  Bytes fields;

  template <typename Write>
  Encoded encode(const TileShape& shape, uint64_t dither, int level, const Write& write);
};

template <typename Write>
TileEncoder::Encoded TileEncoder::Impl::encode(const TileShape& shape, uint64_t dither, int level,
                                               const Write& write) {
  NINEFOLD_CHECK(isTileShape(shape.width, shape.height));
  fields.clear();
  Encoded encoded;
  if (shape.width > 0) {
    FieldWriter writer(shape.width, static_cast<size_t>(shape.width * shape.height), dither,
                       level != 0, scratch, fields);
    write(writer);
    encoded.replaced = {writer.replaced(),
                        fieldBits(writer.replacedIn(), shape.layerMask, shape.extraMask)};
  }
  encoded.rawBytes = kHeadBytes + fields.size();
  Bytes& out = encoded.bytes;
  if (level != 0) {
    writeHead(shape, kZstd, fields.size(), out);
    out.resize(kHeadBytes + ZSTD_compressBound(fields.size()));
    const size_t size =
        ZSTD_compressCCtx(zstd.get(), out.data() + kHeadBytes, out.size() - kHeadBytes,
                          fields.data(), fields.size(), level);
    NINEFOLD_CHECK(ZSTD_isError(size) == 0);
    out.resize(kHeadBytes + size);
    if (size < fields.size()) return encoded;
    out.clear();
  }
  writeHead(shape, kStored, fields.size(), out);
  out.insert(out.end(), fields.begin(), fields.end());
  return encoded;
}

TileEncoder::TileEncoder() : impl_(std::make_unique<Impl>()) {}
TileEncoder::~TileEncoder() = default;

TileEncoder::Encoded TileEncoder::encode(const TileResult& tile, uint64_t dither, int level) {
  return impl_->encode({tile.width, tile.height, tile.layerMask, tile.extraMask}, dither, level,
                       [&](FieldWriter& writer) { forEachField(writer, tile); });
}

TileEncoder::Encoded TileEncoder::encode(const RgbImage& radiance, uint64_t dither, int level) {
  return impl_->encode({radiance.width, radiance.height, kRadianceMask, 0}, dither, level,
                       [&](FieldWriter& writer) { writer.light(radiance.pixels); });
}

TileEncoder::Encoded TileEncoder::encode(const RgbImage& radiance, const ToneMap& toneMap,
                                         int level) {
  return impl_->encode({radiance.width, radiance.height, kDisplayMask, 0}, 0, level,
                       [&](FieldWriter& writer) { writer.display(radiance.pixels, toneMap); });
}

struct TileDecoder::Impl {
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> zstd{ZSTD_createDCtx(), ZSTD_freeDCtx};

  // Makes `bytes` hold the fields as they were before zstd and gives back where they begin.
  size_t open(Bytes& bytes, uint8_t storage, size_t size) {
    const ByteView body = ByteView(bytes).subspan(kHeadBytes);
    if (storage == kStored) {
      if (body.size() != size) fail("tile: holds {} bytes, declares {}", body.size(), size);
      return kHeadBytes;
    }
    if (storage != kZstd) fail("tile: storage {} is unknown", storage);
    Bytes fields(size);
    const size_t got =
        ZSTD_decompressDCtx(zstd.get(), fields.data(), size, body.data(), body.size());
    if (ZSTD_isError(got) != 0 || got != size) fail("tile: compressed data is damaged");
    bytes = std::move(fields);
    return 0;
  }
};

TileDecoder::TileDecoder() : impl_(std::make_unique<Impl>()) {}
TileDecoder::~TileDecoder() = default;

UnpackedTile TileDecoder::unpack(Bytes&& bytes, const TileShape& expected) {
  NINEFOLD_CHECK(isTileShape(expected.width, expected.height));
  ByteReader in(bytes, "tile");
  const Head head = readHead(in);
  checkHead(head, expected);
  UnpackedTile tile;
  tile.width_ = expected.width, tile.height_ = expected.height;
  tile.layerMask_ = expected.layerMask;
  tile.bytes_ = std::move(bytes);
  const size_t begin = impl_->open(tile.bytes_, head.storage, head.fieldBytes);
  MutableReader fields(std::span(tile.bytes_).subspan(begin), "tile");
  const int pixels = expected.width * expected.height;
  if (pixels > 0) {
    TileResult shape;
    shape.layerMask = expected.layerMask, shape.extraMask = expected.extraMask;
    tile.fields_.reserve(3 * kFieldsOfLayer + 5);
    FieldOpener opener(expected.width, static_cast<size_t>(pixels), fields, tile.fields_,
                       tile.flat_);
    if (expected.layerMask == kRadianceMask)
      opener.light({});
    else if (expected.layerMask == kDisplayMask)
      opener.display();
    else
      forEachField(opener, shape);
  }
  fields.expectEnd();
  tile.findLight();
  return tile;
}

void UnpackedTile::findLight() {
  if (fields_.empty()) return;
  const FieldView* field = fields_.data();
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(layerMask_, layer)) continue;
    const auto bit = static_cast<uint8_t>(1u << layer);
    if (!field[2].isZero()) glowing_ |= bit;
    if (!field[0].isZero() || !field[1].isZero() || !field[2].isZero()) bright_ |= bit;
    field += kFieldsOfLayer;
  }
}

Sha256 UnpackedTile::digest() const {
  const auto pixels = static_cast<size_t>(width_ * height_);
  Bytes codes;
  codes.reserve(fields_.size() * (8 + 4 * pixels));
  ByteWriter writer(codes);
  for (const FieldView& field : fields_) {
    writer.number(field.least), writer.number(field.most);
    for (const PlaneView& plane : field.plane)
      if (plane.bytes != nullptr)
        writer.raw(plane.bytes, pixels);
      else
        codes.insert(codes.end(), pixels, static_cast<std::byte>(plane.value));
  }
  return sha256(codes);
}

void UnpackedTile::copy(const Part& part, uint8_t layers, uint8_t glowing, int stride,
                        TileResult& out) const {
  if (part.width <= 0 || part.height <= 0) return;
  FieldCopier copier(fields_.data(), {static_cast<size_t>(part.fromJ * width_ + part.fromI),
                                      static_cast<size_t>(width_), static_cast<size_t>(part.to),
                                      static_cast<size_t>(stride), part.width, part.height});
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(out.layerMask, layer)) continue;
    LayerPlanes& planes = out.layers[static_cast<size_t>(layer)];
    copier.leaveOut(hasLayer(glowing, layer) ? nullptr : &planes.unfiltered);
    if (hasLayer(layers, layer))
      forEachFieldOfLayer(copier, planes);
    else
      copier.skip(kFieldsOfLayer);
  }
  forEachExtraField(copier, out);
}

void UnpackedTile::prefetch() const {
  ninefold::prefetch<Soon::isRead>(bytes_.data(), bytes_.size());
}

void UnpackedTile::copyRadiance(RgbImage& out) const {
  out.width = width_, out.height = height_;
  for (auto* plane : {&out.pixels.r, &out.pixels.g, &out.pixels.b}) plane->resize(out.count());
  const auto width = static_cast<size_t>(width_);
  FieldCopier(fields_.data(), {0, width, 0, width, width_, height_}).light(out.pixels);
}

void UnpackedTile::copyDisplay(size_t stride, uint8_t* out) const {
  const auto width = static_cast<size_t>(width_);
  FieldCopier(fields_.data(), {0, width, 0, stride, width_, height_}).display(out);
}

}  // namespace ninefold
