// ninefold-compare IMAGE REFERENCE [--json]: how far an image is from a reference.
// Exit status: 0 compared, 1 an image cannot be read or the sizes differ, 2 wrong usage.

#include <fmt/core.h>

#include <boost/program_options.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/base/error.h"
#include "common/image/image_file.h"
#include "common/image/metrics.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

constexpr const char* kUsage =
    "usage: ninefold-compare IMAGE REFERENCE [--json]\n"
    "\n"
    "Tells how far IMAGE is from REFERENCE (.exr, .hdr, .png; PNG is decoded from sRGB).\n"
    "\n"
    "  rmse            root of the mean squared difference, over pixels and R, G, B\n"
    "  rmse_percent    rmse in percent of the reference's mean\n"
    "  relmse          mean of (x-r)^2/(r^2+0.01), both divided by the reference's mean luminance\n"
    "  relmse_trimmed  the same without the 0.1 % of pixels that differ most\n"
    "  bias            (mean x - mean r)/mean r of R, G, B\n"
    "  ssim            structural similarity as the eye sees the images; 1 = equal\n"
    "  worst_pixel     the pixel with the largest part in relmse; (0, 0) is top left\n"
    "  non_finite      pixels with infinite or undefined values; they are left out of all the "
    "rest\n"
    "\n";

struct Options {
  std::string image, reference;
  bool json = false, help = false;
};

po::options_description describe(Options& options) {
  po::options_description visible("Options");
  visible.add_options()("json", po::bool_switch(&options.json), "write one JSON object")(
      "help,h", po::bool_switch(&options.help), "show this text");
  return visible;
}

// Throws po::error for wrong usage.
void parse(int argc, char** argv, const po::options_description& visible, Options& options) {
  po::options_description all;
  all.add(visible).add_options()("image", po::value(&options.image))("reference",
                                                                     po::value(&options.reference));
  po::positional_options_description places;
  places.add("image", 1).add("reference", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(places).run(), values);
  po::notify(values);
  if (!options.help && options.reference.empty()) throw po::error("IMAGE and REFERENCE are needed");
}

nlohmann::ordered_json pixelJson(Vec3 rgb) { return {rgb.x, rgb.y, rgb.z}; }

// Figures without a value (NaN) become null.
nlohmann::ordered_json toJson(const Metrics& m) {
  return {{"rmse", m.rmse},
          {"rmse_percent", m.rmsePercent},
          {"relmse", m.relMse},
          {"relmse_trimmed", m.relMseTrimmed},
          {"bias", {m.bias[0], m.bias[1], m.bias[2]}},
          {"ssim", m.ssim},
          {"worst_pixel",
           {{"x", m.worst.x},
            {"y", m.worst.y},
            {"image", pixelJson(m.worst.image)},
            {"reference", pixelJson(m.worst.reference)},
            {"relmse", m.worst.relMse}}},
          {"non_finite", {{"image", m.nonFiniteImage}, {"reference", m.nonFiniteReference}}}};
}

std::string figure(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }
std::string pixelText(Vec3 rgb) {
  return fmt::format("({:.4g} {:.4g} {:.4g})", rgb.x, rgb.y, rgb.z);
}

std::string toTable(const Metrics& m) {
  const WorstPixel& w = m.worst;
  return fmt::format(
      "rmse            {}\n"
      "rmse_percent    {}\n"
      "relmse          {}\n"
      "relmse_trimmed  {}\n"
      "bias            {} {} {}\n"
      "ssim            {}\n"
      "worst_pixel     ({}, {}): {}, reference {}, relmse {}\n"
      "non_finite      {} in the image, {} in the reference\n",
      figure(m.rmse), figure(m.rmsePercent), figure(m.relMse), figure(m.relMseTrimmed),
      figure(m.bias[0]), figure(m.bias[1]), figure(m.bias[2]), figure(m.ssim), w.x, w.y,
      pixelText(w.image), pixelText(w.reference), figure(w.relMse), m.nonFiniteImage,
      m.nonFiniteReference);
}

int run(int argc, char** argv) {
  Options options;
  const po::options_description visible = describe(options);
  try {
    parse(argc, argv, visible, options);
  } catch (const po::error& error) {
    fmt::print(stderr, "ninefold-compare: {}; see ninefold-compare --help\n", error.what());
    return 2;
  }
  if (options.help) {
    std::cout << kUsage << visible;
    return 0;
  }
  const RgbImage image = readImage(options.image), reference = readImage(options.reference);
  const Metrics metrics = compareImages(image, reference);
  std::cout << (options.json ? toJson(metrics).dump(2) + "\n" : toTable(metrics));
  return 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  try {
    return ninefold::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ninefold-compare: {}\n", error.what());
    return 1;
  }
}
