// Photometric files of all years and symmetries, and what is wrong with the others.
#include "common/scene/ies_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scene/ies_text.h"
#include "tests/scene/one_line_error.h"

namespace ninefold {
namespace {

constexpr double kExactPi = 3.14159265358979323846;

TEST(IesFile, KeepsAnglesAndCandela) {
  IesText file;
  file.vertical = {0, 22.5, 90}, file.horizontal = {0, 120, 360};
  file.candela = [](double v, double h) { return 10 + v + h; };
  const IesFile read = readIes(file.text());
  EXPECT_EQ(read.profile.vertical, (std::vector<float>{0, 22.5f, 90}));
  EXPECT_EQ(read.profile.horizontal, (std::vector<float>{0, 120, 360}));
  EXPECT_EQ(read.peak, 460);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      EXPECT_FLOAT_EQ(read.profile.at(i, j) * read.peak,
                      static_cast<float>(file.candela(file.vertical[i], file.horizontal[j])));
  EXPECT_FALSE(read.tilts);
}

// The third factor is the ballast's until 1991, and something else since.
TEST(IesFile, EveryYearHasItsFactors) {
  struct Case {
    const char* version;
    float peak;
  };
  for (const Case& c : {Case{"", 100 * 2 * 0.5f * 0.8f}, Case{"A lamp\n[of] 1986\n", 80},
                        Case{"IESNA91\n[TEST] 1\n", 80}, Case{"IESNA:LM-63-1995\n", 100},
                        Case{"IESNA:LM-63-2002\n[MORE] x\n", 100}, Case{"IES:LM-63-2019\n", 100}}) {
    IesText file;
    file.version = c.version, file.factor = "2", file.ballast = ".5", file.third = "0.8";
    EXPECT_FLOAT_EQ(readIes(file.text()).peak, c.peak) << c.version;
  }
}

TEST(IesFile, LumensAreTheIntegralAndThoseOfTheLamps) {
  IesText file;
  file.lamps = "3", file.lumens = "500", file.factor = "2", file.ballast = "0.5";
  const IesFile read = readIes(file.text());
  EXPECT_NEAR(read.lumens, 4 * kExactPi * 200, 1e-3);  // of the lamp alone: without the ballast
  EXPECT_EQ(read.lampLumens, 1500);
  EXPECT_FLOAT_EQ(read.peak, 100);
  file.lumens = "-1";
  EXPECT_EQ(readIes(file.text()).lampLumens, std::nullopt);
}

// Symmetric in the planes of 0-180 and 90-270; in the first; in the second.
double quadrant(double v, double h) { return 5 + v + 40 * std::abs(std::sin(h * kExactPi / 180)); }
double half(double v, double h) { return 5 + v + h * (360 - h) / 100; }
double otherHalf(double v, double h) {
  const double from90 = std::fmod(h + 270, 360);
  return 5 + v + from90 * (360 - from90) / 100;
}

TEST(IesFile, SymmetriesGiveWhatTheWholeTableGives) {
  struct Case {
    double first, last;
    double (*candela)(double, double);
  };
  for (const Case& c : {Case{0, 90, quadrant}, Case{0, 180, half}, Case{90, 270, otherHalf}}) {
    IesText file;
    file.vertical = degreesFrom(0, 180, 7.5);
    // Values of mirrored angles may differ in the last digit: rounded, they do not.
    file.candela = [&](double v, double h) { return std::round(1e3 * c.candela(v, h)); };
    file.horizontal = degreesFrom(0, 360, 22.5);
    const IesFile whole = readIes(file.text());
    file.horizontal = degreesFrom(c.first, c.last, 22.5);
    const IesFile part = readIes(file.text());
    EXPECT_EQ(part.profile.horizontal, whole.profile.horizontal) << c.first << ' ' << c.last;
    EXPECT_EQ(part.profile.values, whole.profile.values) << c.first << ' ' << c.last;
    EXPECT_EQ(part.peak, whole.peak);
  }
  IesText file;
  file.candela = [](double v, double) { return v; };
  const IesFile one = readIes(file.text());
  file.horizontal = {0, 360};
  EXPECT_EQ(readIes(file.text()).profile.values, one.profile.values);
}

// 90 to 270 without 180: what is at 0 lies between its neighbours.
TEST(IesFile, ATableFromNinetyIsTurnedToBeginAtZero) {
  IesText file;
  file.horizontal = {90, 170, 200, 270};
  file.candela = [](double, double h) { return h; };
  const LightProfile p = readIes(file.text()).profile;
  EXPECT_EQ(p.horizontal, (std::vector<float>{0, 10, 90, 170, 200, 270, 340, 360}));
  const float scale = 270;
  EXPECT_FLOAT_EQ(scale * p.at(0, 1), 170);  // 370 is 170 in the mirror of 270
  EXPECT_FLOAT_EQ(scale * p.at(0, 6), 200);
  EXPECT_FLOAT_EQ(scale * p.at(0, 0), 180);  // 20 of 30 degrees from 200 to 170
  EXPECT_EQ(p.at(0, 0), p.at(0, 7));
}

TEST(IesFile, VerticalAnglesSayWhereLightGoes) {
  for (const auto& [first, last] : {std::pair{0.0, 90.0}, {90.0, 180.0}, {0.0, 180.0}}) {
    IesText file;
    file.vertical = degreesFrom(first, last, 45);
    const LightProfile p = readIes(file.text()).profile;
    EXPECT_EQ(profileAt(p, 10, 0), first == 0 ? 1 : 0);
    EXPECT_EQ(profileAt(p, 170, 0), last == 180 ? 1 : 0);
  }
}

TEST(IesFile, TiltIsReadAndLeftOut) {
  IesText file;
  file.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1.0 .9 .8\n";
  const IesFile read = readIes(file.text());
  EXPECT_TRUE(read.tilts);
  EXPECT_EQ(read.peak, 100);
  file.tilt = "TILT=C:\\LAMPS\\A.TLT\n";  // the file is not looked for
  EXPECT_TRUE(readIes(file.text()).tilts);
  file.tilt = "  tilt= none \n";
  EXPECT_FALSE(readIes(file.text()).tilts);
}

TEST(IesFile, NumbersStandBetweenBlanksCommasAndLineEndsOfEveryKind) {
  const std::string good = IesText{}.text();
  const LightProfile expected = readIes(good).profile;
  std::string mac = good, dos, commas = good;
  for (char& c : mac) c = c == '\n' ? '\r' : c;
  for (const char c : good) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (size_t i = good.find("TILT=NONE") + 10; i < commas.size(); ++i)
    if (commas[i] == ' ') commas[i] = ',';
  for (const std::string& text :
       {mac, dos, commas, "\xEF\xBB\xBF" + good, good + " \x1A", good + "\n\n\t",
        "IESNA91\n[a path] C:\\lamps\\\n" + good.substr(good.find("TILT"))})
    EXPECT_EQ(readIes(text).profile.values, expected.values) << text;
}

TEST(IesFile, ADarkLampIsDark) {
  IesText file;
  file.candela = [](double, double) { return 0.0; };
  const IesFile read = readIes(file.text());
  EXPECT_EQ(read.peak, 0);
  EXPECT_EQ(read.lumens, 0);
  checkProfile(read.profile, "dark");
}

TEST(IesFile, WhatIsWrongIsSaidInOneLineWithItsPlace) {
  const auto refused = [](auto change, const char* part) {
    IesText file;
    change(file);
    EXPECT_CONTAINS(errorOf([&] { readIes(file.text()); }), part);
  };
  refused([](IesText& f) { f.type = "2"; }, "line 4: photometry of type B, only type C is read");
  refused([](IesText& f) { f.type = "3"; }, "type A");
  refused([](IesText& f) { f.type = "4"; }, "the photometric type is 4");
  refused([](IesText& f) { f.unit = "0"; }, "the unit of length is 0, must be 1 to 2");
  refused([](IesText& f) { f.rows = "-3"; }, "the number of vertical angles is -3");
  refused([](IesText& f) { f.rows = "1e30"; }, "the number of vertical angles is 1e+30");
  refused([](IesText& f) { f.rows = "1000000"; }, "must be 2 to 3601");
  refused([](IesText& f) { f.columns = "2.5"; }, "is 2.5, no whole number");
  refused([](IesText& f) { f.columns = "0"; }, "the number of horizontal angles is 0");
  refused([](IesText& f) { f.rows = "4"; }, "line 7: a vertical angle is 0 after 180");
  refused([](IesText& f) { f.rows = "2"; }, "from 180 to 180, must be 0 alone");
  refused([](IesText& f) { f.lamps = "many"; },
          "the number of lamps is 'many', which is no number");
  refused([](IesText& f) { f.lumens = "nan"; }, "the lumens of a lamp is 'nan'");
  refused([](IesText& f) { f.factor = "-1"; }, "the factor of candela is -1");
  refused([](IesText& f) { f.factor = "inf"; }, "'inf'");
  refused([](IesText& f) { f.ballast = "-1"; }, "the ballast factor is -1");
  refused([](IesText& f) { f.version = "", f.third = "-1"; }, "the ballast-lamp factor is -1");
  refused([](IesText& f) { f.factor = "1e12"; }, "more than 1e+12");
  refused([](IesText& f) { f.vertical = {0, 90, 90}; }, "line 6: a vertical angle is 90 after 90");
  refused([](IesText& f) { f.vertical = {0, 100, 90}; }, "angles must ascend");
  refused([](IesText& f) { f.vertical = {0, 75}; }, "go from 0 to 75, must be 0 to 90");
  refused([](IesText& f) { f.vertical = {-90, 90}; }, "a vertical angle is -90, must be 0 to 360");
  refused([](IesText& f) { f.horizontal = {0, 345}; }, "horizontal angles go from 0 to 345");
  refused([](IesText& f) { f.horizontal = {90}; }, "horizontal angles go from 90 to 90");
  refused([](IesText& f) { f.candela = [](double v, double) { return v - 1; }; },
          "line 8: a candela value is -1");
  refused([](IesText& f) { f.candela = [](double, double) { return NAN; }; }, "'nan'");
  refused([](IesText& f) { f.end = " 100\n"; }, "line 8: '100' is more than the file says");
  refused([](IesText& f) { f.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 \n"; }, "");
  refused([](IesText& f) { f.tilt = "TILT=INCLUDE\n4\n"; }, "the lamp's place in TILT is 4");
  refused([](IesText& f) { f.tilt = "TILT=INCLUDE\n1 99999999\n"; },
          "the number of angles in TILT");
  refused([](IesText& f) { f.tilt = ""; }, "it has no line TILT=");
}

TEST(IesFile, WhatIsNoPhotometricFileIsSaidToBeNone) {
  const auto error = [](std::string_view text) { return errorOf([&] { readIes(text); }); };
  EXPECT_CONTAINS(error(""), "not a photometric file");
  EXPECT_CONTAINS(error("IESNA:LM-63-2002"), "not a photometric file");
  EXPECT_CONTAINS(error(std::string_view("I\0E\0S\0", 6)), "zero bytes");
  EXPECT_CONTAINS(error("\x89PNG\r\n\x1A\n\xFF"), "not a photometric file");
  EXPECT_CONTAINS(error("TILT=NONE"), "the file ends before the number of lamps: it is truncated");
}

// Cut anywhere, a file is an error; none of them is taken for a whole one.
TEST(IesFile, CutAnywhereItIsRefused) {
  IesText file;
  file.horizontal = {0, 90}, file.candela = [](double, double) { return 5.0; };
  const std::string text = file.text();
  const size_t last = text.find_last_of('5');
  for (size_t length = 0; length < last; ++length)
    errorOf([&] { readIes(text.substr(0, length)); });
}

// A claim of 13 million values costs nothing: they are counted before any is read.
TEST(IesFile, ClaimsAreCheckedBeforeMemoryIsTaken) {
  IesText file;
  file.vertical = degreesFrom(0, 180, 0.0625), file.horizontal = degreesFrom(0, 360, 0.125);
  file.rows = std::to_string(file.vertical.size());
  file.candela = [](double, double) { return 1.0; };
  IesText head = file;
  head.horizontal = {};
  head.columns = std::to_string(file.horizontal.size());
  std::string text = head.text();
  for (const double h : file.horizontal) text += std::to_string(h) + ' ';
  EXPECT_CONTAINS(errorOf([&] { readIes(text); }), "2881 times 2881 values, more than 1048576");
}

TEST(IesFile, WhatIsWrittenIsReadAgain) {
  IesText file;
  file.vertical = degreesFrom(0, 90, 4.5), file.horizontal = degreesFrom(0, 90, 7.5);
  file.candela = [](double v, double h) { return 1 / (3 + v + h / 7); };
  const LightProfile p = readIes(file.text()).profile;
  const IesFile again = readIes(iesText(p));
  EXPECT_EQ(again.profile.vertical, p.vertical);
  EXPECT_EQ(again.profile.horizontal, p.horizontal);
  EXPECT_EQ(again.profile.values, p.values);
  EXPECT_EQ(again.peak, 1);
}

}  // namespace
}  // namespace ninefold
