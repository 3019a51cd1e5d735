// messages.h: what master and clients say to each other, as plain values. PROTOCOL.md tells the
// story.
//
//   M = master, C = client. One line per message: direction, when, and what answers it.
//
// A message's fields travel as Protocol Buffers (messages.proto), its bulk bytes raw behind them
// (framing.h). Nothing outside proto/ sees either: state machines eat and give Message values.
// Errors: decodeMessage throws Error that names message and field, for anything malformed or out of
// range. Every Message that came from a peer is in range.
// Threads: plain values, pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/clock.h"
#include "common/base/counters.h"
#include "common/base/release.h"
#include "common/image/layers.h"
#include "common/image/surface_test.h"
#include "common/image/tone_map.h"
#include "common/scene/edit.h"
#include "common/scene/settings.h"
#include "common/state/page.h"
#include "proto/bytes.h"
#include "proto/framing.h"
#include "proto/sha256.h"
#include "proto/wire_version.h"

namespace ninefold {

// Limits on what a message may carry; senders keep to them, receivers enforce them.
inline constexpr size_t kMaxText = 256;     // name, reason: bytes of printable text
inline constexpr size_t kMaxBlobs = 65536;  // in one scene
inline constexpr size_t kMaxTasksPerMessage = 4096;
inline constexpr size_t kMaxEdits = 65536;  // things in one edit
inline constexpr size_t kMaxShapePieces = 5;
inline constexpr size_t kMaxShapeBytes = kMaxShapePieces * ShapePiece::kVertices * 24;
inline constexpr size_t kJobsKept = 20;  // the latest jobs are those that tasks may be of
inline constexpr size_t kBlobChunkBytes = 256 << 10;     // so that heartbeats slip in between
inline constexpr uint64_t kMaxPackedBytes = 3ull << 30;  // one compressed blob
inline constexpr uint8_t kAllExtraPlanes = (1 << kExtraPlanes) - 1;  // every bit of ExtraPlane
inline constexpr size_t kMaxTileBytes = 2 << 20;                     // an encoded tile
inline constexpr size_t kMaxDeltaBytes = 2 << 20;                    // encoded page deltas
inline constexpr size_t kMaxStatePages = 65536;                      // in one version of a state
inline constexpr uint32_t kMaxDeltaParts = 65536;                    // from version to version
// How long a client lets a result that is not urgent wait for others; the scheduler counts on it.
inline constexpr Duration kResultsTogether = milliseconds(4);
inline constexpr Duration kLongestAllowed = std::chrono::hours(1000);  // for a task
// Exit status of a client that its own watchdog has ended (client/watchdog.h).
inline constexpr int kHungStatus = 3;

enum class MessageType : uint16_t {
  hello = 1,    // C -> M  first on every connection                            -> Welcome | Refuse
  welcome = 2,  // M -> C  the client is in; SceneOffer and Configure follow
  refuse = 3,   // M -> C  why not; the master closes, the client does not retry
  sceneOffer = 4,   // M -> C  the scene's blobs; what is not cached is asked for   -> BlobRequest*
  blobRequest = 5,  // C -> M  one piece of one blob; a few may be in flight        -> BlobChunk
  blobChunk = 6,    // M -> C  the piece, zstd bytes as payload
  configure = 7,    // M -> C  settings of a job on a scene version; tasks may follow -> Ready, once
  ready = 8,        // C -> M  tasks of this job can be done now
  progress = 9,     // C -> M  how far the client is with fetching or building the scene
  tasks = 10,    // M -> C  work of one frame, done in this order                -> Result for each
  cancel = 11,   // M -> C  forget queued tasks of older jobs or frames (no answer)
  result = 12,   // C -> M  one finished task, the encoded tile as payload
  ping = 13,     // both    sign of life with a clock                            -> Pong
  pong = 14,     // both    the ping's clock and one's own
  goodbye = 15,  // both    the sender leaves on purpose; the connection closes
  edit = 16,     // M -> C  the scene changed; jobs that are configured from here on see it
  steps = 17,    // M -> C  work of one step of the state, done in this order   -> Stepped for each
  stepped = 18,  // C -> M  one finished unit, its page deltas as payload
  cancelSteps = 19,  // M -> C  forget queued units of older steps (no answer)
  stateDelta = 20,   // M -> C  from one version of the state to a later one, deltas as payload
  stateOffer = 21,   // M -> C  a version's pages, for a client that comes late   -> BlobRequest*
};

// Who sent it. Messages that run the wrong way are malformed.
enum class Peer : uint8_t { master, client };

// page: of a method's state (state_wire.h); the others are parts of a scene (scene_blobs.h).
enum class BlobKind : uint8_t { rest = 0, image = 1, meshes = 2, environment = 3, page = 4 };

struct BlobInfo {
  Sha256 hash{};          // of the raw bytes
  uint64_t rawBytes = 0;  // declared size after decompression, 1..kMaxBlobBytes (scene_blobs.h)
  BlobKind kind = BlobKind::rest;
  bool operator==(const BlobInfo&) const = default;
};

struct StatePage {
  PageId page;
  BlobInfo blob;  // of kind page
  bool operator==(const StatePage&) const = default;
};

enum class Phase : uint8_t { fetching = 0, building = 1 };

// How results are to be sent.
struct Delivery {
  static constexpr int kAdaptive = -1, kHighestLevel = 19;
  // layers: a task is one phase of a tile. Else it is a whole tile, filtered, and sent as radiance
  // or as a display's codes.
  enum class Form : uint8_t { layers, radiance, display };

