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

pb::Hello header(const msg::Hello& m) {
  pb::Hello out;
  out.set_protocol(m.protocol);
  out.set_release(printable(m.release, kMaxText));
  out.set_name(printable(m.name, kMaxText));
  out.set_threads(m.threads);
  out.set_isa(printable(m.isa, kMaxText));
  out.set_probe_class(printable(m.probeClass, kMaxText));
  return out;
}

pb::Welcome header(const msg::Welcome& m) {
  pb::Welcome out;
  out.set_client_id(m.clientId);
  out.set_release(printable(m.release, kMaxText));
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
  for (const BlobInfo& info : m.blobs) {
    pb::BlobInfo& blob = *out.add_blobs();
    putHash(info.hash, *blob.mutable_hash());
    blob.set_raw_bytes(info.rawBytes);
    blob.set_kind(static_cast<uint32_t>(info.kind));
  }
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
  out.set_allowed_ns(static_cast<uint64_t>(std::chrono::nanoseconds(m.allowed).count()));
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
  out.set_rays_eye(m.rays.eye);
  out.set_rays_shadow(m.rays.shadow);
  out.set_rays_photon(m.rays.photon);
  out.set_rays_compensation(m.rays.compensation);
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
  pb::Edit out;
  out.set_version(m.version), out.set_moving(m.moving);
  toWire(m.edit, out);
  return out;
}

pb::Goodbye header(const msg::Goodbye& m) {
  pb::Goodbye out;
  out.set_reason(printable(m.reason, kMaxText));
  return out;
}

Bytes payload(msg::BlobChunk& m) { return std::move(m.bytes); }
Bytes payload(msg::Result& m) { return std::move(m.encoded); }
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
