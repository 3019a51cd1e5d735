#include "common/scene/mtl_file.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/log.h"
#include "common/math/units.h"
#include "common/scene/text_lines.h"

namespace ninefold {
namespace {

struct ColourKey {
  const char* key;
  std::optional<Vec3> MtlMaterial::*value;
};
constexpr ColourKey kColours[] = {
    {"kd", &MtlMaterial::Kd}, {"ks", &MtlMaterial::Ks}, {"ke", &MtlMaterial::Ke},
    {"ka", &MtlMaterial::Ka}, {"tf", &MtlMaterial::Tf}, {"kt", &MtlMaterial::Tf},
};

struct NumberKey {
  const char* key;
  std::optional<float> MtlMaterial::*value;
};
constexpr NumberKey kNumbers[] = {
    {"ns", &MtlMaterial::Ns},       {"ni", &MtlMaterial::Ni}, {"d", &MtlMaterial::d},
    {"tr", &MtlMaterial::Tr},       {"pr", &MtlMaterial::Pr}, {"pm", &MtlMaterial::Pm},
    {"ps", &MtlMaterial::Ps},       {"pc", &MtlMaterial::Pc}, {"pcr", &MtlMaterial::Pcr},
    {"illum", &MtlMaterial::illum},
};

struct MapKey {
  const char* key;
  MtlMap MtlMaterial::*value;
};
constexpr MapKey kMaps[] = {
    {"map_kd", &MtlMaterial::mapKd}, {"map_ks", &MtlMaterial::mapKs},
    {"map_ke", &MtlMaterial::mapKe}, {"map_d", &MtlMaterial::mapD},
    {"map_pr", &MtlMaterial::mapPr}, {"map_pm", &MtlMaterial::mapPm},
    {"norm", &MtlMaterial::norm},    {"map_norm", &MtlMaterial::norm},
    {"bump", &MtlMaterial::bump},    {"map_bump", &MtlMaterial::bump},
};

// Exporters write these for every material. At zero anisotropy says nothing; its angle says nothing
// alone.
constexpr const char* kNothingAtZero = "aniso";
constexpr const char* kNothingAlone = "anisor";

template <typename Table>
auto find(const Table& table, const std::string& key) {
  const auto* end = std::end(table);
  const auto* found =
      std::find_if(std::begin(table), end, [&](const auto& e) { return key == e.key; });
  return found == end ? nullptr : found;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, const FileExists& exists)
      : lines_(text), file_(&file), exists_(&exists) {}
  std::vector<MtlMaterial> run();

 private:
  void statement(std::string_view word, std::string_view rest, MtlMaterial& m);
  std::optional<std::vector<float>> numbers(std::string_view word, std::string_view rest);
  void colour(std::string_view word, std::string_view rest, std::optional<Vec3>& to);
  void number(std::string_view word, std::string_view rest, std::optional<float>& to);
  void readMap(std::string_view word, std::string_view rest, MtlMap& to);
  void leftOut(const std::string& why);
  void noteLeftOut(const std::vector<MtlMaterial>& materials);

