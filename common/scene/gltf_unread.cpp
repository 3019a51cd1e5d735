#include "common/scene/gltf_unread.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "common/scene/gltf_known_names.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

constexpr size_t kMostNames = 30, kLongestName = 60;  // of a message

// Members of an object that are read. One without any is a value, or an object that may hold
// anything.
struct Known {
  std::map<std::string, Known, std::less<>> members;
};

void add(Known& root, std::string_view path) {
  Known* at = &root;
  while (!path.empty()) {
    const size_t dot = path.find('.');
    at = &at->members[std::string(path.substr(0, dot))];
    path.remove_prefix(dot == std::string_view::npos ? path.size() : dot + 1);
  }
}

Known makeKnown() {
  Known root;
  for (const std::string_view path : kRead)
    if (path.back() == '@')
      for (const char* end : kTextureUse)
        add(root, std::string(path.substr(0, path.size() - 1)) + end);
    else
      add(root, path);
  return root;
}

const Known& known() {
  static const Known root = makeKnown();
  return root;
}

// JOINTS_3 is JOINTS_#.
std::string numberless(std::string_view name) {
  const size_t end = name.find_last_not_of("0123456789") + 1;
  return std::string(name.substr(0, end)) + (end < name.size() ? "#" : "");
}

// Gets the file's values one after another, and remembers only where it is.
class UnreadFinder : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& value) override {
    if (path_ == ".extensionsUsed" && !isReadExtension(value)) unread_[kExtension].insert(value);
    return true;
  }
  bool start_object(size_t) override { return open(); }
  bool start_array(size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override;
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }
  std::string text() const;

 private:
  enum Kind { kAttribute, kMaterial, kExtension, kKinds };
  // An object or array that is open, and how long the path to it is.
  struct Level {
    const Known* known;  // null: what is in it has been told or is nobody's
    size_t path;
  };
  bool open() {
    levels_.push_back({next_, path_.size()});
    return true;
  }
  bool close();
  const Known* memberOf(const Level& level, const std::string& name);
  bool tell(const std::string& name);

  std::vector<Level> levels_;
  const Known* next_ = &known();  // of the value that comes
  std::string path_;              // ".meshes.primitives"
  std::array<std::set<std::string>, kKinds> unread_;
};

bool UnreadFinder::close() {
  levels_.pop_back();
  if (levels_.empty()) return true;
  next_ = levels_.back().known, path_.resize(levels_.back().path);
  return true;
}

bool UnreadFinder::key(string_t& name) {
  const Level& level = levels_.back();
  path_.resize(level.path);
  next_ = memberOf(level, name);
  path_ += '.' + name.substr(0, kLongestName);
  return true;
}

const Known* UnreadFinder::memberOf(const Level& level, const std::string& name) {
  static const Known anything, noExtension{{{"", {}}}};
  if (level.known == nullptr || name == "extras") return nullptr;
  const auto& members = level.known->members;
  const auto found = members.contains(name) ? members.find(name) : members.find(numberless(name));
  if (found != members.end()) return &found->second;
  if (name == "extensions") return &noExtension;
  return !members.empty() && tell(name) ? nullptr : &anything;
}

// Notes a member of the object at path_ if it is of a kind that matters. Returns whether it did.
bool UnreadFinder::tell(const std::string& name) {
  constexpr std::string_view kExtensions = ".extensions.", kMaterials = ".materials.";
  const std::string path = path_ + '.' + name.substr(0, kLongestName);
  const auto note = [&](Kind kind, size_t from) {
    return unread_[kind].insert(path.substr(from)), true;
  };
  if (const size_t at = path.rfind(kExtensions); at != std::string::npos)
    return note(kExtension, at + kExtensions.size());
  if (path_ == ".meshes.primitives.attributes" || path_ == ".meshes.primitives.targets")
    return note(kAttribute, path_.size() + 1);
  return path.starts_with(kMaterials) && note(kMaterial, kMaterials.size());
}

// " (what the picture shows instead)"; empty where nobody has said.
std::string insteadOf(std::string_view name) {
  for (const auto& [known, instead] : kInstead)
    if (known == name) return std::string(" (") + instead + ")";
  return {};
}

std::string UnreadFinder::text() const {
  constexpr std::array<const char*, kKinds> kNames = {"vertex attributes ", "material properties ",
                                                      "extensions "};
  std::string all;
  for (size_t kind = 0; kind < kKinds; ++kind) {
    size_t named = 0;
    for (const std::string& name : unread_[kind]) {
      all += named > 0 ? ", " : (all.empty() ? "" : "; ") + std::string(kNames[kind]);
      if (named++ == kMostNames) {
        all += "...";
        break;
      }
      all += name + insteadOf(name);
    }
  }
  std::ranges::replace_if(
      all, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return all;
}

}  // namespace

bool isReadExtension(std::string_view name) {
  static const std::set<std::string, std::less<>> names = [] {
    std::set<std::string, std::less<>> all{std::string(kOnlyNamed)};
    constexpr std::string_view kExtensions = "extensions.";
    const auto note = [&](std::string_view path) {
      for (size_t at = path.find(kExtensions); at != std::string_view::npos;
           at = path.find(kExtensions)) {
        path.remove_prefix(at + kExtensions.size());
        all.emplace(path.substr(0, path.find('.')));
      }
    };
    for (const char* path : kRead) note(path);
    for (const char* path : kTextureUse) note(path);
    return all;
  }();
  return names.contains(name);
}

std::string unreadOf(std::string_view json) {
  UnreadFinder finder;
  Json::sax_parse(json.begin(), json.end(), &finder);
  return finder.text();
}

}  // namespace ninefold
