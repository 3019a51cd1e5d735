#include "common/scene/ies_file.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/error.h"
#include "common/scene/text_lines.h"

namespace ninefold {
namespace {

constexpr double kBrightest = 1e12;  // [cd]

// The text of a file, line by line at first, then number by number.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.find('\0') != std::string_view::npos)
      fail("not a text file: it has zero bytes; if it is UTF-16, save it as UTF-8");
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  // False at the end.
  bool nextLine(std::string_view& line) {
    if (rest_.empty()) return false;
    const size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line = rest_.substr(0, length);
    rest_.remove_prefix(length);
    skipLineEnd();
    return true;
  }

  // The next number; `what` names it.
  double number(const char* what) {
    const std::string_view word = nextWord();
    if (word.empty()) fail("line {}: the file ends before {}: it is truncated", line_, what);
    const auto value = finiteNumber(word);
    if (!value) fail("line {}: {} is '{}', which is no number", line_, what, word.substr(0, 40));
    return *value;
  }

  double numberFrom(const char* what, double low, double high) {
    const double value = number(what);
    if (!(value >= low && value <= high))
      fail("line {}: {} is {:g}, must be {:g} to {:g}", line_, what, value, low, high);
    return value;
  }

  size_t count(const char* what, size_t low, size_t high) {
    const double value = numberFrom(what, static_cast<double>(low), static_cast<double>(high));
    if (value != std::floor(value)) fail("line {}: {} is {}, no whole number", line_, what, value);
    return static_cast<size_t>(value);
  }

  void expectEnd() {
    if (const std::string_view word = nextWord(); !word.empty() && word != "\x1A")
      fail("line {}: '{}' is more than the file says that it has: its counts are wrong", line_,
           word.substr(0, 40));
  }

  uint64_t line() const { return line_; }

