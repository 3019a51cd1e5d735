#include "master/output/video_file.h"

#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr const char* kProgram = "ffmpeg";
constexpr Duration kLook = milliseconds(10);
constexpr uint64_t kLeastRoom = 4096;  // on the disk [bytes]

bool isInPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

// A pair of sockets: writing to an ffmpeg that is gone is then an error, and no signal.
Pipe makeInput() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    fail("cannot talk to {}: {}", kProgram, ::strerror(errno));
  Pipe pipe{Descriptor(ends[0]), Descriptor(ends[1])};
  const timeval patience{VideoFile::kPatience.count(), 0};
  ::setsockopt(pipe.writeEnd.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  return pipe;
}

std::vector<std::string> arguments(const std::string& file, int width, int height, double rate) {
  const std::string size = fmt::format("{}x{}", width, height), perSecond = fmt::format("{}", rate);
  return {"-hide_banner", "-loglevel", "error", "-y",
          // what comes
          "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", size, "-framerate", perSecond,
          "-i", "pipe:0",
          // sRGB as BT.709 says it, with even sides
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
          "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc",
          "iec61966-2-1",
          // what goes
          "-c:v", "libx264", "-crf", "16", "-threads", "1", "-fflags", "+bitexact", "-flags:v",
          "+bitexact", "-movflags", "+faststart", "-f", "mp4", file};
}

// Whether a file is whole: ffmpeg's exit status does not tell. Its boxes (a length of 4 or 8 bytes,
// four letters) fill it, and the index, moov, is among them (ISO/IEC 14496-12, 4.2).
bool isWhole(const std::filesystem::path& path, uint64_t size) {
  std::ifstream file(path, std::ios::binary);
  bool hasIndex = false;
  uint64_t at = 0;
  while (at < size) {
    std::array<unsigned char, 16> head{};
    file.seekg(static_cast<std::streamoff>(at));
    file.read(reinterpret_cast<char*>(head.data()), head.size());
    file.clear();  // the last box may be shorter
    const auto number = [&](size_t first, size_t end) {
      uint64_t n = 0;
      for (size_t i = first; i < end; ++i) n = n << 8 | head.at(i);
      return n;
    };
    const uint64_t length = number(0, 4) == 1 ? number(8, 16) : number(0, 4);
    if (length < 8 || length > size - at) return false;
    hasIndex = hasIndex || std::string(head.begin() + 4, head.begin() + 8) == "moov";
    at += length;
  }
  return hasIndex;
}

ChildProcess startProgram(const std::vector<std::string>& arguments, const Descriptor& input) {
  return ChildProcess::start(kProgram, arguments, input, {STDIN_FILENO, true});
}

}  // namespace

void checkVideo(const std::string& name) {
  if (!isInPath(kProgram))
    fail(
        "cannot write {}: there is no program {} in PATH; install it, or write pictures: --output "
        "out.####.png",
        name, kProgram);
  checkWritable(name);
}

VideoFile::VideoFile(const std::string& name, int width, int height, double rate)
    : name_(name), file_(name), ffmpeg_([&] {
        Pipe pipe = makeInput();
        input_ = std::move(pipe.writeEnd);
        return startProgram(arguments(file_.beside().string(), width, height, rate), pipe.readEnd);
      }()) {}

void VideoFile::add(const DisplayImage& picture) {
  // ffmpeg itself would tell only at the end.
  std::error_code unknown;
  if (std::filesystem::space(file_.beside(), unknown).available < kLeastRoom) failWith("stands");
  const uint8_t* from = picture.rgb.data();
  for (size_t left = picture.rgb.size(); left > 0;) {
    const ssize_t n = ::send(input_.get(), from, left, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) failWith("takes no picture any more");
    if (n < 0) failWith("ended with " + waitForEnd().text);
    from += n, left -= static_cast<size_t>(n);
  }
}

void VideoFile::finish() {
  input_.reset();
  const ChildProcess::Ending ending = waitForEnd();
  if (ending.status != 0) failWith("ended with " + ending.text);
  file_.takeWhatIsThere();
  if (!isWhole(file_.beside(), file_.size())) failWith("left a part");
  file_.publish();
}

ChildProcess::Ending VideoFile::waitForEnd() {
  for (const Time end = Clock::now() + kPatience; Clock::now() < end;
       std::this_thread::sleep_for(kLook))
    if (const auto ending = ffmpeg_.ended()) return *ending;
  return {std::nullopt, "nothing: it hangs, and is killed"};
}

// The disk's being full is told as what it is.
void VideoFile::failWith(const std::string& how) {
  file_.takeWhatIsThere();
  file_.reserve(file_.size() + 2 * kLeastRoom);
  fail("cannot write {}: {} {}; its own line above, if any, tells why", name_, kProgram, how);
}

}  // namespace ninefold
