#include <algorithm>
#include <cmath>
#include <utility>

#include "proto/edit_wire.h"
#include "proto/messages.h"
#include "proto/scene_blobs.h"
#include "proto/settings_wire.h"
#include "proto/state_wire.h"
#include "proto/text.h"
#include "proto/tile_codec.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

std::string text(const char* field, const std::string& in) {
  if (printable(in, kMaxText) != in)
    fail("{} is longer than {} bytes or not printable UTF-8", field, kMaxText);
  return in;
}

Sha256 hash(const std::string& in) {
  Sha256 out;
  if (in.size() != out.size()) fail("hash has {} bytes instead of {}", in.size(), out.size());
  std::copy(in.begin(), in.end(), out.begin());
  return out;
}

template <typename T>
T upTo(const char* field, uint64_t value, uint64_t high, uint64_t low = 0) {
  if (value < low || value > high) fail("{} is {}, must be {} to {}", field, value, low, high);
  return static_cast<T>(value);
}

template <typename T>
T parse(const std::string& header) {
  T out;
  if (!out.ParseFromString(header)) fail("header is not the protobuf message that it should be");
  return out;
}

BlobInfo blobInfo(const pb::BlobInfo& in, uint64_t mostBytes, BlobKind first, BlobKind last) {
  BlobInfo info;
  info.hash = hash(in.hash());
  info.rawBytes = upTo<uint64_t>("blob size", in.raw_bytes(), mostBytes, 1);
  info.kind = upTo<BlobKind>("blob kind", in.kind(), static_cast<uint64_t>(last),
                             static_cast<uint64_t>(first));
  return info;
}

Duration allowed(uint64_t nanoseconds) {
  constexpr auto longest = static_cast<uint64_t>(std::chrono::nanoseconds(kLongestAllowed).count());
  return std::chrono::nanoseconds(upTo<int64_t>("allowed time", nanoseconds, longest, 1));
}

// Of Result and Stepped.
template <typename Header>
RayCounts raysOf(const Header& in) {
  return {in.rays_eye(), in.rays_shadow(), in.rays_photon(), in.rays_compensation()};
}

msg::Hello decode(const pb::Hello& in, Bytes&&) {
  msg::Hello m;
  m.protocol = in.protocol();
  m.release = text("release", in.release());
  m.name = text("name", in.name());
  m.threads = upTo<uint32_t>("threads", in.threads(), 1024, 1);
  m.isa = text("isa", in.isa());
  m.probeClass = text("probe class", in.probe_class());
  m.visits = in.visits();
  return m;
}

msg::Welcome decode(const pb::Welcome& in, Bytes&&) {
  return {in.client_id(), text("release", in.release()), text("probe class", in.probe_class()),
          in.wall_clock_ms()};
}

msg::Refuse decode(const pb::Refuse& in, Bytes&&) { return {text("reason", in.reason())}; }

msg::SceneOffer decode(const pb::SceneOffer& in, Bytes&&) {
  msg::SceneOffer m;
  m.sceneVersion = in.scene_version();
  const auto count =
      upTo<size_t>("number of blobs", static_cast<uint64_t>(in.blobs_size()), kMaxBlobs);
  m.blobs.reserve(count);
  for (const pb::BlobInfo& blob : in.blobs())
    m.blobs.push_back(blobInfo(blob, kMaxBlobBytes, BlobKind::rest, BlobKind::environment));
  return m;
}

msg::BlobRequest decode(const pb::BlobRequest& in, Bytes&&) {
  return {hash(in.hash()), upTo<uint64_t>("offset", in.offset(), kMaxPackedBytes)};
}

msg::BlobChunk decode(const pb::BlobChunk& in, Bytes&& payload) {
  msg::BlobChunk m;
  m.hash = hash(in.hash());
  m.total = upTo<uint64_t>("total", in.total(), kMaxPackedBytes, 1);
  m.offset = upTo<uint64_t>("offset", in.offset(), m.total);
  upTo<size_t>("size", payload.size(), m.total - m.offset, 1);
  m.bytes = std::move(payload);
  return m;
}

