#include "proto/recording.h"

#include "proto/framing.h"

namespace ninefold {
namespace {

void write(std::ofstream& file, ByteView bytes) {
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& file, const msg::Hello& hello)
    : path_(file), file_(file, std::ios::binary | std::ios::trunc) {
  write(hello);
}

void Recorder::add(const msg::Result& result) { write(result); }

void Recorder::write(Message message) {
  const Frame frame = encodeMessage(std::move(message));
  const std::lock_guard lock(mutex_);
  ninefold::write(file_, frameHead(frame));
  ninefold::write(file_, viewOf(frame.header));
  ninefold::write(file_, frame.payload);
  file_.flush();
  if (!file_) fail("recording {}: cannot write it", path_.string());
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
  // The last result may be cut short: a client ends whenever its master does.
  if (results.empty()) fail("recording {}: holds no result", file.string());
  return results;
}

}  // namespace ninefold
