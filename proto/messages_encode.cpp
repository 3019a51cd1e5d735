#include <utility>

#include "proto/edit_wire.h"
#include "proto/messages.h"
#include "proto/settings_wire.h"
#include "proto/text.h"

namespace ninefold {
namespace {

void putHash(const Sha256& hash, std::string& out) {
  out.assign(reinterpret_cast<const char*>(hash.data()), hash.size());
}

void put(const BlobInfo& info, pb::BlobInfo& out) {
  putHash(info.hash, *out.mutable_hash());
  out.set_raw_bytes(info.rawBytes);
  out.set_kind(static_cast<uint32_t>(info.kind));
}

// Of Result and Stepped.
template <typename Header>
void put(const RayCounts& rays, Header& out) {
  out.set_rays_eye(rays.eye);
  out.set_rays_shadow(rays.shadow);
  out.set_rays_photon(rays.photon);
  out.set_rays_compensation(rays.compensation);
}

uint64_t nanoseconds(Duration time) {
  return static_cast<uint64_t>(std::chrono::nanoseconds(time).count());
}

pb::Hello header(const msg::Hello& m) {
  pb::Hello out;
  out.set_protocol(m.protocol);
  out.set_release(printable(m.release, kMaxText));
  out.set_name(printable(m.name, kMaxText));
  out.set_threads(m.threads);
  out.set_isa(printable(m.isa, kMaxText));
  out.set_probe_class(printable(m.probeClass, kMaxText));
  out.set_visits(m.visits);
  return out;
}

pb::Welcome header(const msg::Welcome& m) {
  pb::Welcome out;
  out.set_client_id(m.clientId);
  out.set_release(printable(m.release, kMaxText));
  out.set_probe_class(printable(m.probeClass, kMaxText));
  out.set_wall_clock_ms(m.wallClockMs);
  return out;
}

pb::Refuse header(const msg::Refuse& m) {
  pb::Refuse out;
  out.set_reason(printable(m.reason, kMaxText));
  return out;
}

pb::SceneOffer header(const msg::SceneOffer& m) {
  NINEFOLD_CHECK(m.blobs.size() <= kMaxBlobs);
  pb::SceneOffer out;
  out.set_scene_version(m.sceneVersion);
  for (const BlobInfo& info : m.blobs) put(info, *out.add_blobs());
  return out;
}

pb::BlobRequest header(const msg::BlobRequest& m) {
  pb::BlobRequest out;
  putHash(m.hash, *out.mutable_hash());
  out.set_offset(m.offset);
  return out;
}

pb::BlobChunk header(const msg::BlobChunk& m) {
  NINEFOLD_CHECK(m.bytes.size() <= kBlobChunkBytes);
  pb::BlobChunk out;
  putHash(m.hash, *out.mutable_hash());
  out.set_offset(m.offset);
  out.set_total(m.total);
  return out;
}

pb::Configure header(const msg::Configure& m) {
  pb::Configure out;
  out.set_scene_version(m.sceneVersion);
  out.set_job_version(m.jobVersion);
  toWire(m.settings, *out.mutable_settings());
  out.set_level(m.delivery.level);
  out.set_filter(static_cast<uint32_t>(m.delivery.filter));
  out.set_form(static_cast<uint32_t>(m.delivery.form));
  out.set_exposure(m.delivery.exposure);
  out.set_curve(static_cast<uint32_t>(m.delivery.curve));
  return out;
}

pb::Ready header(const msg::Ready& m) {
  pb::Ready out;
  out.set_scene_version(m.sceneVersion);
  out.set_job_version(m.jobVersion);
  return out;
}

pb::Progress header(const msg::Progress& m) {
  pb::Progress out;
  out.set_phase(static_cast<uint32_t>(m.phase));
  out.set_done(m.done);
  out.set_total(m.total);
  return out;
}

pb::Tasks header(const msg::Tasks& m) {
  NINEFOLD_CHECK(!m.items.empty());
  NINEFOLD_CHECK(m.items.size() <= kMaxTasksPerMessage);
  NINEFOLD_CHECK(m.frame.lightCameras.size() <= kMostLightCameras);
  pb::Tasks out;
  out.set_job_version(m.jobVersion);
  toWire(m.frame, *out.mutable_frame());
  out.set_neighbour_weight(m.neighbourWeight);
  out.set_urgent(m.urgent);
  out.set_allowed_ns(nanoseconds(m.allowed));
  for (const msg::TaskItem& item : m.items) {
    out.add_tile(item.tile);
    out.add_phase(item.phase);
    out.add_extra_mask(item.extraMask);
  }
  return out;
}

pb::Cancel header(const msg::Cancel& m) {
  pb::Cancel out;
  out.set_job_version(m.jobVersion);
  out.set_frame(m.frame);
  return out;
}

pb::Result header(const msg::Result& m) {
  NINEFOLD_CHECK(m.encoded.size() <= kMaxTileBytes);
  pb::Result out;
  out.set_job_version(m.jobVersion);
  out.set_frame(m.frame);
  out.set_tile(m.tile);
  out.set_phase(m.phase);
  out.set_busy_ns(m.busyNs);
  out.set_sets_made(m.setsMade);
  out.set_replaced(m.replaced);
  out.set_replaced_in(m.replacedIn);
  put(m.rays, out);
  return out;
}

pb::Ping header(const msg::Ping& m) {
  pb::Ping out;
  out.set_clock_ns(m.clockNs);
  return out;
}

pb::Pong header(const msg::Pong& m) {
  pb::Pong out;
  out.set_echo_ns(m.echoNs);
  out.set_clock_ns(m.clockNs);
  return out;
}

pb::Edit header(const msg::Edit& m) {
  NINEFOLD_CHECK(m.edit.objects.size() <= kMaxEdits);
  NINEFOLD_CHECK(m.edit.lights.size() <= kMaxEdits);
  NINEFOLD_CHECK(m.edit.materials.size() <= kMaxEdits);
  NINEFOLD_CHECK(m.edit.shapes.size() <= kMaxShapePieces);
  pb::Edit out;
  out.set_version(m.version), out.set_moving(m.moving), out.set_more(m.more);
  toWire(m.edit, out);
  return out;
}

pb::Goodbye header(const msg::Goodbye& m) {
  pb::Goodbye out;
  out.set_reason(printable(m.reason, kMaxText));
  return out;
}

pb::Steps header(const msg::Steps& m) {
  NINEFOLD_CHECK(!m.units.empty());
  NINEFOLD_CHECK(m.units.size() <= kMaxTasksPerMessage);
  pb::Steps out;
  out.set_job_version(m.jobVersion);
  toWire(m.step, *out.mutable_step());
  out.mutable_unit()->Add(m.units.begin(), m.units.end());
  out.set_allowed_ns(nanoseconds(m.allowed));
  return out;
}

pb::Stepped header(const msg::Stepped& m) {
  NINEFOLD_CHECK(m.deltas.size() <= kMaxDeltaBytes);
  pb::Stepped out;
  out.set_job_version(m.jobVersion);
  out.set_number(m.number);
  out.set_unit(m.unit);
  out.set_busy_ns(m.busyNs);
  out.set_state_hash(m.stateHash);
  put(m.rays, out);
  return out;
}

pb::CancelSteps header(const msg::CancelSteps& m) {
  pb::CancelSteps out;
  out.set_number(m.number);
  return out;
}

pb::StateDelta header(const msg::StateDelta& m) {
  NINEFOLD_CHECK(m.deltas.size() <= kMaxDeltaBytes);
  pb::StateDelta out;
  out.set_from(m.from);
  out.set_to(m.to);
  out.set_part(m.part);
  out.set_parts(m.parts);
  out.set_hash(m.hash);
  out.set_oldest(m.oldest);
  return out;
}

pb::StateOffer header(const msg::StateOffer& m) {
  NINEFOLD_CHECK(m.pages.size() <= kMaxStatePages);
  pb::StateOffer out;
  out.set_version(m.version);
  out.set_hash(m.hash);
  for (const auto& [id, blob] : m.pages) {
    pb::StatePage& page = *out.add_pages();
    page.set_kind(id.kind);
    page.set_index(id.index);
    put(blob, *page.mutable_blob());
  }
  return out;
}

Bytes payload(msg::BlobChunk& m) { return std::move(m.bytes); }
Bytes payload(msg::Result& m) { return std::move(m.encoded); }
Bytes payload(msg::Edit& m) { return shapeBytes(m.edit.shapes); }
Bytes payload(msg::Stepped& m) { return std::move(m.deltas); }
Bytes payload(msg::StateDelta& m) { return std::move(m.deltas); }
template <typename T>
Bytes payload(T&) {
  return {};
}

}  // namespace

Frame encodeMessage(Message&& message) {
  Frame frame;
  frame.type = static_cast<uint16_t>(typeOf(message));
  std::visit(
      [&](auto& m) {
        header(m).SerializeToString(&frame.header);
        frame.payload = payload(m);
      },
      message);
  const FrameLimit limit = messageLimit(frame.type);
  NINEFOLD_CHECK(frame.header.size() <= limit.header);
  NINEFOLD_CHECK(frame.payload.size() <= limit.payload);
  return frame;
}

}  // namespace ninefold
