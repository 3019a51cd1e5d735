// Settings that are each within range, and too much together for a method with reverse VPLs.
#include "common/scene/settings_check.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

// What is said against settings of the method; empty: nothing.
std::string refusal(const MethodFacts& facts, const std::function<void(Settings&)>& spoil) {
  Settings s;
  s.method = facts.method;
  spoil(s);
  try {
    checkTogether(s);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SettingsCheck, SaysWhatIsTooMuchAndWhatToLower) {
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"lower --resampling", [](Settings& s) { s.resampling = 1000, s.directVpls = 65536; }},
      {"lower --camera-points", [](Settings& s) { s.directVpls = 20000, s.cameraPoints = 4096; }},
      {"path-length is 65", [](Settings& s) { s.pathLength = 65; }},
  };
  for (const MethodFacts& facts : allMethods())
    for (const auto& [text, spoil] : cases) {
      const std::string said = refusal(facts, spoil);
      if (facts.has(kReverseVpls))
        EXPECT_NE(said.find(text), std::string::npos) << facts.name << ": " << said;
      else
        EXPECT_EQ(said, "") << facts.name;
    }
}

TEST(SettingsCheck, TakesWhatIsUsual) {
  for (const MethodFacts& facts : allMethods()) {
    EXPECT_EQ(refusal(facts, [](Settings&) {}), "") << facts.name;
    EXPECT_EQ(refusal(facts, [](Settings& s) { s.resampling = 100, s.pathLength = 64; }), "");
  }
}

}  // namespace
}  // namespace ninefold
