// Messages of a method's state: what is refused, by its name, and what just fits. That every field
// arrives: messages_test.cpp.
#include <gtest/gtest.h>

#include "proto/messages.h"
#include "proto/messages.pb.h"
#include "proto/state_wire.h"

namespace ninefold {
namespace {

// The error's text, "" if the message is accepted.
std::string refusal(Frame&& frame) {
  const bool isClients = maySend(Peer::client, static_cast<MessageType>(frame.type));
  try {
    decodeMessage(std::move(frame), isClients ? Peer::client : Peer::master);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusal(Message message) { return refusal(encodeMessage(std::move(message))); }

// What our own encoder would not write, as a hostile peer may.
template <typename Header>
std::string refusal(MessageType type, const Header& header, size_t payload = 0) {
  Frame frame{static_cast<uint16_t>(type), "", Bytes(payload, std::byte{1})};
  header.SerializeToString(&frame.header);
  return refusal(std::move(frame));
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << text << "\" does not say \"" << part << "\"";
}

StatePage somePage(uint16_t kind, uint32_t index, uint64_t rawBytes = kMaxPageBlobBytes,
                   BlobKind blobKind = BlobKind::page) {
  return {{kind, index}, {Sha256{}, rawBytes, blobKind}};
}

TEST(StateMessages, FieldsOutOfRangeAreNamed) {
  const std::pair<const char*, Message> cases[] = {
      {"version 3 to 3", msg::Steps{1, {0, 3, 3}, {0}}},
      {"unit is 6", msg::Steps{1, {0, 0, 1, 7}, {7, 6}}},
      {"allowed time", msg::Steps{1, {}, {0}, Duration(0)}},
      {"allowed time", msg::Steps{1, {}, {0}, std::chrono::hours(1001)}},
      {"version 3 to 3", msg::StateDelta{3, 3, 0, 1, 0, 0, {}}},
      {"version 3 to 2", msg::StateDelta{3, 2, 0, 1, 0, 0, {}}},
      {"part is 1", msg::StateDelta{0, 1, 1, 1, 0, 0, {}}},
      {"number of parts", msg::StateDelta{0, 1, 0, 0, 0, 0, {}}},
      {"number of parts", msg::StateDelta{0, 1, 0, 65537, 0, 0, {}}},
      {"page 2.3", msg::StateOffer{1, 0, {somePage(2, 3), somePage(2, 3)}}},
      {"page 2.3", msg::StateOffer{1, 0, {somePage(2, 4), somePage(2, 3)}}},
      {"page 1.9", msg::StateOffer{1, 0, {somePage(2, 4), somePage(1, 9)}}},
      {"blob kind", msg::StateOffer{1, 0, {somePage(0, 0, 1, BlobKind::meshes)}}},
      {"blob kind", msg::StateOffer{1, 0, {somePage(0, 0, 1, static_cast<BlobKind>(9))}}},
      {"blob size", msg::StateOffer{1, 0, {somePage(0, 0, 0)}}},
      {"blob size", msg::StateOffer{1, 0, {somePage(0, 0, kMaxPageBlobBytes + 1)}}},
  };
  for (const auto& [field, message] : cases) {
    const std::string text = refusal(Message(message));
    EXPECT_TRUE(says(text, field));
    EXPECT_TRUE(says(text, nameOf(typeOf(message))));
  }
}

TEST(StateMessages, TheLargestFit) {
  msg::Steps steps{~0u, {~0u, 0, ~0u, ~0u, ~0u}, {}, kLongestAllowed};
  steps.units.assign(kMaxTasksPerMessage, ~0u);
  EXPECT_EQ(refusal(Message(steps)), "");
  msg::StateOffer pages{~0u, ~0ull, {}};
  for (uint32_t i = 0; i < kMaxStatePages; ++i)
    pages.pages.push_back(somePage(65535, ~0u << 16 | i));
  EXPECT_EQ(refusal(Message(pages)), "");
  const Bytes deltas(kMaxDeltaBytes, std::byte{1});
  EXPECT_EQ(refusal(msg::Stepped{1, 1, 1, 1, 1, {}, deltas}), "");
  EXPECT_EQ(refusal(msg::StateDelta{0, 1, 65535, 65536, 1, 0, deltas}), "");
}

TEST(StateMessages, ListsThatAreTooShortOrTooLongAreNamed) {
  pb::Steps steps;
  steps.mutable_step()->set_to(1), steps.set_allowed_ns(1);
  EXPECT_TRUE(says(refusal(MessageType::steps, steps), "number of units is 0"));
  for (size_t i = 0; i <= kMaxTasksPerMessage; ++i) steps.add_unit(0);
  EXPECT_TRUE(says(refusal(MessageType::steps, steps), "number of units is 4097"));

  pb::StateOffer offer;
  for (uint32_t i = 0; i <= kMaxStatePages; ++i) offer.add_pages()->set_index(i);
  EXPECT_TRUE(says(refusal(MessageType::stateOffer, offer), "number of pages is 65537"));
  offer.clear_pages(), offer.add_pages();
  EXPECT_TRUE(says(refusal(MessageType::stateOffer, offer), "hash has 0 bytes"));
  offer.mutable_pages(0)->set_kind(65536);
  EXPECT_TRUE(says(refusal(MessageType::stateOffer, offer), "page kind is 65536"));

  pb::StateDelta delta;
  delta.set_to(1), delta.set_parts(1);
  EXPECT_EQ(refusal(MessageType::stateDelta, delta, kMaxDeltaBytes), "");
  EXPECT_TRUE(says(refusal(MessageType::stateDelta, delta, kMaxDeltaBytes + 1), "too long"));
}

}  // namespace
}  // namespace ninefold