 private:
  static bool isBlank(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

  void skipLineEnd() {
    if (rest_.empty()) return;
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    ++line_;
  }

  std::string_view nextWord() {
    while (!rest_.empty() && isBlank(rest_.front())) {
      if (rest_.front() == '\r' || rest_.front() == '\n')
        skipLineEnd();
      else
        rest_.remove_prefix(1);
    }
    const auto end = std::ranges::find_if(rest_, isBlank);
    const auto length = static_cast<size_t>(end - rest_.begin());
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }

  std::string_view rest_;
  uint64_t line_ = 1;  // of what comes next, or of the word that was read last
};

// Up to the line TILT=..., whose value it returns; before1995: what the first line says.
std::string tiltOf(Words& words, bool& before1995) {
  std::string_view line;
  before1995 = true;
  for (bool first = true; words.nextLine(line); first = false) {
    line = trimmed(line);
    const std::string lower = lowerCase(line.substr(0, 6));
    if (first && (lower == "iesna:" || lower.starts_with("ies:"))) before1995 = false;
    if (lower.starts_with("tilt=")) return lowerCase(trimmed(line.substr(5, 200)));
  }
  fail("not a photometric file: it has no line TILT=; IES LM-63 files are read");
}

void skipTilt(Words& words) {
  words.count("the lamp's place in TILT", 1, 3);
  const size_t pairs = words.count("the number of angles in TILT", 1, kMaxIesAngles);
  for (size_t i = 0; i < pairs; ++i) words.numberFrom("an angle in TILT", 0, 180);
  for (size_t i = 0; i < pairs; ++i) words.numberFrom("a factor in TILT", 0, 1e6);
}

void expectTypeC(Words& words) {
  const size_t type = words.count("the photometric type", 1, 3);
  if (type != 1)
    fail("line {}: photometry of type {}, only type C is read: convert the file to type C",
         words.line(), type == 2 ? "B" : "A");
}

std::vector<double> readAngles(Words& words, size_t count, const char* what) {
  std::vector<double> angles;
  for (size_t i = 0; i < count; ++i) {
    angles.push_back(words.numberFrom(what, 0, 360));
    if (i > 0 && !(static_cast<float>(angles[i]) > static_cast<float>(angles[i - 1])))
      fail("line {}: {} is {} after {}: angles must ascend", words.line(), what, angles[i],
           angles[i - 1]);
  }
  return angles;
}

void checkVertical(const Words& words, const std::vector<double>& angles) {
  const double first = angles.front(), last = angles.back();
  const bool known = (first == 0 && (last == 90 || last == 180)) || (first == 90 && last == 180);
  if (!known)
    fail(
        "line {}: vertical angles go from {} to {}, must be 0 to 90, 90 to 180 or 0 to 180: add "
        "rows of 0 candela",
        words.line(), first, last);
}

// A column of the whole table: its angle, and which of the file's it is, or lies between.
struct Column {
  double angle = 0;
  size_t a = 0, b = 0;
  float share = 0;  // of b
};

// Goes on with the mirror image behind the last angle, which is the mirror.
void addMirrored(std::vector<Column>& columns) {
  const double mirror = columns.back().angle;
  for (size_t i = columns.size() - 1; i-- > 0;) {
    Column image = columns[i];
    image.angle = 2 * mirror - image.angle;
    columns.push_back(image);
  }
}

// From 90 to 450 degrees: from 0 to 360, with a column there.
void beginAtZero(std::vector<Column>& columns) {
  columns.pop_back();  // 450 is 90 again
  const auto beyond = std::ranges::find_if(columns, [](const Column& c) { return c.angle >= 360; });
  for (auto column = beyond; column != columns.end(); ++column) column->angle -= 360;
  std::rotate(columns.begin(), beyond, columns.end());
  Column zero = columns.front();
  if (zero.angle > 0) {
    const Column& last = columns.back();
    zero.share = static_cast<float>((360 - last.angle) / (360 - last.angle + zero.angle));
    zero.b = zero.a, zero.a = last.a, zero.angle = 0;
    columns.insert(columns.begin(), zero);
  }
  zero.angle = 360;
  columns.push_back(zero);
}

std::vector<Column> wholeTurn(const Words& words, const std::vector<double>& angles) {
  std::vector<Column> columns;
  for (size_t j = 0; j < angles.size(); ++j) columns.push_back({angles[j], j, j});
  const double first = angles.front(), last = angles.back();
  if (first == 0 && last == 0) {
    columns.push_back({360});
  } else if (first == 0 && (last == 90 || last == 180 || last == 360)) {
    while (columns.back().angle < 360) addMirrored(columns);
  } else if (first == 90 && last == 270) {
    addMirrored(columns);
    beginAtZero(columns);
  } else {
    fail("line {}: horizontal angles go from {} to {}, must be 0 alone or 0 to 90, 180 or 360",
         words.line(), first, last);
  }
  return columns;
}

// The whole table, row by row, as shares of the largest value.
void fillProfile(const std::vector<double>& vertical, const std::vector<Column>& columns,
                 const std::vector<float>& candela, float most, LightProfile& p) {
  const size_t rows = vertical.size();
  for (const double angle : vertical) p.vertical.push_back(static_cast<float>(angle));
  for (const Column& column : columns) p.horizontal.push_back(static_cast<float>(column.angle));
  p.values.reserve(rows * columns.size());
  for (size_t i = 0; i < rows; ++i)
    for (const Column& c : columns) {
      const float a = candela[c.a * rows + i], b = candela[c.b * rows + i];
      p.values.push_back(most > 0 ? std::min((a + c.share * (b - a)) / most, 1.0f) : 0.0f);
    }
}

}  // namespace

IesFile readIes(std::string_view text) {
  IesFile file;
  Words words(text);
  bool before1995 = true;
  const std::string tilt = tiltOf(words, before1995);
  file.tilts = tilt != "none";
  if (tilt == "include") skipTilt(words);

  const size_t lamps = words.count("the number of lamps", 0, 1'000'000);
  const double lumens = words.number("the lumens of a lamp");
  const double factor = words.numberFrom("the factor of candela", 0, kBrightest);
  const size_t rows = words.count("the number of vertical angles", 2, kMaxIesAngles);
  const size_t given = words.count("the number of horizontal angles", 1, kMaxIesAngles);
  expectTypeC(words);
  words.count("the unit of length", 1, 2);
  for (int i = 0; i < 3; ++i) words.number("the luminous opening");
  double ballast = words.numberFrom("the ballast factor", 0, 1e6);
  const double third = words.number("the ballast-lamp factor");
  if (before1995 && !(third >= 0 && third <= 1e6))
    fail("line {}: the ballast-lamp factor is {}, must be 0 to 1e6", words.line(), third);
  if (before1995) ballast *= third;
  words.number("the input watts");

  const std::vector<double> vertical = readAngles(words, rows, "a vertical angle");
  checkVertical(words, vertical);
  const std::vector<Column> columns =
      wholeTurn(words, readAngles(words, given, "a horizontal angle"));
  if (rows * columns.size() > kMaxIesValues)
    fail("line {}: {} times {} values, more than {}: leave angles out", words.line(), rows,
         columns.size(), kMaxIesValues);

  std::vector<float> candela;  // as in the file
  for (size_t i = 0; i < rows * given; ++i)
    candela.push_back(static_cast<float>(words.numberFrom("a candela value", 0, kBrightest)));
  words.expectEnd();
  const float most = *std::ranges::max_element(candela);
  const double peak = double(most) * factor * ballast;
  if (!(peak <= kBrightest))
    fail("its factors make {:g} cd, more than {:g}: they are damaged", peak, kBrightest);

  fillProfile(vertical, columns, candela, most, file.profile);
  file.peak = static_cast<float>(peak);
  file.lumens = double(most) * factor * solidAngleOf(file.profile);
  if (lumens > 0 && lamps > 0) file.lampLumens = lumens * static_cast<double>(lamps);
  return file;
}

std::string iesText(const LightProfile& p) {
  std::string text = fmt::format(
      "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] unknown\n[OTHER] 1 candela where it is brightest\n"
      "TILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n",
      p.vertical.size(), p.horizontal.size());
  const auto put = [&](float number) { text += fmt::format("{}\n", number); };
  for (const float angle : p.vertical) put(angle);
  for (const float angle : p.horizontal) put(angle);
  for (size_t j = 0; j < p.horizontal.size(); ++j)
    for (size_t i = 0; i < p.vertical.size(); ++i) put(p.at(i, j));
  return text;
}

}  // namespace ninefold
