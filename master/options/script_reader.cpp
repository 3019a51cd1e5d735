// Reads what docs/script.md describes.
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "common/base/error.h"
#include "common/scene/animation.h"
#include "common/scene/camera_choice.h"
#include "common/scene/world.h"
#include "master/options/script.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

constexpr size_t kMostEvents = 10000;

// One object of the file, whose fields are taken one by one; what is left is not known.
class Fields {
 public:
  Fields(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail("{}: must be an object {{...}}", where_);
  }
  bool has(const char* field) {
    seen_.insert(field);
    return json_.contains(field);
  }
  double number(const char* field, double low, double high) {
    const Json& value = get(field);
    if (!value.is_number()) fail("{}: \"{}\" must be a number", where_, field);
    const double number = value.get<double>();
    if (!(number >= low && number <= high))
      fail("{}: \"{}\" is {}, must be {} to {}", where_, field, number, low, high);
    return number;
  }
  double numberOr(const char* field, double otherwise, double low, double high) {
    return has(field) ? number(field, low, high) : otherwise;
  }
  std::string text(const char* field) {
    const Json& value = get(field);
    if (!value.is_string()) fail("{}: \"{}\" must be a text", where_, field);
    return value.get<std::string>();
  }
  DVec3 vector(const char* field, double low = -1e9, double high = 1e9) {
    const Json& value = get(field);
    DVec3 v;
    if (!value.is_array() || value.size() != 3) fail("{}: \"{}\" must be [x, y, z]", where_, field);
    for (int i = 0; i < 3; ++i) {
      const Json& c = value[static_cast<size_t>(i)];
      v[i] = c.is_number() ? c.get<double>() : std::nan("");
      if (!(v[i] >= low && v[i] <= high))
        fail("{}: \"{}\" must be three numbers from {} to {}", where_, field, low, high);
    }
    return v;
  }
  const Json& list(const char* field) {
    const Json& value = get(field);
    if (!value.is_array()) fail("{}: \"{}\" must be a list [...]", where_, field);
    return value;
  }
  const std::string& where() const { return where_; }
  void expectNothingElse() const {
    for (const auto& item : json_.items())
      if (!seen_.contains(item.key())) fail("{}: \"{}\" is unknown", where_, item.key());
  }

 private:
  const Json& get(const char* field) {
    if (!has(field)) fail("{}: \"{}\" is missing", where_, field);
    return json_.at(field);
  }
  const Json& json_;
  const std::string where_;
  std::set<std::string> seen_;
};

class Reader {
 public:
  Reader(const Scene& scene, std::string name) : scene_(scene), name_(std::move(name)) {}

  Script read(const Json& json) {
    Fields file(json, name_);
    Script script;
    script.seconds = file.number("seconds", 0, kLongestScript);
    if (file.has("rate")) script.rate = file.number("rate", kSlowestRate, kFastestRate);
    if (file.has("shots")) script.shots = file.number("shots", kSlowestRate, kFastestRate);
    if (script.rate && script.shots)
      fail("{}: \"rate\" and \"shots\" exclude each other: shots are of a session in real time",
           name_);
    script.frames = static_cast<int>(file.numberOr("frames", 1, 1, 1e6));
    const Json& events = file.list("events");
    if (events.size() > kMostEvents) fail("{}: more than {} events", name_, kMostEvents);
    for (size_t i = 0; i < events.size(); ++i)
      script.events.push_back(event(Fields(events[i], fmt::format("{}: event {}", name_, i))));
    file.expectNothingElse();
    return script;
  }

 private:
  Script::Event event(Fields fields) {
    Script::Event e;
    if (fields.has("at")) {
      e.from = e.to = fields.number("at", 0, kLongestScript);
    } else {
      e.from = fields.number("from", 0, kLongestScript);
      e.to = fields.number("to", e.from, kLongestScript);
    }
    if (fields.has("camera"))
      camera(fields, e);
    else if (fields.has("object"))
      object(fields, e);
    else if (fields.has("light"))
      light(fields, e);
    else if (fields.has("material"))
      material(fields, e);
    else if (fields.has("animation"))
      animation(fields, e);
    else
      fail("{}: needs \"camera\", \"object\", \"light\", \"material\" or \"animation\"",
           fields.where());
    fields.expectNothingElse();
    return e;
  }

