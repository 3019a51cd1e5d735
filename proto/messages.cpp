#include "proto/messages.h"

namespace ninefold {
namespace {

enum Direction : uint8_t { kFromClient = 1, kFromMaster = 2, kBoth = 3 };

struct TypeFacts {
  const char* name;
  Direction direction;
  FrameLimit limit;
};

// A few fields and texts; lists have limits of their own (field keys and lengths included).
constexpr uint32_t kSmall = 4096;
constexpr uint32_t kOfferBytes = kMaxBlobs * 64;
constexpr uint32_t kEditBytes = 3 * kMaxEdits * 128;
constexpr uint32_t kTasksBytes = kMaxTasksPerMessage * 12 + kSmall;
constexpr uint32_t kStepsBytes = kMaxTasksPerMessage * 6 + kSmall;
constexpr uint32_t kPagesBytes = kMaxStatePages * 64 + kSmall;

constexpr TypeFacts kUnknown{"unknown", static_cast<Direction>(0), {0, 0}};
constexpr TypeFacts kTypes[] = {
    {"Hello", kFromClient, {kSmall, 0}},
    {"Welcome", kFromMaster, {kSmall, 0}},
    {"Refuse", kFromMaster, {kSmall, 0}},
    {"SceneOffer", kFromMaster, {kOfferBytes, 0}},
    {"BlobRequest", kFromClient, {kSmall, 0}},
    {"BlobChunk", kFromMaster, {kSmall, kBlobChunkBytes}},
    {"Configure", kFromMaster, {kSmall, 0}},
    {"Ready", kFromClient, {kSmall, 0}},
    {"Progress", kFromClient, {kSmall, 0}},
    {"Tasks", kFromMaster, {kTasksBytes, 0}},
    {"Cancel", kFromMaster, {kSmall, 0}},
    {"Result", kFromClient, {kSmall, kMaxTileBytes}},
    {"Ping", kBoth, {kSmall, 0}},
    {"Pong", kBoth, {kSmall, 0}},
    {"Goodbye", kBoth, {kSmall, 0}},
    {"Edit", kFromMaster, {kEditBytes, kMaxShapeBytes}},
    {"Steps", kFromMaster, {kStepsBytes, 0}},
    {"Stepped", kFromClient, {kSmall, kMaxDeltaBytes}},
    {"CancelSteps", kFromMaster, {kSmall, 0}},
    {"StateDelta", kFromMaster, {kSmall, kMaxDeltaBytes}},
    {"StateOffer", kFromMaster, {kPagesBytes, 0}},
};
static_assert(std::size(kTypes) == std::variant_size_v<Message>);

const TypeFacts& factsOf(uint16_t type) {
  return type >= 1 && type <= std::size(kTypes) ? kTypes[type - 1] : kUnknown;
}

}  // namespace

const char* nameOf(MessageType type) { return factsOf(static_cast<uint16_t>(type)).name; }

bool maySend(Peer sender, MessageType type) {
  const int bit = sender == Peer::client ? kFromClient : kFromMaster;
  return (factsOf(static_cast<uint16_t>(type)).direction & bit) != 0;
}

FrameLimit messageLimit(uint16_t type) { return factsOf(type).limit; }

}  // namespace ninefold
