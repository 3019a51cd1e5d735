// A recording is there once it is whole.
#include "proto/recording.h"

#include <gtest/gtest.h>

#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

msg::Result result(uint32_t frame) {
  msg::Result r;
  r.frame = frame;
  return r;
}

TEST(Recording, IsWholeOnceItIsFinishedAndTheOldOneUntilThen) {
  const TempFolder folder;
  const auto file = folder.write("r", "old");
  Recorder recorder(file, msg::Hello{});
  for (uint32_t i = 0; i < 3; ++i) recorder.add(result(i));
  EXPECT_EQ(std::filesystem::file_size(file), 3u);
  recorder.finish();
  recorder.add(result(3));  // a worker that has not heard of the end
  recorder.finish();
  const std::vector<Message> messages = readRecording(file);
  ASSERT_EQ(messages.size(), 4u);
  EXPECT_EQ(std::get<msg::Result>(messages[3]).frame, 2u);
}

TEST(Recording, HoldsWhatTheMasterAskedForInItsOrder) {
  const TempFolder folder;
  msg::Hello hello;
  hello.name = "north";
  msg::Edit edit;
  edit.version = 2;
  Recorder recorder(folder.path() / "r", hello);
  const msg::Tasks tasks{.jobVersion = 4, .frame = {3, 2, 1, 0.5f}, .items = {{7, 8, 0}}};
  for (const Message& message :
       {Message(msg::SceneOffer{1, {BlobInfo{.rawBytes = 9}}}), Message(msg::Ping{5}),
        Message(edit), Message(msg::Configure{1, 4, Settings{}}), Message(tasks),
        Message(msg::Cancel{})})
    recorder.heard(message);
  recorder.add(result(3));
  recorder.finish();
  const std::vector<Message> messages = readRecording(folder.path() / "r");
  ASSERT_EQ(messages.size(), 6u) << "heartbeats and the like are of no use";
  EXPECT_EQ(std::get<msg::Hello>(messages[0]).name, "north");
  EXPECT_EQ(std::get<msg::SceneOffer>(messages[1]).blobs.at(0).rawBytes, 9u);
  EXPECT_EQ(std::get<msg::Edit>(messages[2]).version, 2u);
  EXPECT_EQ(std::get<msg::Configure>(messages[3]).jobVersion, 4u);
  EXPECT_EQ(std::get<msg::Tasks>(messages[4]).items, tasks.items);
  EXPECT_EQ(std::get<msg::Tasks>(messages[4]).frame.photonRadius, 0.5f);
  EXPECT_EQ(std::get<msg::Result>(messages[5]).frame, 3u);
}

TEST(Recording, HoldsAStateAndItsSteps) {
  const TempFolder folder;
  Recorder recorder(folder.path() / "r", msg::Hello{});
  Sha256 page{}, mesh{};
  page[0] = 1, mesh[0] = 2;
  msg::StateOffer offer{3, 4, {{{1, 2}, {page, 9, BlobKind::page}}}};
  msg::StateDelta delta;
  delta.from = 3, delta.to = 4, delta.deltas = Bytes(5, std::byte{6});
  const msg::Steps steps{1, {9, 4, 5}, {0, 1}};
  for (const Message& message :
       {Message(msg::BlobChunk{mesh, 0, 1, Bytes(1, std::byte{1})}), Message(offer),
        Message(msg::BlobChunk{page, 0, 1, Bytes(1, std::byte{2})}),
        Message(msg::BlobChunk{mesh, 0, 1, Bytes(1, std::byte{1})}), Message(delta), Message(steps),
        Message(msg::CancelSteps{9})})
    recorder.heard(message);
  msg::Stepped stepped;
  stepped.number = 9, stepped.unit = 1;
  recorder.add(stepped);
  recorder.finish();
  const std::vector<Message> messages = readRecording(folder.path() / "r");
  ASSERT_EQ(messages.size(), 6u) << "a scene's blobs are of no use";
  EXPECT_EQ(std::get<msg::StateOffer>(messages[1]).pages, offer.pages);
  EXPECT_EQ(std::get<msg::BlobChunk>(messages[2]).bytes, Bytes(1, std::byte{2}));
  EXPECT_EQ(std::get<msg::StateDelta>(messages[3]).deltas, delta.deltas);
  EXPECT_EQ(std::get<msg::Steps>(messages[4]).units, steps.units);
  EXPECT_EQ(std::get<msg::Stepped>(messages[5]).unit, 1u);
}

TEST(Recording, WhatIsNoneIsToldWithItsName) {
  const TempFolder folder;
  const auto complaintOf = [](const std::filesystem::path& file) -> std::string {
    try {
      readRecording(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto key = folder.write("k1", std::string(32, 'k'));
  EXPECT_TRUE(complaintOf(key).starts_with("recording " + key.string() + ": ")) << complaintOf(key);
  EXPECT_NE(complaintOf(folder.path() / "none").find("none: No such file"), std::string::npos);
}

TEST(Recording, AFileThatCannotBeIsRefusedBeforeAnythingIsRendered) {
  const TempFolder folder;
  EXPECT_THROW(Recorder(folder.path() / "none" / "r", msg::Hello{}), Error);
  EXPECT_THROW(Recorder("/dev/null", msg::Hello{}), Error);
  EXPECT_THROW(Recorder(folder.path(), msg::Hello{}), Error);
}

}  // namespace
}  // namespace ninefold