msg::Configure decode(const pb::Configure& in, Bytes&&) {
  msg::Configure m{in.scene_version(), in.job_version(), fromWire(in.settings())};
  if (in.level() < Delivery::kAdaptive || in.level() > Delivery::kHighestLevel)
    fail("level {} is out of range", in.level());
  m.delivery.level = in.level();
  m.delivery.filter =
      upTo<SurfaceTest>("filter", in.filter(), static_cast<uint64_t>(SurfaceTest::surface));
  m.delivery.form =
      upTo<Delivery::Form>("form", in.form(), static_cast<uint64_t>(Delivery::Form::display));
  m.delivery.exposure = in.exposure();
  if (!(std::abs(in.exposure()) <= kMostExposure))
    fail("exposure {} is out of range", in.exposure());
  m.delivery.curve = upTo<ToneCurve>("tone curve", in.curve(), kToneCurveNames.size() - 1);
  if (m.delivery.wholeTiles() &&
      m.settings.interleave.sets() * kTaskSide * kTaskSide > kMaxTilePixels)
    fail("tiles are too large to be filtered by clients");
  return m;
}

msg::Ready decode(const pb::Ready& in, Bytes&&) { return {in.scene_version(), in.job_version()}; }

msg::Progress decode(const pb::Progress& in, Bytes&&) {
  return {upTo<Phase>("phase", in.phase(), static_cast<uint64_t>(Phase::building)),
          upTo<uint64_t>("done", in.done(), in.total()), in.total()};
}

msg::Tasks decode(const pb::Tasks& in, Bytes&&) {
  msg::Tasks m;
  m.jobVersion = in.job_version();
  m.frame = fromWire(in.frame());
  m.neighbourWeight = in.neighbour_weight();
  m.urgent = in.urgent();
  m.allowed = allowed(in.allowed_ns());
  if (!(m.neighbourWeight >= 0 && m.neighbourWeight <= 1)) fail("neighbour weight is out of range");
  const auto count =
      upTo<int>("number of tasks", static_cast<uint64_t>(in.tile_size()), kMaxTasksPerMessage, 1);
  if (in.phase_size() != count || in.extra_mask_size() != count)
    fail("tile, phase and extra mask differ in number");
  for (int i = 0; i < count; ++i)
    m.items.push_back({in.tile(i), upTo<uint32_t>("phase", in.phase(i), 255),
                       upTo<uint8_t>("extra mask", in.extra_mask(i), kAllExtraPlanes)});
  return m;
}

msg::Cancel decode(const pb::Cancel& in, Bytes&&) { return {in.job_version(), in.frame()}; }

msg::Result decode(const pb::Result& in, Bytes&& payload) {
  msg::Result m;
  m.jobVersion = in.job_version();
  m.frame = in.frame();
  m.tile = in.tile();
  m.phase = in.phase();
  m.busyNs = in.busy_ns();
  m.setsMade = upTo<uint32_t>("sets made", in.sets_made(), 256);
  m.replaced = in.replaced();
  m.replacedIn = upTo<uint32_t>("replaced in", in.replaced_in(), kAllTileFields);
  m.rays = raysOf(in);
  m.encoded = std::move(payload);
  return m;
}

msg::Ping decode(const pb::Ping& in, Bytes&&) { return {in.clock_ns()}; }
msg::Pong decode(const pb::Pong& in, Bytes&&) { return {in.echo_ns(), in.clock_ns()}; }
msg::Goodbye decode(const pb::Goodbye& in, Bytes&&) { return {text("reason", in.reason())}; }
msg::Edit decode(const pb::Edit& in, Bytes&& payload) {
  return {in.version(), fromWire(in, payload), in.moving(), in.more()};
}