  int level = kAdaptive;  // of zstd; kAdaptive: what suits the client's line
  Form form = Form::layers;
  SurfaceTest filter = SurfaceTest::surface;  // of whole tiles
  float exposure = 0;                         // [EV] of codes
  ToneCurve curve = ToneCurve::srgb;          // of codes
  bool wholeTiles() const { return form != Form::layers; }
  bool operator==(const Delivery&) const = default;
};

namespace msg {

struct Hello {
  uint32_t protocol = kProtocol;
  std::string release = releaseName();
  std::string name;        // for people: host name and process, unique names are not required
  uint32_t threads = 1;    // 1..1024
  std::string isa;         // what runs: "avx2", "avx512"
  std::string probeClass;  // probeClass() of gi/renderer.h
  bool visits = false;     // asks and goes, renders nothing and is no client (ninefold-doctor)
};
struct Welcome {
  uint32_t clientId = 0;  // unique in this run of the master
  std::string release = releaseName();
  std::string probeClass = {};  // of the run, by its first client; empty: none was there yet
  uint64_t wallClockMs = 0;     // the master's, since 1970; the server fills it in
};
struct Refuse {
  std::string reason;
};
struct SceneOffer {
  uint32_t sceneVersion = 0;
  std::vector<BlobInfo> blobs;  // in scene order, see scene_blobs.h
};
struct BlobRequest {
  Sha256 hash{};
  uint64_t offset = 0;  // into the compressed bytes
};
struct BlobChunk {
  Sha256 hash{};
  uint64_t offset = 0;
  uint64_t total = 0;  // compressed bytes of the whole blob
  Bytes bytes;         // at most kBlobChunkBytes; offset + size <= total
};
struct Configure {
  uint32_t sceneVersion = 0;
  uint32_t jobVersion = 0;
  Settings settings;
  Delivery delivery = {};
};
struct Ready {
  uint32_t sceneVersion = 0;
  uint32_t jobVersion = 0;
};
struct Progress {
  Phase phase = Phase::fetching;
  uint64_t done = 0, total = 0;  // bytes when fetching, steps when building; done <= total
};
struct TaskItem {
  uint32_t tile = 0;      // 0..TileGrid::tiles()-1
  uint32_t phase = 0;     // 0..Interleave::sets()-1; 0 if tiles are whole
  uint8_t extraMask = 0;  // bits of ExtraPlane
  bool operator==(const TaskItem&) const = default;
};
struct Tasks {
  uint32_t jobVersion = 0;
  FrameKey frame;
  std::vector<TaskItem> items;  // 1..kMaxTasksPerMessage
  float neighbourWeight = 1;    // of the filter, in [0, 1]; for tiles that are filtered there
  bool urgent = false;          // no result is to wait for others
  Duration allowed = std::chrono::hours(1);  // for each, on one thread: up to kLongestAllowed
};
struct Cancel {
  uint32_t jobVersion = 0;  // the latest
  uint32_t frame = 0;       // tasks of frames before this one are void, whatever their job
};
struct Result {
  uint32_t jobVersion = 0;
  uint32_t frame = 0;
  uint32_t tile = 0;
  uint32_t phase = 0;
  uint64_t busyNs = 0;    // one thread's time for this task, its light set included if made for it
  uint32_t setsMade = 0;  // light sets made on the way: one at most for each phase
  uint64_t replaced = 0;  // values that were not finite, or negative, and were sent as 0
  uint32_t replacedIn = 0;  // in which fields (tile_names.h)
  RayCounts rays;
  Bytes encoded;  // as tile_codec.h made them
};
struct Ping {
  uint64_t clockNs = 0;  // sender's clock, any epoch
};
struct Pong {
  uint64_t echoNs = 0;   // the ping's clock
  uint64_t clockNs = 0;  // the answerer's clock
};
struct Goodbye {
  std::string reason;
};
struct Edit {
  uint32_t version = 0;  // how often the scene was edited; grows
  SceneEdit edit;        // what has changed since the version that the client has
  bool moving = false;   // a gesture: streams stay those of the last edit that was none
  bool more = false;     // the next message goes on with it; only the last makes a scene
};
struct Steps {
  uint32_t jobVersion = 0;
  StepKey step;                              // to > from
  std::vector<uint32_t> units;               // 1..kMaxTasksPerMessage, from step.firstUnit on
  Duration allowed = std::chrono::hours(1);  // for each, as in Tasks
};
struct Stepped {
  uint32_t jobVersion = 0;
  uint32_t number = 0;  // of the step
  uint32_t unit = 0;
  uint64_t busyNs = 0;     // one thread's time
  uint64_t stateHash = 0;  // of the version that the step began from (state_pages.h)
  RayCounts rays;
  Bytes deltas;  // as state_wire.h made them
};
struct CancelSteps {
  uint32_t number = 0;  // units of steps before this one are void; tasks are not touched
};
struct StateDelta {
  uint32_t from = 0, to = 0;     // to > from
  uint32_t part = 0, parts = 1;  // part < parts <= kMaxDeltaParts; all of them make version `to`
  uint64_t hash = 0;             // of version `to` (state_pages.h)
  uint32_t oldest = 0;           // versions before this one are not named any more
  Bytes deltas;                  // as state_wire.h made them
};
struct StateOffer {
  uint32_t version = 0;
  uint64_t hash = 0;             // of the version (state_pages.h)
  std::vector<StatePage> pages;  // ids ascend; up to kMaxStatePages
};

}  // namespace msg

// In the order of MessageType: alternative i has type i + 1.
using Message =
    std::variant<msg::Hello, msg::Welcome, msg::Refuse, msg::SceneOffer, msg::BlobRequest,
                 msg::BlobChunk, msg::Configure, msg::Ready, msg::Progress, msg::Tasks, msg::Cancel,
                 msg::Result, msg::Ping, msg::Pong, msg::Goodbye, msg::Edit, msg::Steps,
                 msg::Stepped, msg::CancelSteps, msg::StateDelta, msg::StateOffer>;

inline MessageType typeOf(const Message& message) {
  return static_cast<MessageType>(message.index() + 1);
}
const char* nameOf(MessageType type);  // "Hello", ...; "unknown" for other numbers

// True if `sender` may send messages of this type; false for unknown types.
bool maySend(Peer sender, MessageType type);

// Frame sizes by type, for a FrameParser; {0, 0} for unknown types.
FrameLimit messageLimit(uint16_t type);

// Message to frame. Bulk bytes are moved, not copied. The message is our own: CHECKs the limits;
// texts are cut to kMaxText and made printable.
Frame encodeMessage(Message&& message);

// Frame to message; throws Error as said above. `sender` is who the frame came from.
Message decodeMessage(Frame&& frame, Peer sender);

}  // namespace ninefold
