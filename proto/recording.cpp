#include "proto/recording.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "proto/framing.h"

namespace ninefold {

Recorder::Recorder(const std::filesystem::path& file, const msg::Hello& hello)
    : file_(std::make_unique<WrittenFile>(file)) {
  write(hello);
}

void Recorder::add(const msg::Result& result) { write(result); }
void Recorder::add(const msg::Stepped& stepped) { write(stepped); }

void Recorder::heard(const Message& message) {
  switch (typeOf(message)) {
    case MessageType::stateOffer: {
      const std::lock_guard lock(mutex_);
      for (const StatePage& page : std::get<msg::StateOffer>(message).pages)
        pages_.insert(page.blob.hash);
      break;
    }
    case MessageType::blobChunk: {
      const std::lock_guard lock(mutex_);
      if (!pages_.contains(std::get<msg::BlobChunk>(message).hash)) return;
      break;
    }
    case MessageType::sceneOffer:
    case MessageType::edit:
    case MessageType::configure:
    case MessageType::tasks:
    case MessageType::steps:
    case MessageType::stateDelta:
      break;
    default:
      return;
  }
  write(message);
}

void Recorder::write(Message message) {
  const Frame frame = encodeMessage(std::move(message));
  const auto head = frameHead(frame);
  const std::lock_guard lock(mutex_);
  if (!file_) return;
  for (const ByteView part : {ByteView(head), viewOf(frame.header), ByteView(frame.payload)})
    file_->write(textOf(part));
}

void Recorder::finish() {
  const std::lock_guard lock(mutex_);
  if (const auto file = std::move(file_)) file->publish();
}

namespace {

std::vector<Message> readMessages(std::istream& stream) {
  FrameParser parser(messageLimit);
  std::vector<Message> messages;
  while (true) {
    const std::span<std::byte> space = parser.space();
    stream.read(reinterpret_cast<char*>(space.data()), static_cast<std::streamsize>(space.size()));
    const auto got = static_cast<size_t>(stream.gcount());
    if (got == 0) break;
    if (std::optional<Frame> frame = parser.filled(got)) {
      const bool isClients = maySend(Peer::client, static_cast<MessageType>(frame->type));
      const Peer sender = isClients ? Peer::client : Peer::master;
      messages.push_back(decodeMessage(std::move(*frame), sender));
    }
  }
  return messages;
}

}  // namespace

std::vector<Message> readRecording(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("recording {}: {}", file.string(), std::strerror(errno));
  try {
    return readMessages(stream);
  } catch (const Error& error) {
    fail("recording {}: {}; give a file that ninefold-client --record has written", file.string(),
         error.what());
  }
}

}  // namespace ninefold
