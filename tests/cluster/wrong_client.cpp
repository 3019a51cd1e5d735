// wrong-client: a client like any other, but that some of its results are a little wrong, as from a
// machine with a fault. For tests/cluster/verify_test.py. Options: those of ninefold-client, and in
// the environment
//
//   WRONG_PIXELS   one of so many pixels of a task, or one of fewer, gets 1 % more light; none: no
//                  pixel does
//   WRONG_TASKS    only in one of so many tasks; none: in each
//   WRONG_UNITS    one of so many units of steps has one amount too much; none: no unit has
#include <algorithm>

#include "client/identity.h"
#include "client/program.h"
#include "common/base/log.h"
#include "common/sampling/hash.h"
#include "proto/state_wire.h"
#include "proto/tile_codec.h"

namespace ninefold::client {
namespace {

std::optional<uint64_t> variable(const char* name) {
  const auto text = processVariable(name);
  return text ? std::optional<uint64_t>(std::stoull(*text)) : std::nullopt;
}

TileShape shapeOf(const Bytes& encoded) {
  ByteReader in(encoded, "tile");
  in.number<uint8_t>("version");
  TileShape shape;
  shape.layerMask = in.number<uint8_t>("layers");
  shape.extraMask = in.number<uint8_t>("extras");
  in.number<uint8_t>("storage");
  shape.width = in.number<uint16_t>("width"), shape.height = in.number<uint16_t>("height");
  return shape;
}

void brighten(LayerPlanes& planes, size_t pixel) {
  for (RgbPlane* light : {&planes.irradiance, &planes.unfiltered})
    for (auto* plane : {&light->r, &light->g, &light->b}) (*plane)[pixel] *= 1.01f;
}

bool isLit(const LayerPlanes& planes, size_t pixel) {
  const float light = planes.irradiance.g[pixel] + planes.unfiltered.g[pixel];
  return light > 0;
}

// One lit pixel of each `oneOf` in a row, so that each task with light is wrong.
void spoil(TileResult& tile, const msg::Result& result, uint64_t oneOf) {
  LayerPlanes& planes = tile.layers[kDiffuse];
  const auto count = static_cast<size_t>(tile.count());
  const uint64_t hash = hashWords(result.frame, result.tile, result.phase);
  for (size_t begin = 0; begin < count; begin += oneOf) {
    const size_t length = std::min<size_t>(oneOf, count - begin);
    for (size_t k = 0; k < length; ++k) {
      const size_t pixel = begin + (hash + k) % length;
      if (!isLit(planes, pixel)) continue;
      brighten(planes, pixel);
      break;
    }
  }
}

void spoilTask(msg::Result& result, uint64_t oneOf, uint64_t oneTaskOf) {
  // Another hash than the one that chooses what is verified.
  if (hashWords(result.tile, result.phase, result.frame) % oneTaskOf != 0) return;
  const TileShape shape = shapeOf(result.encoded);
  const UnpackedTile unpacked = TileDecoder().unpack(Bytes(result.encoded), shape);
  TileResult tile;
  tile.reset(shape.width, shape.height, shape.layerMask, shape.extraMask);
  unpacked.copy({0, 0, 0, shape.width, shape.height}, 7, 7, shape.width, tile);
  spoil(tile, result, oneOf);
  result.encoded = TileEncoder().encode(tile, 0, 1).bytes;
}

void spoilUnit(msg::Stepped& result, uint64_t oneOf) {
  if (hashWords(result.number, result.unit) % oneOf != 0) return;
  PageDeltas deltas = decodeDeltas(result.deltas);
  for (PageDelta& delta : deltas) {
    if (auto* sums = std::get_if<std::vector<SumChange>>(&delta.change); sums && !sums->empty())
      ++sums->front().amount;
    else if (auto* records = std::get_if<Records>(&delta.change); records && !records->empty())
      records->front() ^= std::byte{1};
  }
  result.deltas = encodeDeltas(deltas);
}

Rig wrongRig() {
  Rig rig;
  if (const auto oneOf = variable("WRONG_PIXELS"))
    rig.afterTask = [oneOf, oneTaskOf = variable("WRONG_TASKS").value_or(1)](msg::Result& result) {
      spoilTask(result, *oneOf, oneTaskOf);
    };
  if (const auto oneOf = variable("WRONG_UNITS"))
    rig.afterUnit = [oneOf](msg::Stepped& result) { spoilUnit(result, *oneOf); };
  return rig;
}

int run(const Options& options) {
  nameLog("client");
  const auto key = std::make_shared<const Key>(Key::load(*options.keyFile));
  EventLoop loop;
  return Program(loop, options, introduce(options), key, std::nullopt, wrongRig()).run();
}

}  // namespace
}  // namespace ninefold::client

int main(int argc, char** argv) {
  using namespace ninefold;
  return client::run(client::parseOptions(argc, argv, processVariable, 1));
}
