#include "common/scene/settings_table.h"

#include <gtest/gtest.h>

#include <set>

namespace ninefold {
namespace {

// Another value that the row allows.
int changed(int value) { return value + 1; }
uint64_t changed(uint64_t value) { return value + 1; }
float changed(float value) { return value == 0 ? 0.5f : 0.5f * value; }
bool changed(bool value) { return !value; }
Interleave changed(Interleave value) { return {value.n + 1, value.m + 1}; }
Radiance changed(Radiance value) { return value + Radiance(1, 2, 3); }
Camera changed(Camera value) {
  value.name += "x", value.eye.x += 1, value.verticalFov *= 0.5f;
  return value;
}
template <typename Enum>
requires std::is_enum_v<Enum> Enum changed(Enum value) {
  return static_cast<Enum>((static_cast<size_t>(value) + 1) % namesOf(value).size());
}

template <typename T>
std::string refusal(const Setting<T>& row, const T& value) {
  try {
    if constexpr (std::is_enum_v<T>)
      checkRange(row, static_cast<uint64_t>(value));
    else if constexpr (requires { checkRange(row, value); })
      checkRange(row, value);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// As many rows as members (settings_table.cpp asserts it), and each the row of another member: then
// every member has its row.
TEST(SettingsTable, EachRowIsAboutAMemberOfItsOwn) {
  std::set<std::string> names;
  forEachSetting([&](const auto& row) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
    Settings other;
    other.*row.member = changed(other.*row.member);
    EXPECT_FALSE(other == Settings{}) << row.name;
    forEachSetting([&](const auto& each) {
      const bool isSame = other.*each.member == Settings{}.*each.member;
      EXPECT_EQ(isSame, std::string(each.name) != row.name) << row.name << ", " << each.name;
    });
  });
}

TEST(SettingsTable, DefaultsAndTheirNeighboursAreInRange) {
  forEachSetting([](const auto& row) {
    const auto value = Settings{}.*row.member;
    EXPECT_EQ(refusal(row, value), "");
    EXPECT_EQ(refusal(row, changed(value)), "");
  });
}

// Ends of ranges count as inside, as the floats that they become, too; what is just beyond is
// refused by its name, and so is what is no number.
TEST(SettingsTable, RangesEndWhereTheySay) {
  forEachSetting([]<typename T>(const Setting<T>& row) {
    const auto isNamed = [&](const T& value) {
      return refusal(row, value).find(row.name) != std::string::npos;
    };
    if constexpr (std::is_same_v<T, int>) {
      EXPECT_EQ(refusal(row, static_cast<int>(row.low)), "");
      EXPECT_EQ(refusal(row, static_cast<int>(row.high)), "");
      EXPECT_TRUE(isNamed(static_cast<int>(row.low) - 1)) << row.name;
      EXPECT_TRUE(isNamed(static_cast<int>(row.high) + 1)) << row.name;
      EXPECT_GE(row.low, 0) << "on the wire, numbers have no sign";
    }
    if constexpr (std::is_same_v<T, float>) {
      const auto low = static_cast<float>(row.low), high = static_cast<float>(row.high);
      EXPECT_EQ(refusal(row, low), "");
      EXPECT_EQ(refusal(row, high), "");
      EXPECT_TRUE(isNamed(std::nextafter(low, -1.0f))) << row.name;
      EXPECT_TRUE(isNamed(std::nextafter(high, INFINITY))) << row.name;
      EXPECT_TRUE(isNamed(NAN)) << row.name;
    }
    if constexpr (std::is_enum_v<T>) {
      EXPECT_EQ(refusal(row, static_cast<T>(namesOf(T{}).size() - 1)), "");
      EXPECT_TRUE(isNamed(static_cast<T>(namesOf(T{}).size()))) << row.name;
    }
  });
  const auto refused = [](Interleave i) {
    return refusal(settingOf(&Settings::interleave), i) != "";
  };
  EXPECT_FALSE(refused({1, 16}));
  EXPECT_TRUE(refused({0, 16}));
  EXPECT_TRUE(refused({1, 17}));
}

TEST(SettingsTable, UnitsAreNamed) {
  EXPECT_EQ(refusal(settingOf(&Settings::photonRadius), 2.0f),
            "photon-radius is 2, must be 1e-06 to 1 R");
  EXPECT_EQ(refusal(settingOf(&Settings::indirectVpls), -1),
            "indirect-vpls is -1, must be 0 to 65536");
}

// Sliders reach values that the range allows; the panel draws none of the other types.
TEST(SettingsTable, SlidersKeepToTheRange) {
  int sliders = 0;
  forEachSetting([&]<typename T>(const Setting<T>& row) {
    if (row.slider.label == nullptr) return;
    ++sliders;
    constexpr bool isNumber =
        std::is_same_v<T, int> || std::is_same_v<T, float> || std::is_same_v<T, Interleave>;
    constexpr bool isDrawn = isNumber || std::is_same_v<T, bool> || std::is_enum_v<T>;
    EXPECT_TRUE(isDrawn) << row.name;
    if (!isNumber) return;
    EXPECT_LT(row.slider.low, row.slider.high) << row.name;
    EXPECT_GE(row.slider.low, row.low) << row.name;
    EXPECT_LE(row.slider.high, row.high) << row.name;
  });
  EXPECT_GT(sliders, 0);
}

// What is about a part of light is of no use to methods without it.
TEST(SettingsTable, MethodsUseWhatIsAboutTheirLight) {
  for (const MethodFacts& facts : allMethods()) {
    EXPECT_EQ(settingOf(&Settings::photons).isUsedBy(facts.method), facts.has(kCausticPhotons));
    EXPECT_EQ(settingOf(&Settings::indirectVpls).isUsedBy(facts.method), facts.has(kIndirectVpls));
    EXPECT_EQ(settingOf(&Settings::bound).isUsedBy(facts.method), (facts.parts & kVpls) != 0);
    EXPECT_TRUE(settingOf(&Settings::seed).isUsedBy(facts.method));
  }
}

// Shortest text that reads as the same float.
TEST(SettingsTable, TextsAreWhatFlagsTake) {
  EXPECT_EQ(textOf(0.02f), "0.02");
  EXPECT_EQ(textOf(300.0f), "300");
  EXPECT_EQ(textOf(Interleave{2, 4}), "2x4");
  EXPECT_EQ(textOf(Radiance(0.5f, 1, 2)), "0.5,1,2");
  EXPECT_EQ(textOf(Caustics::direct), "direct");
  EXPECT_EQ(textOf(Randomization::exclusiveOr), "xor");
  EXPECT_EQ(textOf(~uint64_t{0}), "18446744073709551615");
  for (uint32_t i = 0; i < 1000; ++i) {
    const float x = std::ldexp(1.0f + static_cast<float>(i * 8380u) * 0x1p-23f, i % 40 - 20);
    EXPECT_EQ(static_cast<float>(std::stod(textOf(x))), x);
  }
}

}  // namespace
}  // namespace ninefold
