#include "proto/recording.h"

#include <fstream>

#include "proto/framing.h"

namespace ninefold {

Recorder::Recorder(const std::filesystem::path& file, const msg::Hello& hello)
    : file_(std::make_unique<WrittenFile>(file)) {
  write(hello);
}

void Recorder::add(const msg::Result& result) { write(result); }

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

std::vector<msg::Result> readRecording(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("recording {}: cannot read it", file.string());
  FrameParser parser(messageLimit);
  std::vector<msg::Result> results;
  while (true) {
    const std::span<std::byte> space = parser.space();
    stream.read(reinterpret_cast<char*>(space.data()), static_cast<std::streamsize>(space.size()));
    const auto got = static_cast<size_t>(stream.gcount());
    if (got == 0) break;
    if (std::optional<Frame> frame = parser.filled(got)) {
      Message message = decodeMessage(std::move(*frame), Peer::client);
      if (auto* result = std::get_if<msg::Result>(&message)) results.push_back(std::move(*result));
    }
  }
  // The last result may be cut short: the disk was full.
  if (results.empty()) fail("recording {}: holds no result", file.string());
  return results;
}

}  // namespace ninefold
