// What --help tells.
#include <gtest/gtest.h>

#include <sstream>

#include "common/scene/methods.h"
#include "master/options/options.h"

namespace ninefold {
namespace {

// Range, default and what presets make of it come from where they are used.
TEST(OptionsHelp, TellsRangesAndDefaults) {
  std::istringstream words(helpText());  // however its lines are broken
  std::string help;
  for (std::string word; words >> word;) help += word + " ";
  for (const char* text : {
           "pixels, each 1 to 16384 (default 640x480)",
           "instant-radiosity (default)",
           "light sets side by side, each 1 to 16 (default 3x3; segovia 1x1)",
           "per set, 0 to 65536 (default 4; final 16; segovia 6)",
           "mean per set, 0 to 65536 (default 18; final 72; segovia 24)",
           "caustic photons per set, 0 to 16777216 (default 1000; final 10000)",
           "0 = no limit (default 0; paper 4)",
           "in a row at most, 1 to 1024 (default 32)",
           "as published (default balance; segovia equal)",
           "b = C/R^2, above 0 (default 30; paper 300)",
           "0 = none (default 4; paper 0)",
           "as a fraction of R, up to 1 (default 0.02)",
           "from lit surfaces too (default all; paper direct)",
           "pseudo-random points (default owen; paper xor)",
           "of all randomness (default 1)",
       })
    EXPECT_NE(help.find(text), std::string::npos) << text << " in " << help;
  EXPECT_NE(help.find(describeMethods()), std::string::npos) << help;
}

TEST(OptionsHelp, NamesEveryFlagOfTheInterface) {
  const std::string help = helpText();
  for (const char* flag :
       {"size",           "camera",      "local-clients", "client-threads", "listen",
        "key-file",       "new-key",     "wait-clients",  "method",         "preset",
        "interleave",     "direct-vpls", "indirect-vpls", "photons",        "path-length",
        "specular-depth", "bound",       "photon-radius", "caustics",       "environment",
        "frames",         "seconds",     "until-error",   "animate",        "output",
        "aovs",           "exposure",    "view",          "window",         "headless",
        "seed",           "isa",         "stats",         "randomization",  "filter",
        "vpl-roulette",   "denoise",     "script",        "frame-time",     "help",
        "light-units",    "tone-map",    "sky",           "clip",           "photon-scene",
        "serve",          "serve-key"})
    EXPECT_NE(help.find("--" + std::string(flag) + " "), std::string::npos) << flag;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(OptionsHelp, TellsWhatStatusesMean) {
  for (const char* status : {"0 done", "1 a failure", "2 wrong usage", "143 SIGTERM", "129 SIGHUP"})
    EXPECT_NE(helpText().find(status), std::string::npos) << status;
}

}  // namespace
}  // namespace ninefold
