// ninefold-compare IMAGE REFERENCE [--json]: how far an image is from a reference.
// Exit status: 0 compared, 1 an image cannot be read, the sizes differ or the figures cannot be
// written, 2 wrong usage.

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/image/image_file.h"
#include "common/image/metrics.h"
#include "tools/command.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

constexpr const char* kAbout =
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
    "rest\n";

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
  std::string image, reference;
  bool json = false;
  Command command{"ninefold-compare", "IMAGE REFERENCE [--json]", kAbout};
  command.words = {{"IMAGE", &image}, {"REFERENCE", &reference}};
  command.flags.add_options()("json", po::bool_switch(&json), "write one JSON object");
  if (!parseCommandLine(argc, argv, command)) return 0;
  const Metrics metrics = compareImages(readImage(image), readImage(reference));
  writeOutput(json ? toJson(metrics).dump(2) + "\n" : toTable(metrics));
  return 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-compare", [&] { return ninefold::run(argc, argv); });
}
