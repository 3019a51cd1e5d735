#include "common/scene/mtl_map.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "common/scene/text_lines.h"

namespace ninefold {
namespace {

struct Option {
  const char* name;
  size_t most;    // words that may follow
  bool isNumber;  // else any word
};
constexpr Option kOptions[] = {
    {"-s", 3, true},     {"-o", 3, true},       {"-t", 3, true},       {"-mm", 2, true},
    {"-bm", 1, true},    {"-boost", 1, true},   {"-texres", 1, false}, {"-clamp", 1, false},
    {"-cc", 1, false},   {"-blendu", 1, false}, {"-blendv", 1, false}, {"-imfchan", 1, false},
    {"-type", 1, false},
};

const Option* findOption(std::string_view word) {
  const std::string name = lowerCase(word);
  const auto* found = std::find_if(std::begin(kOptions), std::end(kOptions),
                                   [&](const Option& o) { return name == o.name; });
  return found == std::end(kOptions) ? nullptr : found;
}

class Reader {
 public:
  Reader(const FileExists& exists, UnreadKeys& unread, uint64_t line)
      : exists_(&exists), unread_(&unread), line_(line) {}
  MtlMap read(std::string_view rest);

 private:
  std::string_view readOptions(std::string_view rest);
  std::string_view giveBackWords(std::string_view name);
  std::string_view cutTrailingOptions(std::string_view name);
  bool isFile(std::string_view name) const {
    return !trimmed(name).empty() && (*exists_)(fileName(name));
  }
  void apply(const Option& option, const std::vector<std::string_view>& values);
  void applyNumbers(std::string_view name, const std::vector<float>& numbers);

  const FileExists* exists_;
  UnreadKeys* unread_;
  uint64_t line_;
  MtlMap map_;
  const Option* last_ = nullptr;              // the option before the name
  std::vector<std::string_view> lastValues_;  // and its words
};

MtlMap Reader::read(std::string_view rest) {
  std::string_view name = trimmed(readOptions(rest));
  if (!isFile(name)) name = giveBackWords(name);
  if (!isFile(name)) name = trimmed(name.substr(0, name.find(" #")));
  if (!isFile(name)) name = cutTrailingOptions(name);
  map_.file = fileName(name);
  return map_;
}

// What is behind the options at the begin of `rest`.
std::string_view Reader::readOptions(std::string_view rest) {
  for (;;) {
    std::string_view behind = rest;
    const Option* option = findOption(nextWord(behind));
    if (option == nullptr) return rest;
    rest = behind;
    std::vector<std::string_view> values;
    while (values.size() < option->most) {
      const std::string_view word = nextWord(behind);
      if (word.empty() || (option->isNumber && !finiteNumber(word))) break;
      values.push_back(word);
      rest = behind;
    }
    apply(*option, values);
    last_ = option, lastValues_ = std::move(values);
  }
}

// "-s 2 2 1 x.png" may name "x.png", "1 x.png" or "2 1 x.png"; "-clamp x.png" names "x.png".
std::string_view Reader::giveBackWords(std::string_view name) {
  if (last_ == nullptr) return name;
  for (size_t kept = lastValues_.size(); kept-- > 0;) {
    const char* begin = lastValues_[kept].data();
    const std::string_view longer(begin, static_cast<size_t>(name.data() + name.size() - begin));
    if (!isFile(longer)) continue;
    lastValues_.resize(kept);
    apply(*last_, lastValues_);
    return longer;
  }
  return name;
}

// "x.png -s 2 2": from an option's word on, if nothing but options is behind it.
std::string_view Reader::cutTrailingOptions(std::string_view name) {
  for (size_t at = name.find('-', 1); at != name.npos; at = name.find('-', at + 1)) {
    std::string_view tail = name.substr(at);
    if (name[at - 1] > ' ' || findOption(nextWord(tail)) == nullptr) continue;
    Reader behind(*exists_, *unread_, line_);
    behind.map_ = map_;
    if (!trimmed(behind.readOptions(name.substr(at))).empty()) continue;
    map_ = behind.map_;
    return trimmed(name.substr(0, at));
  }
  return name;
}

void Reader::apply(const Option& option, const std::vector<std::string_view>& values) {
  const std::string_view name(option.name);
  if (option.isNumber) {
    std::vector<float> numbers;
    for (const std::string_view v : values) numbers.push_back(static_cast<float>(*finiteNumber(v)));
    applyNumbers(name, numbers);
    return;
  }
  const std::string value = values.empty() ? std::string() : lowerCase(values[0]);
  if (name == "-clamp") map_.clamp = value == "on";
  if (name == "-cc" && value == "on") unread_->add("-cc", line_);
  if (name != "-imfchan") return;
  const bool known = value.size() == 1 && std::string_view("rgbml").find(value) != value.npos;
  if (known) map_.channel = value[0];
  if (!known) unread_->add("-imfchan " + value, line_);
}

void Reader::applyNumbers(std::string_view name, const std::vector<float>& numbers) {
  const auto number = [&](size_t i, float absent) {
    return i < numbers.size() ? numbers[i] : absent;
  };
  if (name == "-s") map_.scale = Vec2(number(0, 1), number(1, 1));
  if (name == "-o") map_.offset = Vec2(number(0, 0), number(1, 0));
  if (name == "-mm") map_.base = number(0, 0), map_.gain = number(1, 1);
  if (name == "-bm") map_.bump = number(0, 1);
  if (name == "-t" && (number(0, 0) != 0 || number(1, 0) != 0)) unread_->add("-t", line_);
}

}  // namespace

std::string fileName(std::string_view text) {
  std::string name(unquoted(text));
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

MtlMap parseMtlMap(std::string_view rest, const FileExists& exists, UnreadKeys& unread,
                   uint64_t line) {
  return Reader(exists, unread, line).read(rest);
}

}  // namespace ninefold