msg::Steps decode(const pb::Steps& in, Bytes&&) {
  msg::Steps m;
  m.jobVersion = in.job_version();
  m.step = fromWire(in.step());
  m.allowed = allowed(in.allowed_ns());
  upTo<size_t>("number of units", static_cast<uint64_t>(in.unit_size()), kMaxTasksPerMessage, 1);
  for (const uint32_t unit : in.unit())
    m.units.push_back(upTo<uint32_t>("unit", unit, ~uint32_t{0}, m.step.firstUnit));
  return m;
}

msg::Stepped decode(const pb::Stepped& in, Bytes&& payload) {
  return {in.job_version(), in.number(), in.unit(),         in.busy_ns(),
          in.state_hash(),  raysOf(in),  std::move(payload)};
}

msg::CancelSteps decode(const pb::CancelSteps& in, Bytes&&) { return {in.number()}; }

msg::StateDelta decode(const pb::StateDelta& in, Bytes&& payload) {
  if (in.to() <= in.from())
    fail("leads from version {} to {}, must lead to a later one", in.from(), in.to());
  msg::StateDelta m;
  m.from = in.from();
  m.to = in.to();
  m.parts = upTo<uint32_t>("number of parts", in.parts(), kMaxDeltaParts, 1);
  m.part = upTo<uint32_t>("part", in.part(), m.parts - 1);
  m.hash = in.hash();
  m.oldest = in.oldest();
  m.deltas = std::move(payload);
  return m;
}

msg::StateOffer decode(const pb::StateOffer& in, Bytes&&) {
  msg::StateOffer m{in.version(), in.hash(), {}};
  m.pages.reserve(
      upTo<size_t>("number of pages", static_cast<uint64_t>(in.pages_size()), kMaxStatePages));
  for (const pb::StatePage& page : in.pages()) {
    const PageId id{upTo<uint16_t>("page kind", page.kind(), 65535), page.index()};
    if (!m.pages.empty() && id <= m.pages.back().page)
      fail("page {}.{} is out of order or there twice", id.kind, id.index);
    m.pages.push_back(
        {id, blobInfo(page.blob(), kMaxPageBlobBytes, BlobKind::page, BlobKind::page)});
  }
  return m;
}

template <typename Header>
Message decodeAs(Frame&& frame) {
  return decode(parse<Header>(frame.header), std::move(frame.payload));
}

using Decoder = Message (*)(Frame&&);
constexpr Decoder kDecoders[] = {  // in the order of MessageType
    decodeAs<pb::Hello>,       decodeAs<pb::Welcome>,     decodeAs<pb::Refuse>,
    decodeAs<pb::SceneOffer>,  decodeAs<pb::BlobRequest>, decodeAs<pb::BlobChunk>,
    decodeAs<pb::Configure>,   decodeAs<pb::Ready>,       decodeAs<pb::Progress>,
    decodeAs<pb::Tasks>,       decodeAs<pb::Cancel>,      decodeAs<pb::Result>,
    decodeAs<pb::Ping>,        decodeAs<pb::Pong>,        decodeAs<pb::Goodbye>,
    decodeAs<pb::Edit>,        decodeAs<pb::Steps>,       decodeAs<pb::Stepped>,
    decodeAs<pb::CancelSteps>, decodeAs<pb::StateDelta>,  decodeAs<pb::StateOffer>};
static_assert(std::size(kDecoders) == std::variant_size_v<Message>);

}  // namespace

Message decodeMessage(Frame&& frame, Peer sender) {
  const auto type = static_cast<MessageType>(frame.type);
  const char* name = nameOf(type);
  if (!maySend(sender, type))
    fail("peer sent a message of type {} ({}), which is not its to send", frame.type, name);
  const FrameLimit limit = messageLimit(frame.type);
  if (frame.header.size() > limit.header || frame.payload.size() > limit.payload)
    fail("peer sent a malformed {} message: it is too long", name);
  try {
    return kDecoders[frame.type - 1](std::move(frame));
  } catch (const Error& error) {
    fail("peer sent a malformed {} message: {}", name, error.what());
  }
}

}  // namespace ninefold