  void camera(Fields& fields, Script::Event& e) {
    e.kind = Script::Event::Kind::camera;
    for (const Json& stop : fields.list("camera")) {
      if (!stop.is_string()) fail("{}: \"camera\" must hold texts", fields.where());
      try {
        e.path.push_back(chooseCamera(scene_, stop.get<std::string>()));
      } catch (const Error& error) {
        fail("{}: {}", fields.where(), error.what());
      }
    }
    if (e.path.empty()) fail("{}: \"camera\" is empty", fields.where());
    for (const Camera& stop : e.path)
      if (isOrthographic(stop) != isOrthographic(e.path.front()))
        fail("{}: there is no way between an orthographic camera and another", fields.where());
  }

  // All nodes of that name: one thing may have many.
  void object(Fields& fields, Script::Event& e) {
    e.kind = Script::Event::Kind::object;
    const std::string wanted = fields.text("object");
    std::set<int> nodes;
    Bounds bounds;
    for (const Instance& instance : scene_.instances) {
      if (instance.name != wanted) continue;
      nodes.insert(instance.node);
      for (const Vec3& p : scene_.meshes[static_cast<size_t>(instance.mesh)].positions)
        bounds.add(worldPoint(instance.toWorld, p));
    }
    if (nodes.empty()) fail("{}: the scene has no object '{}'", fields.where(), wanted);
    e.nodes.assign(nodes.begin(), nodes.end());
    e.centre = DVec3(bounds.centre());
    if (fields.has("by")) e.by = fields.vector("by");
    e.turn = fields.numberOr("turn", 0, -1e6, 1e6) * std::numbers::pi / 180;
    e.twist = fields.numberOr("twist", 0, -1e6, 1e6) * std::numbers::pi / 180;
    e.low = double{bounds.low.y}, e.high = double{bounds.high.y};
    if (e.twist != 0 && !(e.high > e.low))
      fail("{}: '{}' is flat: it has no top to be twisted", fields.where(), wanted);
  }

  void light(Fields& fields, Script::Event& e) {
    e.kind = Script::Event::Kind::light;
    e.light = editOf(scene_, index(fields, "light", scene_.lights));
    if (fields.has("position")) e.light.position = Vec3(fields.vector("position") - scene_.origin);
    if (fields.has("intensity")) e.light.intensity = Vec3(fields.vector("intensity", 0, 1e12));
  }

  void material(Fields& fields, Script::Event& e) {
    e.kind = Script::Event::Kind::material;
    MaterialEdit m = editOfMaterial(scene_, index(fields, "material", scene_.materials));
    const auto set = [&](const char* field, float& value, double low, double high) {
      value = static_cast<float>(fields.numberOr(field, double(value), low, high));
    };
    if (fields.has("color")) m.baseColor = Vec3(fields.vector("color", 0, 1));
    if (fields.has("emission")) m.emission = Vec3(fields.vector("emission", 0, 1e12));
    set("metallic", m.metallic, 0, 1), set("roughness", m.roughness, 0, 1);
    set("transmission", m.transmission, 0, 1), set("ior", m.ior, 1, 10);
    e.material = m;
  }

  void animation(Fields& fields, Script::Event& e) {
    e.kind = Script::Event::Kind::animation;
    const Json& times = fields.list("animation");
    const auto isTime = [](const Json& t) {
      return t.is_number() && t >= 0 && t <= kLongestScript;
    };
    if (times.size() != 2 || !std::ranges::all_of(times, isTime))
      fail("{}: \"animation\" must be [from, to], two times from 0 to {}", fields.where(),
           kLongestScript);
    if (const std::string why = whyNotPlayed(scene_); !why.empty())
      fail("{}: {}", fields.where(), why);
    e.playedFrom = times[0].get<double>(), e.playedTo = times[1].get<double>();
  }

  template <typename T>
  uint32_t index(Fields& fields, const char* what, const std::vector<T>& list) {
    const std::string wanted = fields.text(what);
    for (uint32_t i = 0; i < list.size(); ++i)
      if (list[i].name == wanted) return i;
    fail("{}: the scene has no {} '{}'", fields.where(), what, wanted);
  }

  const Scene& scene_;
  const std::string name_;
};

}  // namespace

Script parseScript(const std::string& text, const std::string& name, const Scene& scene) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    fail("{}: not JSON: {}", name, error.what());
  }
  return Reader(scene, name).read(json);
}

Script readScript(const std::string& path, const Scene& scene) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) fail("cannot read {}: no such file, or not readable", path);
  return parseScript(text.str(), path, scene);
}

}  // namespace ninefold
