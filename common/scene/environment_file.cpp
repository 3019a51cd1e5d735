#include "common/scene/environment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/base/command_line.h"
#include "common/base/log.h"
#include "common/image/image_file.h"

namespace ninefold {
namespace {

constexpr double kMostRotation = 360, kMostStrength = 1e6;

// Where the file's name ends: behind the last ".hdr" or ".exr" that a colon or nothing follows.
size_t endOfName(const std::string& value) {
  std::string lower = value;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  size_t end = 0;
  for (const char* extension : {".hdr", ".exr"})
    for (size_t at = lower.find(extension); at != std::string::npos;
         at = lower.find(extension, at + 1))
      if (at + 4 == lower.size() || lower[at + 4] == ':') end = std::max(end, at + 4);
  return end;
}

RgbImage halved(const RgbImage& image) {
  RgbImage half;
  half.reset(image.width / 2, image.height / 2);
  const auto fold = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (int y = 0; y < half.height; ++y)
      for (int x = 0; x < half.width; ++x) {
        const size_t a = image.at(2 * x, 2 * y), b = image.at(2 * x, 2 * y + 1);
        to[half.at(x, y)] =
            0.25f * from[a] + 0.25f * from[a + 1] + 0.25f * from[b] + 0.25f * from[b + 1];
      }
  };
  fold(image.pixels.r, half.pixels.r);
  fold(image.pixels.g, half.pixels.g);
  fold(image.pixels.b, half.pixels.b);
  return half;
}

void checkShape(int width, int height) {
  if (width < 2 || width != 2 * height)
    fail("{} x {} pixels: a picture of all directions is twice as wide as high", width, height);
}

// Holds values to what an environment may have.
void clean(RgbImage& image) {
  size_t negative = 0;
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    for (size_t i = 0; i < plane->size(); ++i) {
      float& value = (*plane)[i];
      if (!(std::abs(value) <= kBrightestTexel))
        fail("pixel ({}, {}) is {}, must be a number up to {:g}: mend the picture",
             i % static_cast<size_t>(image.width), i / static_cast<size_t>(image.width), value,
             kBrightestTexel);
      if (value < 0) value = 0, ++negative;
    }
  if (negative > 0) warn("{} values of the environment are negative: taken as 0", negative);
}

EnvironmentPicture pictureOf(const EnvironmentFile& file) try {
  RgbImage image = readImage(
      file.path, {kWidestEnvironmentFile, kWidestEnvironmentFile * kWidestEnvironmentFile / 2});
  checkShape(image.width, image.height);
  clean(image);
  while (image.width > kWidestEnvironment) {
    if (image.height % 2 != 0)
      fail("{} rows cannot be halved: scale it to {} x {}", image.height, kWidestEnvironment,
           kWidestEnvironment / 2);
    log("environment: {} x {} pixels become half as many each way", image.width, image.height);
    image = halved(image);
  }
  EnvironmentPicture picture;
  picture.name = fmt::format("--environment FILE:{}:{}", file.rotation, file.strength);
  picture.width = image.width, picture.height = image.height;
  picture.rotation = static_cast<float>(file.rotation * kDegree);
  picture.texels.reserve(image.count());
  for (size_t i = 0; i < image.count(); ++i) picture.texels.push_back(image.rgb(i));
  return picture;
} catch (const Error& e) {
  const std::string what = e.what();
  if (what.find(file.path) != std::string::npos) throw;
  fail("{}: {}", file.path, what);
}

}  // namespace

bool namesPicture(const std::string& value) { return endOfName(value) > 0; }

EnvironmentFile parseEnvironmentFile(const std::string& value) {
  const size_t end = endOfName(value);
  EnvironmentFile file{value.substr(0, end)};
  if (end == value.size()) return file;
  try {
    const std::vector<double> n = parseNumbers("environment", value.substr(end + 1), ':');
    if (n.size() > 2) failUsage("too many numbers");
    file.rotation = checkRange("environment", n[0], -kMostRotation, kMostRotation);
    if (n.size() == 2) file.strength = checkRange("environment", n[1], 0.0, kMostStrength);
  } catch (const UsageError&) {
    failUsage(
        "--environment {}: write FILE[:ROTATION[:STRENGTH]], degrees from {:g} to {:g}, then 0 to "
        "{:g}",
        value, -kMostRotation, kMostRotation, kMostStrength);
  }
  return file;
}

std::shared_ptr<const EnvironmentMap> readEnvironment(const EnvironmentSource& source) {
  if (const auto* file = std::get_if<EnvironmentFile>(&source))
    return std::make_shared<const EnvironmentMap>(pictureOf(*file));
  if (const auto* sky = std::get_if<SkyModel>(&source))
    return std::make_shared<const EnvironmentMap>(skyPicture(*sky));
  return nullptr;
}

float strengthOf(const EnvironmentSource& source) {
  const auto* file = std::get_if<EnvironmentFile>(&source);
  return file != nullptr ? static_cast<float>(file->strength) : 1.0f;
}

}  // namespace ninefold
