#include "common/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>

#include "common/base/descriptor.h"
#include "common/base/error.h"
#include "common/base/read_up_to.h"
#include "common/base/written_file.h"
#include "common/image/decode.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

constexpr int kBandRows = 64;  // rows interleaved and written at a time

std::string extensionOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void checkExtension(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension != ".exr" && extension != ".hdr" && extension != ".png")
    fail("cannot write {}: the name must end in .exr, .hdr or .png", path);
}

// A library's report as part of our one line.
std::string oneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "unknown reason" : text;
}

// Where the library writes to. It keeps what goes wrong: at a close the library may not mind it.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit FileProxy(WrittenFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const override { return "ninefold"; }
  size_t write(const void* bytes, size_t count) override {
    const size_t written = pwrite(bytes, count, m_pos);
    m_pos += static_cast<int64_t>(written);
    return written;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    try {
      file_.writeAt(static_cast<uint64_t>(offset), {static_cast<const char*>(bytes), count});
      return count;
    } catch (const Error& error) {  // must not pass through a library in C
      if (failure_.empty()) failure_ = error.what();
      return 0;
    }
  }
  size_t size() const override { return static_cast<size_t>(file_.size()); }
  const std::string& failure() const { return failure_; }

 private:
  WrittenFile& file_;
  std::string failure_;
};

using Planes = std::vector<const float*>;

Planes planesOf(const Picture& picture, bool withExtras) {
  const RgbPlane& p = picture.beauty.pixels;
  Planes planes = {p.r.data(), p.g.data(), p.b.data()};
  for (const Channel& channel : picture.extras) {
    NINEFOLD_CHECK(channel.values.size() == picture.beauty.count());
    if (withExtras) planes.push_back(channel.values.data());
  }
  return planes;
}

// `extras`: those that the file gets.
OIIO::ImageSpec specOf(int width, int height, std::span<const Channel> extras,
                       const Metadata& metadata, bool isExr) {
  OIIO::ImageSpec spec(width, height, 3 + static_cast<int>(extras.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  for (const Channel& channel : extras) spec.channelnames.push_back(channel.name);
  if (isExr) {
    const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
    spec.attribute("compression", "zip");
  }
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("Software", "Ninefold");
  for (const auto& [key, value] : metadata) spec.attribute("ninefold:" + key, value);
  return spec;
}

bool writeFloats(OIIO::ImageOutput& output, const OIIO::ImageSpec& spec, const Planes& planes) {
  const size_t channels = planes.size(), width = static_cast<size_t>(spec.width);
  std::vector<float> band(channels * width * kBandRows);
  for (int y = 0; y < spec.height; y += kBandRows) {
    const int end = std::min(spec.height, y + kBandRows);
    const size_t first = static_cast<size_t>(y) * width;
    const size_t count = static_cast<size_t>(end - y) * width;
    for (size_t c = 0; c < channels; ++c)
      for (size_t i = 0; i < count; ++i) band[i * channels + c] = planes[c][first + i];
    if (!output.write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, band.data())) return false;
  }
  return true;
}

// What went wrong, or nothing. Calls write(output) for the open file. `name` tells the format.
template <typename Write>
std::optional<std::string> writeTo(OIIO::Filesystem::IOProxy& proxy, const std::string& name,
                                   const OIIO::ImageSpec& spec, const Write& write) {
  const auto output = OIIO::ImageOutput::create(name, &proxy);
  if (!output) return oneLine(OIIO::geterror());
  if (output->open(name, spec) && write(*output) && output->close()) return std::nullopt;
  return oneLine(output->geterror());
}

template <typename Write>
void writeFile(const std::string& path, const OIIO::ImageSpec& spec, const Write& write) {
  WrittenFile file(path);
  FileProxy proxy(file);
  const auto problem = writeTo(proxy, "a" + extensionOf(path), spec, write);
  if (!proxy.failure().empty()) fail("{}", proxy.failure());
  if (problem) fail("cannot write {}: {}", path, *problem);
  file.publish();
}

void writeCodes(const std::string& path, const DisplayImage& picture, const Metadata& metadata) {
  OIIO::ImageSpec spec = specOf(picture.width, picture.height, {}, metadata, false);
  spec.set_format(OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  writeFile(path, spec, [&](OIIO::ImageOutput& output) {
    return output.write_image(OIIO::TypeDesc::UINT8, picture.rgb.data());
  });
}

constexpr uint64_t kMaxFileBytes = 4ull << 30;

std::vector<std::byte> bytesOf(const std::string& path) {
  // Non-blocking, so that a pipe without a writer cannot hold us before fstat tells what it is.
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat facts {};
  if (!fd || ::fstat(fd.get(), &facts) != 0) fail("{}", std::strerror(errno));
  if (!S_ISREG(facts.st_mode)) fail("it is no regular file");
  if (static_cast<uint64_t>(facts.st_size) > kMaxFileBytes)
    fail("it has {} bytes, more than {}: scale it down", facts.st_size, kMaxFileBytes);
  std::vector<std::byte> bytes(static_cast<size_t>(facts.st_size));
  if (readUpTo(fd.get(), bytes) != bytes.size()) fail("it cannot be read to its end");
  return bytes;
}

}  // namespace

void checkOutputPath(const std::string& path) {
  checkExtension(path);
  checkWritable(path);
}

void writeImage(const std::string& path, const Picture& picture, const ToneMap& toneMap) {
  checkExtension(path);
  const std::string extension = extensionOf(path);
  if (extension == ".png") {
    DisplayImage codes;
    toneMap.apply(picture.beauty, codes);
    return writeCodes(path, codes, picture.metadata);
  }
  const bool isExr = extension == ".exr";
  const OIIO::ImageSpec spec = specOf(
      picture.beauty.width, picture.beauty.height,
      isExr ? std::span(picture.extras) : std::span<const Channel>(), picture.metadata, isExr);
  writeFile(path, spec, [&](OIIO::ImageOutput& output) {
    return writeFloats(output, spec, planesOf(picture, isExr));
  });
}

std::vector<uint8_t> encodeExr(const Picture& picture) {
  const OIIO::ImageSpec spec =
      specOf(picture.beauty.width, picture.beauty.height, picture.extras, picture.metadata, true);
  OIIO::Filesystem::IOVecOutput file;
  const auto problem = writeTo(file, "a.exr", spec, [&](OIIO::ImageOutput& output) {
    return writeFloats(output, spec, planesOf(picture, true));
  });
  if (problem) fail("no EXR can be written: {}", *problem);
  const auto& bytes = file.buffer();
  return {bytes.begin(), bytes.end()};
}

void writePng(const std::string& path, const DisplayImage& picture) {
  NINEFOLD_CHECK(extensionOf(path) == ".png");
  writeCodes(path, picture, {});
}

RgbImage readImage(const std::string& path, ImageLimits limits) try {
  return decodePicture(bytesOf(path), limits);
} catch (const Error& error) {
  fail("cannot read image {}: {}", path, error.what());
}

}  // namespace ninefold
