#include "common/scene/gltf_profiles.h"

#include <algorithm>

#include "common/base/log.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_uri.h"
#include "common/scene/gltf_value.h"

namespace ninefold {
namespace {

constexpr double kRounding = 1.05;  // coarse tables differ from the maker's integral by as much

const tinygltf::Value& lightOf(const tinygltf::Model& model, int light) {
  const auto extension = model.extensions.find("EXT_lights_ies");
  if (extension != model.extensions.end() && extension->second.Has("lights")) {
    const tinygltf::Value& list = extension->second.Get("lights");
    if (list.IsArray() && light >= 0 && static_cast<size_t>(light) < list.ArrayLen())
      return list.Get(light);
  }
  fail("light profile {} does not exist", light);
}

void tell(const IesFile& file) {
  const std::string what = fmt::format("light profile '{}'", file.profile.name);
  if (file.tilts)
    warn("{}: TILT is left out: the lamp is taken as strong as if it hung as it was measured",
         what);
  if (!file.lampLumens) {
    log("{}: {:.4g} lm", what, file.lumens);
    return;
  }
  const double share = file.lumens / *file.lampLumens;
  log("{}: {:.4g} lm, {:.3g} % of its lamps' {:.4g} lm", what, file.lumens, 100 * share,
      *file.lampLumens);
  if (share > kRounding)
    warn("{}: it sends out more than its lamps make: candela or lumens are wrong in the file",
         what);
}

}  // namespace

GltfProfiles::Light GltfProfiles::use(const tinygltf::Value& use, bool isMirrored) {
  const Known found = known(integerOr(use, "light", -1), isMirrored);
  const double multiplier = numberOr(use, "multiplier", 1);
  if (!(multiplier >= 0)) fail("'multiplier' is {}, must be at least 0", multiplier);
  const Vec3 color = glm::clamp(vectorOr(use, "color", Vec3(1)), 0.0f, 1.0f);
  return {found.profile, static_cast<float>(double(found.peak) * multiplier) * color};
}

GltfProfiles::Known GltfProfiles::known(int light, bool isMirrored) {
  const auto found = known_.find({light, isMirrored});
  if (found != known_.end()) return found->second;
  Known result;
  LightProfile profile;
  if (const auto other = known_.find({light, !isMirrored}); other != known_.end()) {
    result = other->second;
    profile = mirrored(scene_->profiles[static_cast<size_t>(result.profile)]);
  } else {
    IesFile file = read(light, lightOf(*file_->model, light));
    result.peak = file.peak;
    profile = isMirrored ? mirrored(file.profile) : std::move(file.profile);
  }
  if (profile.values.size() > valuesLeft_)
    fail("light profiles of more than {} values: use fewer", kMaxProfileValues);
  valuesLeft_ -= profile.values.size();
  result.profile = static_cast<int>(scene_->profiles.size());
  scene_->profiles.push_back(std::move(profile));
  return known_[{light, isMirrored}] = result;
}

IesFile GltfProfiles::read(int light, const tinygltf::Value& from) {
  std::string name = fmt::format("{}", light);
  try {
    const std::vector<unsigned char> content = bytes(from, name);
    IesFile file = readIes({reinterpret_cast<const char*>(content.data()), content.size()});
    file.profile.name = name;
    tell(file);
    return file;
  } catch (const Error& e) {
    fail("light profile '{}': {}", name, e.what());
  }
}

// `name`: becomes what the file calls the profile, if it has a word for it.
std::vector<unsigned char> GltfProfiles::bytes(const tinygltf::Value& from, std::string& name) {
  const auto text = [&](const char* key) {
    const bool has = from.IsObject() && from.Has(key) && from.Get(key).IsString();
    return has ? from.Get(key).Get<std::string>() : std::string();
  };
  const int place = placeOfToken(text("uri"));
  const bool isNamed = place >= 0 && static_cast<size_t>(place) < file_->uris.size();
  const std::string uri = isNamed ? file_->uris[static_cast<size_t>(place)] : std::string();
  if (const std::string own = text("name"); !own.empty() || isNamed)
    name = own.empty() ? shownUri(uri) : own;
  const uint64_t limit = std::min(kMaxIesBytes, bytesLeft_);
  std::vector<unsigned char> content;
  if (isNamed) {
    content = bytesOfUri(uri, *folder_, limit);
  } else {
    const int view = integerOr(from, "bufferView", -1);
    if (view < 0) fail("it has neither 'uri' nor 'bufferView': export anew");
    const BytesOfView bytes = bytesOfView(*file_->model, view, "its file");
    if (bytes.size > limit)
      fail("its file has {} bytes, more than the {} allowed", bytes.size, limit);
    content.assign(bytes.data, bytes.data + bytes.size);
  }
  bytesLeft_ -= content.size();
  return content;
}

}  // namespace ninefold