  TextLines lines_;
  const std::string* file_;
  const FileExists* exists_;
  UnreadKeys unread_;
  int linesLeftOut_ = 0;
  std::map<size_t, uint64_t> ambientLines_, transparencyLines_;  // by number of materials so far
};

bool isAllZero(std::string_view rest) {
  for (std::string_view w = nextWord(rest); !w.empty() && w[0] != '#'; w = nextWord(rest))
    if (finiteNumber(w) != 0.0) return false;
  return true;
}

std::vector<MtlMaterial> Parser::run() {
  std::vector<MtlMaterial> materials;
  for (std::string_view line; lines_.next(line);) {
    const std::string_view word = nextWord(line);
    if (word.empty() || word[0] == '#') continue;
    if (lowerCase(word) == "newmtl") {
      materials.emplace_back().name = normalizedName(line);
    } else if (materials.empty()) {
      unread_.add(std::string(word) + " before newmtl", lines_.number());
    } else {
      statement(word, line, materials.back());
      if (lowerCase(word) == "ka") ambientLines_[materials.size()] = lines_.number();
      if (lowerCase(word) == "tr") transparencyLines_[materials.size()] = lines_.number();
    }
  }
  noteLeftOut(materials);
  unread_.report("material library '" + *file_ + "'");
  return materials;
}

void Parser::statement(std::string_view word, std::string_view rest, MtlMaterial& m) {
  const std::string key = lowerCase(word);
  if (const auto* c = find(kColours, key)) return colour(word, rest, m.*c->value);
  if (const auto* n = find(kNumbers, key)) return number(word, rest, m.*n->value);
  if (const auto* map = find(kMaps, key)) return readMap(word, rest, m.*map->value);
  if (key == kNothingAlone || (key == kNothingAtZero && isAllZero(rest))) return;
  unread_.add(word, lines_.number());
}

// Ambient light is what a renderer of indirect light computes. Only a material that reflects reads
// Ka: how metallic it is.
bool leavesAmbientOut(const MtlMaterial& m) {
  const float illum = m.illum.value_or(2);
  return m.Ka && !isBlack(*m.Ka) && illum != 3 && illum != 5 && illum != 6 && illum != 8;
}

bool contradicts(const MtlMaterial& m) {
  const auto part = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  return m.d && m.Tr && std::abs(part(*m.d) + part(*m.Tr) - 1) > 1e-3f;
}

// What a material's other lines decide.
void Parser::noteLeftOut(const std::vector<MtlMaterial>& materials) {
  for (const auto& [count, line] : ambientLines_)
    if (leavesAmbientOut(materials[count - 1])) unread_.add("Ka", line);
  for (const auto& [count, line] : transparencyLines_) {
    const MtlMaterial& m = materials[count - 1];
    if (contradicts(m)) unread_.add("Tr where d is not 1 - Tr", line);
    if (!m.d && m.Tr && *m.Tr >= 1) unread_.add("Tr 1 without d, which nobody would see", line);
  }
}

// The numbers of a line; nullopt and a warning if a word is no number.
std::optional<std::vector<float>> Parser::numbers(std::string_view word, std::string_view rest) {
  std::vector<float> values;
  for (std::string_view w = nextWord(rest); !w.empty() && w[0] != '#'; w = nextWord(rest)) {
    const auto number = finiteNumber(w);
    if (!number) {
      leftOut(fmt::format("'{}' of {} is not a finite number", w.substr(0, 40), word));
      return {};
    }
    values.push_back(static_cast<float>(*number));
  }
  if (!values.empty()) return values;
  leftOut(fmt::format("{} has no number", word));
  return {};
}

// Warns of the first lines only: a damaged file has any number of them.
void Parser::leftOut(const std::string& why) {
  constexpr int kMost = 20;
  if (linesLeftOut_++ < kMost)
    warn("material library '{}', line {}: {}: the line is left out", *file_, lines_.number(), why);
}

void Parser::colour(std::string_view word, std::string_view rest, std::optional<Vec3>& to) {
  const auto values = numbers(word, rest);
  if (!values) return;
  const std::vector<float>& v = *values;
  to = v.size() < 3 ? Vec3(v[0]) : Vec3(v[0], v[1], v[2]);
}

// Of "d -halo 0.5" only the number: surfaces that are clearer where they are seen head-on are not
// modelled.
void Parser::number(std::string_view word, std::string_view rest, std::optional<float>& to) {
  std::string_view behind = rest;
  if (lowerCase(nextWord(behind)) == "-halo") {
    unread_.add("-halo", lines_.number());
    rest = behind;
  }
  const auto values = numbers(word, rest);
  if (values) to = (*values)[0];
  if (lowerCase(word) == "illum" && to && (*to < 0 || *to > 9))
    unread_.add("illum beyond 0 to 9", lines_.number());
}

void Parser::readMap(std::string_view word, std::string_view rest, MtlMap& to) {
  to = parseMtlMap(rest, *exists_, unread_, lines_.number());
  if (!to) leftOut(fmt::format("{} has no file name", word));
}

}  // namespace

std::vector<MtlMaterial> readMtl(std::string_view text, const std::string& file,
                                 const FileExists& exists) {
  return Parser(text, file, exists).run();
}

}  // namespace ninefold
