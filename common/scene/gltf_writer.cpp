#include "common/scene/gltf_writer.h"

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "common/base/error.h"
#include "common/base/written_file.h"
#include "common/image/encode.h"
#include "common/scene/ies_file.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126, kUnsigned = 5125;   // glTF's component types
constexpr int kNearest = 9728, kLinear = 9729;   // filters
constexpr int kWraps[] = {10497, 33071, 33648};  // by Wrap
constexpr const char* kIesType = "application/x-ies-lm-63";
constexpr const char* kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};

Json listOf(Vec3 v) { return {v.x, v.y, v.z}; }
Json listOf(Vec2 v) { return {v.x, v.y}; }

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {}

  std::string write() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "ninefold"}};
    for (const TextureImage& image : scene_.images) addImage(image);
    for (const Material& material : scene_.materials)
      json_["materials"].push_back(describe(material));
    addObjects();
    for (const Camera& camera : scene_.cameras) addCamera(camera);
    for (const LightProfile& profile : scene_.profiles) addProfile(profile);
    for (const PunctualLight& light : scene_.lights)
      light.kind == LightKind::goniometric ? addProfiled(light) : addLight(light);
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"name", scene_.name}, {"nodes", roots_}}});
    if (scene_.exposure) json_["scenes"][0]["extras"]["exposure"] = *scene_.exposure;
    json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    if (!extensions_.empty()) json_["extensionsUsed"] = extensions_;
    return container();
  }

 private:
  int addView(const void* data, size_t size) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
    const auto* from = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }

  template <typename T>
  Json& addAccessor(const std::vector<T>& list, int component, const char* type, int scalars = 1) {
    const int view = addView(list.data(), list.size() * sizeof(T));
    json_["accessors"].push_back({{"bufferView", view},
                                  {"componentType", component},
                                  {"type", type},
                                  {"count", list.size() * static_cast<size_t>(scalars)}});
    return json_["accessors"].back();
  }
  int lastAccessor() { return static_cast<int>(json_["accessors"].size()) - 1; }

  void addImage(const TextureImage& image) {
    const auto png = encodePng(image.width, image.height, image.channels, image.texels);
    const int view = addView(png.data(), png.size());
    json_["images"].push_back(
        {{"name", image.name}, {"bufferView", view}, {"mimeType", "image/png"}});
  }

  void uses(const char* extension) {
    if (std::find(extensions_.begin(), extensions_.end(), extension) == extensions_.end())
      extensions_.push_back(extension);
  }

  // Each use has a texture and a sampler of its own.
  Json describe(const TextureUse& use) {
    json_["samplers"].push_back({{"wrapS", kWraps[static_cast<int>(use.wrapS)]},
                                 {"wrapT", kWraps[static_cast<int>(use.wrapT)]},
                                 {"magFilter", use.nearest ? kNearest : kLinear}});
    json_["textures"].push_back({{"sampler", json_["samplers"].size() - 1}, {"source", use.image}});
    Json info{{"index", json_["textures"].size() - 1}, {"texCoord", use.uvSet}};
    if (use.offset != Vec2(0) || use.scale != Vec2(1) || use.rotation != 0) {
      uses("KHR_texture_transform");
      info["extensions"]["KHR_texture_transform"] = {
          {"offset", listOf(use.offset)}, {"scale", listOf(use.scale)}, {"rotation", use.rotation}};
    }
    return info;
  }
  void put(Json& to, const char* field, const TextureUse& use) {
    if (use) to[field] = describe(use);
  }

  Json describe(const Material& m) {
    Json pbr{{"baseColorFactor", {m.baseColor.x, m.baseColor.y, m.baseColor.z, m.opacity}},
             {"metallicFactor", m.metallic},
             {"roughnessFactor", m.roughness}};
    put(pbr, "baseColorTexture", m.baseColorMap);
    put(pbr, "metallicRoughnessTexture", m.metallicRoughnessMap);
    Json out{{"name", m.name},
             {"pbrMetallicRoughness", pbr},
             {"doubleSided", m.doubleSided},
             {"alphaMode", kAlphaModes[static_cast<int>(m.alphaMode)]}};
    if (m.alphaMode == AlphaMode::mask) out["alphaCutoff"] = m.alphaCutoff;
    if (m.normalMap) {
      out["normalTexture"] = describe(m.normalMap);
      out["normalTexture"]["scale"] = m.normalScale;
    }
    const float strength = std::max(1.0f, maxComponent(m.emission));
    out["emissiveFactor"] = listOf(m.emission / strength);
    put(out, "emissiveTexture", m.emissionMap);
    Json& e = out["extensions"];
    e = Json::object();
    if (strength > 1) e["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    if (m.transmission > 0 || m.transmissionMap) {
      e["KHR_materials_transmission"] = {{"transmissionFactor", m.transmission}};
      put(e["KHR_materials_transmission"], "transmissionTexture", m.transmissionMap);
    }
    if (m.solid) addVolume(m, e);
    if (m.ior != 1.5f) e["KHR_materials_ior"] = {{"ior", m.ior}};
    if (m.specular != 1 || m.specularColor != Vec3(1) || m.specularMap || m.specularColorMap) {
      Json& s = e["KHR_materials_specular"];
      s = {{"specularFactor", m.specular}, {"specularColorFactor", listOf(m.specularColor)}};
      put(s, "specularTexture", m.specularMap);
      put(s, "specularColorTexture", m.specularColorMap);
    }
    addLayers(m, e);
    for (const auto& item : e.items()) uses(item.key().c_str());
    return out;
  }

  void addLayers(const Material& m, Json& extensions) {
    if (!isBlack(m.sheenColor)) {
      Json& sheen = extensions["KHR_materials_sheen"];
      sheen = {{"sheenColorFactor", listOf(m.sheenColor)},
               {"sheenRoughnessFactor", m.sheenRoughness}};
      put(sheen, "sheenColorTexture", m.sheenColorMap);
      put(sheen, "sheenRoughnessTexture", m.sheenRoughnessMap);
    }
    if (m.coat > 0) {
      Json& coat = extensions["KHR_materials_clearcoat"];
      coat = {{"clearcoatFactor", m.coat}, {"clearcoatRoughnessFactor", m.coatRoughness}};
      put(coat, "clearcoatTexture", m.coatMap);
      put(coat, "clearcoatRoughnessTexture", m.coatRoughnessMap);
    }
  }

  static void addVolume(const Material& m, Json& extensions) {
    Json& volume = extensions["KHR_materials_volume"];
    volume = {{"thicknessFactor", 1}, {"attenuationColor", listOf(m.attenuationColor)}};
    if (std::isfinite(m.attenuationDistance)) volume["attenuationDistance"] = m.attenuationDistance;
  }

  Json primitive(const Mesh& mesh) {
    Json attributes;
    Json& positions = addAccessor(mesh.positions, kFloat, "VEC3");
    Bounds bounds;
    for (const Vec3& p : mesh.positions) bounds.add(p);
    positions["min"] = listOf(bounds.low), positions["max"] = listOf(bounds.high);
    attributes["POSITION"] = lastAccessor();
    const auto put = [&](const char* name, const auto& list, const char* type) {
      if (list.empty()) return;
      addAccessor(list, kFloat, type);
      attributes[name] = lastAccessor();
    };
    put("NORMAL", mesh.normals, "VEC3"), put("TANGENT", mesh.tangents, "VEC4");
    put("TEXCOORD_0", mesh.uv0, "VEC2"), put("TEXCOORD_1", mesh.uv1, "VEC2");
    put("COLOR_0", mesh.colors, "VEC4");
    addAccessor(mesh.triangles, kUnsigned, "SCALAR", 3);
    return {{"attributes", attributes}, {"indices", lastAccessor()}, {"material", mesh.material}};
  }

  // Instances that share node and place are one object.
  void addObjects() {
    std::map<int, Json> primitives;  // by mesh, once for all instances
    for (size_t i = 0; i < scene_.instances.size();) {
      const Instance& first = scene_.instances[i];
      Json list = Json::array();
      for (; i < scene_.instances.size() && scene_.instances[i].node == first.node &&
             scene_.instances[i].toWorld == first.toWorld;
           ++i) {
        const int mesh = scene_.instances[i].mesh;
        if (!primitives.contains(mesh))
          primitives[mesh] = primitive(scene_.meshes[static_cast<size_t>(mesh)]);
        list.push_back(primitives[mesh]);
      }
      json_["meshes"].push_back({{"name", first.name}, {"primitives", list}});
      addNode({{"name", first.name}, {"mesh", json_["meshes"].size() - 1}}, first.toWorld);
    }
  }

  // `toWorld`: in the scene's coordinates.
  void addNode(Json node, DMat4 toWorld) {
    toWorld[3] += DVec4(scene_.origin, 0.0);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) node["matrix"].push_back(toWorld[column][row]);
    roots_.push_back(json_["nodes"].size());
    json_["nodes"].push_back(std::move(node));
  }

  // Looking along `forward`; `up` need not be orthogonal to it.
  static DMat4 lookingAlong(Vec3 from, Vec3 forward, Vec3 up) {
    const DVec3 z = -glm::normalize(DVec3(forward));
    const DVec3 x = glm::normalize(glm::cross(DVec3(up), z));
    return {DVec4(x, 0), DVec4(glm::cross(z, x), 0), DVec4(z, 0), DVec4(DVec3(from), 1)};
  }

  void addCamera(const Camera& camera) {
    const float half = 0.5f * camera.orthographicHeight;
    Json out{{"name", camera.name}};
    if (isOrthographic(camera))
      out["type"] = "orthographic",
      out["orthographic"] = {{"xmag", half}, {"ymag", half}, {"znear", 0}, {"zfar", 1e6}};
    else
      out["type"] = "perspective",
      out["perspective"] = {{"yfov", camera.verticalFov}, {"znear", 0.01}};
    json_["cameras"].push_back(std::move(out));
    addNode({{"name", camera.name}, {"camera", json_["cameras"].size() - 1}},
            lookingAlong(camera.eye, camera.forward, camera.up));
  }

  void addLight(const PunctualLight& light) {
    constexpr const char* kKinds[] = {"point", "spot", "directional"};
    const float strength = maxComponent(light.intensity);
    Json out{{"name", light.name},
             {"type", kKinds[static_cast<int>(light.kind)]},
             {"intensity", strength},
             {"color", listOf(strength > 0 ? light.intensity / strength : Vec3(1))}};
    if (light.kind == LightKind::spot)
      out["spot"] = {{"innerConeAngle", light.innerCone}, {"outerConeAngle", light.outerCone}};
    uses("KHR_lights_punctual");
    Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(out));
    Json node{{"name", light.name}};
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    const bool steep = std::abs(light.direction.y) > 0.99f;
    addNode(std::move(node),
            lookingAlong(light.position, light.direction, steep ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  }

  void addProfile(const LightProfile& profile) {
    const std::string text = iesText(profile);
    const int view = addView(text.data(), text.size());
    uses("EXT_lights_ies");
    json_["extensions"]["EXT_lights_ies"]["lights"].push_back(
        {{"name", profile.name}, {"bufferView", view}, {"mimeType", kIesType}});
  }

  void addProfiled(const PunctualLight& light) {
    const float strength = maxComponent(light.intensity);
    Json node{{"name", light.name}};
    node["extensions"]["EXT_lights_ies"] = {
        {"light", light.profile},
        {"multiplier", strength},
        {"color", listOf(strength > 0 ? light.intensity / strength : Vec3(1))}};
    addNode(std::move(node), lookingAlong(light.position, light.direction,
                                          glm::cross(light.across, light.direction)));
  }

  // Head, JSON chunk, binary chunk, as glTF 2.0 says.
  std::string container() {
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    std::string file;
    const auto number = [&file](size_t value) {
      if (value > 0xffffffffu) fail("the scene is larger than a .glb file may be");
      const auto n = static_cast<uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&n), sizeof n);
    };
    file = "glTF";
    number(2), number(12 + 8 + text.size() + 8 + bytes_.size());
    number(text.size());
    file += "JSON" + text;
    number(bytes_.size());
    file.append("BIN\0", 4);
    file.append(bytes_.begin(), bytes_.end());
    return file;
  }

  const Scene& scene_;
  Json json_;
  std::vector<char> bytes_;
  std::vector<std::string> extensions_;
  std::vector<size_t> roots_;
};

}  // namespace

void writeGltf(const std::string& path, const Scene& scene) {
  if (!path.ends_with(".glb")) fail("{}: the name must end in .glb", path);
  writeFile(path, Writer(scene).write());
}

}  // namespace ninefold
