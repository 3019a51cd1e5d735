// scene_archive.h: the byte layout of a scene's parts, written down once for both directions.
// Internal to scene_blobs.
//
//   archive(value)         numbers, enums, texts, vectors; little-endian; a list is its count u64
//                          and its elements
//   describe(archive, x)   names the fields of x in their order; x is const when writing
//
// Errors: ReadArchive throws Error on what cannot be a value (lists longer than the data, enums and
// bools out of range). What cannot be a scene is found by validate().
// Threads: plain values.
#pragma once

#include <type_traits>

#include "common/scene/scene.h"
#include "proto/bytes.h"

namespace ninefold {

// Types whose memory is exactly their bytes on the wire: numbers, and packed arrays of them.
template <typename T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
template <>
inline constexpr bool kIsPlain<Vec2> = sizeof(Vec2) == 8;
template <>
inline constexpr bool kIsPlain<Vec3> = sizeof(Vec3) == 12;
template <>
inline constexpr bool kIsPlain<Vec4> = sizeof(Vec4) == 16;
template <>
inline constexpr bool kIsPlain<DVec3> = sizeof(DVec3) == 24;
template <>
inline constexpr bool kIsPlain<DMat4> = sizeof(DMat4) == 128;
template <>
inline constexpr bool kIsPlain<Triangle> = sizeof(Triangle) == 12;

// The last value of each enum that travels.
inline constexpr uint8_t lastOf(Wrap) { return static_cast<uint8_t>(Wrap::mirror); }
inline constexpr uint8_t lastOf(AlphaMode) { return static_cast<uint8_t>(AlphaMode::blend); }
inline constexpr uint8_t lastOf(LightKind) { return static_cast<uint8_t>(LightKind::goniometric); }

class WriteArchive {
 public:
  explicit WriteArchive(Bytes& out) : out_(out) {}

  template <typename... Ts>
  void operator()(const Ts&... values) {
    (put(values), ...);
  }

 private:
  template <typename T>
  void put(const T& value) {
    if constexpr (kIsPlain<T>) {
      out_.raw(&value, sizeof value);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      out_.number(static_cast<uint8_t>(value));
    } else {
      describe(*this, value);
    }
  }
  void put(const std::string& text) { putAll(text); }
  template <typename T>
  void put(const std::vector<T>& list) {
    if constexpr (kIsPlain<T>) {
      putAll(list);
    } else {
      out_.number(uint64_t{list.size()});
      for (const T& element : list) put(element);
    }
  }
  template <typename T>
  void put(const SharedList<T>& list) {
    out_.number(uint64_t{list.size()});
    for (const T& element : list) put(element);
  }
  template <typename List>
  void putAll(const List& list) {
    out_.number(uint64_t{list.size()});
    out_.raw(list.data(), list.size() * sizeof(list[0]));
  }
  ByteWriter out_;
};

class ReadArchive {
 public:
  explicit ReadArchive(ByteReader& in) : in_(in) {}

  template <typename... Ts>
  void operator()(Ts&... values) {
    (get(values), ...);
  }

 private:
  template <typename T>
  void get(T& value) {
    if constexpr (kIsPlain<T>) {
      in_.raw(&value, sizeof value, "a value");
    } else if constexpr (std::is_same_v<T, bool>) {
      value = small(1) != 0;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(small(lastOf(value)));
    } else {
      describe(*this, value);
    }
  }
  void get(std::string& text) { getAll(text); }
  template <typename T>
  void get(std::vector<T>& list) {
    if constexpr (kIsPlain<T>) {
      getAll(list);
    } else {
      // Grows with the data: an element has at least one byte, but more in memory.
      const size_t count = in_.count(in_.number<uint64_t>("a count"), 1, "a list");
      list.clear();
      for (size_t i = 0; i < count; ++i) get(list.emplace_back());
    }
  }
  template <typename T>
  void get(SharedList<T>& list) {
    std::vector<T> elements;
    get(elements);
    list = std::move(elements);
  }
  template <typename List>
  void getAll(List& list) {
    list.resize(in_.count(in_.number<uint64_t>("a count"), sizeof(list[0]), "a list"));
    in_.raw(list.data(), list.size() * sizeof(list[0]), "a list");
  }
  uint8_t small(uint8_t last) {
    const auto value = in_.number<uint8_t>("a choice");
    if (value > last) fail("{}: choice {} is unknown; it is damaged", in_.what(), value);
    return value;
  }
  ByteReader& in_;
};

// --- the layouts; changing one changes kProtocol (wire_version.h) ---

template <typename T, typename U>
concept Of = std::is_same_v<std::remove_const_t<T>, U>;

template <typename A>
void describe(A& a, Of<TextureImage> auto& image) {
  a(image.name, image.width, image.height, image.channels, image.srgb, image.texels);
}

template <typename A>
void describe(A& a, Of<Mesh> auto& mesh) {
  a(mesh.name, mesh.positions, mesh.normals, mesh.uv0, mesh.uv1, mesh.tangents, mesh.colors,
    mesh.triangles, mesh.material);
}

template <typename A>
void describe(A& a, Of<TextureUse> auto& use) {
  a(use.image, use.uvSet, use.offset, use.scale, use.rotation, use.wrapS, use.wrapT, use.nearest);
}

template <typename A>
void describe(A& a, Of<Material> auto& m) {
  a(m.name, m.baseColor, m.baseColorMap, m.opacity, m.alphaMode, m.alphaCutoff);
  a(m.metallic, m.roughness, m.metallicRoughnessMap, m.normalMap, m.normalScale);
  a(m.emission, m.emissionMap, m.doubleSided, m.transmission, m.transmissionMap, m.ior);
  a(m.specular, m.specularMap, m.specularColor, m.specularColorMap);
  a(m.solid, m.attenuationColor, m.attenuationDistance);
  a(m.sheenColor, m.sheenColorMap, m.sheenRoughness, m.sheenRoughnessMap);
  a(m.coat, m.coatMap, m.coatRoughness, m.coatRoughnessMap);
}

template <typename A>
void describe(A& a, Of<Instance> auto& instance) {
  a(instance.name, instance.mesh, instance.node, instance.toWorld);
}

template <typename A>
void describe(A& a, Of<PunctualLight> auto& light) {
  a(light.name, light.kind, light.position, light.direction, light.intensity, light.innerCone,
    light.outerCone, light.across, light.profile);
}

template <typename A>
void describe(A& a, Of<LightProfile> auto& profile) {
  a(profile.name, profile.vertical, profile.horizontal, profile.values);
}

template <typename A>
void describe(A& a, Of<EnvironmentPicture> auto& picture) {
  a(picture.name, picture.width, picture.height, picture.texels, picture.rotation);
}

template <typename A>
void describe(A& a, Of<Camera> auto& camera) {
  a(camera.name, camera.eye, camera.forward, camera.up, camera.verticalFov);
  a(camera.orthographicHeight);
}

// Everything but images, meshes and the environment's picture.
template <typename A>
void describe(A& a, Of<Scene> auto& scene) {
  a(scene.name, scene.materials, scene.instances, scene.photonInstances);
  a(scene.lights, scene.profiles, scene.cameras);
  a(scene.environment, scene.origin, scene.bounds.low, scene.bounds.high);
}

}  // namespace ninefold
