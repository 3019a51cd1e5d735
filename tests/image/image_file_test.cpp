#include "common/image/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "common/base/error.h"
#include "tests/image/library_image.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
 protected:
  ImageFile()
      : folder_(fs::temp_directory_path() /
                ("ninefold_image_" + std::to_string(getpid()) +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ImageFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  std::string bytesOf(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  std::string errorOf(const std::function<void()>& action) const {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

// Radiance from 1e-6 to 1e6, another in each channel and pixel.
RgbImage sample(int width = 70, int height = 131) {
  RgbImage image;
  image.reset(width, height);
  const float last = static_cast<float>(image.count());
  for (size_t i = 0; i < image.count(); ++i) {
    const float t = static_cast<float>(i) / last;
    image.pixels.r[i] = std::pow(10.0f, 12 * t - 6);
    image.pixels.g[i] = std::pow(10.0f, 6 - 12 * t);
    image.pixels.b[i] = t;
  }
  return image;
}

TEST_F(ImageFile, ExrKeepsEveryBit) {
  RgbImage image = sample();
  image.pixels.g[5] = -1.25f;
  image.pixels.b[6] = std::numeric_limits<float>::infinity();
  writeImage(path("a.exr"), {image, {}, {}});
  EXPECT_EQ(readImage(path("a.exr")), image);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, ExrCarriesNamedChannelsAndMetadata) {
  const RgbImage image = sample(5, 3);
  std::vector<Channel> extras;
  appendLayer("albedo",
              {std::vector<float>(15, 1), std::vector<float>(15, 2), {sample(5, 3).pixels.r}},
              extras);
  for (const char* name : {"N.x", "N.y", "N.z", "Z", "objectId"})
    extras.push_back({name, std::vector<float>(15, static_cast<float>(extras.size()) + 0.5f)});
  writeImage(path("a.EXR"), {image, extras, {{"seed", "17"}, {"scene", "table_room.glb"}}});
  EXPECT_EQ(readImage(path("a.EXR")), image);

  const auto input = OIIO::ImageInput::open(path("a.EXR"));
  ASSERT_TRUE(input);
  const OIIO::ImageSpec spec = input->spec();
  EXPECT_EQ(spec.get_string_attribute("ninefold:seed"), "17");
  EXPECT_EQ(spec.get_string_attribute("ninefold:scene"), "table_room.glb");
  EXPECT_EQ(spec.nchannels, 11);
  EXPECT_GE(spec.channelindex("albedo.B"), 0);
  for (const Channel& extra : extras) {
    const int channel = spec.channelindex(extra.name);
    ASSERT_GE(channel, 0) << extra.name;
    std::vector<float> values(15);
    ASSERT_TRUE(
        input->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, values.data()));
    EXPECT_EQ(values, extra.values) << extra.name;
  }
}

TEST_F(ImageFile, HdrKeepsOnePercentOfThePixelsLargestChannel) {
  const RgbImage image = sample();
  writeImage(path("a.hdr"), {image, {}, {}});
  const RgbImage back = readImage(path("a.hdr"));
  for (size_t i = 0; i < image.count(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(back.rgb(i)[c], image.rgb(i)[c], 0.01f * maxComponent(image.rgb(i)));
}

TEST_F(ImageFile, PngHoldsTheToneMappedCodes) {
  const RgbImage image = sample();
  const ToneMap toneMap(-2);
  writeImage(path("a.png"), {image, {{"Z", std::vector<float>(image.count())}}, {}}, toneMap);
  const RgbImage back = readImage(path("a.png"));
  for (size_t i = 0; i < image.count(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(255 * srgbFromLinear(back.rgb(i)[c])), toneMap.code(image.rgb(i)[c]));
}

TEST_F(ImageFile, PngOfCodesIsThePngOfTheirRadiance) {
  const ToneMap toneMap(1);
  DisplayImage codes;
  toneMap.apply(sample(), codes);
  writeImage(path("a.png"), {sample(), {}, {}}, toneMap);
  writePng(path("b.png"), codes);
  EXPECT_GT(bytesOf("a.png").size(), 60u);
  EXPECT_EQ(bytesOf("a.png"), bytesOf("b.png"));
}

TEST_F(ImageFile, ReplacesTheOldFileOrLeavesIt) {
  writeImage(path("a.exr"), {sample(), {}, {}});
  writeImage(path("a.exr"), {sample(3, 3), {}, {}});
  EXPECT_EQ(readImage(path("a.exr")).width, 3);
  EXPECT_NE(errorOf([&] { writeImage(path("a.exr"), {RgbImage{}, {}, {}}); }), "");
  EXPECT_EQ(readImage(path("a.exr")).width, 3);
  EXPECT_EQ(files(), 1u);
}

// Whichever byte it is that does not fit, the library's last one at its close among them.
TEST_F(ImageFile, ADiskThatIsFullLeavesTheOldFileAndIsToldInOneLine) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : {"a.png", "a.hdr", "a.exr"}) {
    writeImage(path(name), {sample(), {}, {}});
    const uintmax_t whole = fs::file_size(path(name));
    std::ofstream(path(name)) << "old";
    for (const uintmax_t room : {uintmax_t{0}, uintmax_t{20}, whole / 2, whole - 1}) {
      const rlimit small{room, before.rlim_max};
      ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
      const std::string line = errorOf([&] { writeImage(path(name), {sample(), {}, {}}); });
      ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
      EXPECT_EQ(line, "cannot write " + path(name) + ": File too large") << room;
      EXPECT_EQ(fs::file_size(path(name)), 3u) << room;
    }
  }
  ::signal(SIGXFSZ, handler);
  EXPECT_EQ(files(), 3u);
}

TEST_F(ImageFile, RefusesPathsItCannotWriteInOneLine) {
  fs::create_directory(path("folder.exr"));
  for (const std::string& bad : {path("a.jpeg"), path("a"), path("none/a.exr"), path("folder.exr"),
                                 std::string("/proc/a.exr"), std::string()}) {
    const std::string early = errorOf([&] { checkOutputPath(bad); });
    const std::string late = errorOf([&] { writeImage(bad, {sample(), {}, {}}); });
    for (const std::string& line : {early, late}) {
      EXPECT_NE(line.find("cannot write " + bad), std::string::npos) << bad << ": " << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

TEST_F(ImageFile, RefusesFilesItCannotReadInOneLine) {
  write("text.exr", "no picture\n");
  write("text.png", "no picture\n");
  write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 90000 +X 90000\n");
  writeImage(path("whole.exr"), {sample(), {}, {}});
  const std::string whole = bytesOf("whole.exr");
  write("half.exr", whole.substr(0, whole.size() / 2));
  write("tiff.exr", std::string("II*\0\x08\0\0\0", 8));
  for (const char* name :
       {"none.exr", "text.exr", "text.png", "huge.hdr", "half.exr", "tiff.exr"}) {
    const std::string line = errorOf([&] { readImage(path(name)); });
    EXPECT_NE(line.find("cannot read image " + path(name)), std::string::npos) << name << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

// A library would take gigabytes by these numbers alone.
TEST_F(ImageFile, AnExrThatClaimsMoreThanItHoldsIsRefusedBeforeItIsOpened) {
  writeImage(path("a.exr"), {sample(2, 2), {}, {{"scene", "table_room.glb"}}});
  const auto complaint = [&](const std::string& attribute, size_t at, std::string_view claim) {
    std::string bytes = bytesOf("a.exr");
    bytes.replace(bytes.find(attribute) + attribute.size() + at, claim.size(), claim);
    write("claim.exr", bytes);
    return errorOf([&] { readImage(path("claim.exr")); });
  };
  using namespace std::string_view_literals;
  const std::string window("dataWindow\0box2i\0", 17), scene("ninefold:scene\0string\0", 22);
  EXPECT_NE(complaint(window, 4 + 8, "\xff\x3f\0\0\xff\x3f\0\0"sv)
                .find("bytes cannot hold 16384 x 16384 pixels"),
            std::string::npos);
  EXPECT_NE(complaint(scene, 0, "\0\0\0\x70"sv).find("ends in its attribute ninefold:scene"),
            std::string::npos);
  const std::string tiles("tiles\0tiledesc\0", 15);
  const auto tiled = libraryImage("exr", 3, OIIO::TypeDesc::HALF, {}, 4);
  write("a.exr", std::string(tiled.begin(), tiled.end()));
  EXPECT_NE(
      complaint(tiles, 4, "\0\x40\0\0\0\x40\0\0"sv).find("bytes cannot hold 16384 x 16384 pixels"),
      std::string::npos);
}

}  // namespace
}  // namespace ninefold
