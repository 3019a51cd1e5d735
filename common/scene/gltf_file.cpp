#include "common/scene/gltf_file.h"

#include <tiny_gltf.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/gltf_compression.h"
#include "common/scene/gltf_guard.h"
#include "common/scene/gltf_unread.h"
#include "common/scene/gltf_uri.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

// What the parser's callbacks share: where files may come from, how many bytes are left to read,
// and what could not be had, by the place of its URI.
struct Source {
  const SceneFolder* folder;
  const std::vector<std::string>* uris;
  uint64_t bytesLeft = kMaxFileBytes;
  std::map<int, std::string> errors = {};
};

const std::string& uriOf(const Source& source, const std::string& token) {
  const int place = placeOfToken(token);
  if (place < 0 || static_cast<size_t>(place) >= source.uris->size())
    fail("'{}' is named in an unknown way", token);
  return (*source.uris)[static_cast<size_t>(place)];
}

bool readWholeFile(std::vector<unsigned char>* out, std::string*, const std::string& token,
                   void* user) {
  auto& source = *static_cast<Source*>(user);
  try {
    const std::string& uri = uriOf(source, token);
    *out = bytesOfUri(uri, *source.folder, source.bytesLeft);
    if (out->empty()) fail("'{}' is empty", shownUri(uri));
    source.bytesLeft -= out->size();
    return true;
  } catch (const Error& e) {
    source.errors[placeOfToken(token)] = e.what();
    return false;
  }
}

bool fileExists(const std::string&, void*) { return true; }  // readWholeFile says what is wrong
std::string samePath(const std::string& path, void*) { return path; }
bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

// Keeps the compressed bytes of images from URIs. Those in buffer views are read later: the parser
// makes `bytes` of a view that it has not checked.
bool keepImage(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
               const unsigned char* bytes, int size, void*) {
  image->as_is = true;
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

template <typename Callbacks>  // newer versions of the parser also ask for a file's size
void setSizeCallback(Callbacks& callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](size_t* bytes, std::string*, const std::string&, void*) {
      *bytes = 1;  // the parser's own limit does not count: readWholeFile has one
      return true;
    };
}

void setCallbacks(tinygltf::TinyGLTF& parser, Source& source) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = fileExists;
  callbacks.ExpandFilePath = samePath;
  callbacks.ReadWholeFile = readWholeFile;
  callbacks.WriteWholeFile = writeNothing;
  callbacks.user_data = &source;
  setSizeCallback(callbacks);
  parser.SetFsCallbacks(callbacks);
  parser.SetImageLoader(keepImage, nullptr);
}

// A texture whose image cannot be read says so itself, by its name (gltf_material.h).
bool isToldByTextures(const std::string& name) {
  return name == "KHR_texture_basisu" || name == "EXT_texture_webp";
}

void checkRequired(const std::vector<std::string>& extensions) {
  for (const std::string& name : extensions)
    if (!isReadExtension(name) && !isToldByTextures(name))
      fail("needs the glTF extension {}, which is not supported: export without it", name);
}

// minVersion decides if it is there, else the major version: glTF 2.0, 3.2.
void checkVersion(const std::string& version, const std::string& minVersion) {
  const std::string& needed = minVersion.empty() ? version : minVersion;
  const bool known =
      needed == "2.0" || needed == "2" || (minVersion.empty() && needed.starts_with("2."));
  if (!known) fail("needs glTF version {}, only 2.0 is supported: export as glTF 2.0", needed);
  if (version != "2.0") warn("glTF version {} is read as 2.0", version);
}

// A file is often unreadable because of an extension that it requires. Then that is the message.
void explainFailure(const std::string& json) {
  const auto file = nlohmann::json::parse(json, nullptr, false);
  if (!file.is_object()) return;
  const auto text = [](const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (const auto asset = file.find("asset"); asset != file.end() && asset->is_object())
    if (const std::string version = text(*asset, "version"); !version.empty())
      checkVersion(version, text(*asset, "minVersion"));
  std::vector<std::string> required;
  if (const auto list = file.find("extensionsRequired"); list != file.end() && list->is_array())
    for (const auto& name : *list)
      if (name.is_string()) required.push_back(name);
  checkRequired(required);
}

std::string firstLine(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "not a glTF file" : line;
}

// The same file with another JSON chunk.
std::vector<unsigned char> withJson(std::span<const unsigned char> file, std::string_view before,
                                    std::string json) {
  constexpr size_t kChunkHead = 8, kHeader = 12;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto rest = file.subspan(kHeader + kChunkHead + before.size());
  std::vector<unsigned char> out(file.begin(), file.begin() + kHeader + kChunkHead);
  const auto put = [&](size_t at, size_t value) {
    for (size_t i = 0; i < 4; ++i) out[at + i] = static_cast<unsigned char>(value >> (8 * i));
  };
  put(8, kHeader + kChunkHead + json.size() + rest.size()), put(kHeader, json.size());
  out.insert(out.end(), json.begin(), json.end());
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

// Logs the parser's warnings. Of files that it could not read something better has been said.
void passOnWarnings(const std::string& warnings) {
  std::istringstream lines(warnings);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.find("File ") == std::string::npos &&
        line.find("Failed to load external") == std::string::npos)
      warn("glTF: {}", line);
}

bool parse(std::span<const unsigned char> file, const TokenizedGltf& tokenized, Source& source,
           tinygltf::Model& model, std::string& errors) {
  tinygltf::TinyGLTF parser;
  setCallbacks(parser, source);
  std::string warnings;
  const std::string& json = tokenized.json;
  const bool parsed = isBinaryGltf(file)
                          ? parser.LoadBinaryFromMemory(&model, &errors, &warnings, file.data(),
                                                        static_cast<unsigned>(file.size()))
                          : parser.LoadASCIIFromString(&model, &errors, &warnings, json.data(),
                                                       static_cast<unsigned>(json.size()), "");
  passOnWarnings(warnings);
  return parsed;
}

// Names as they were written, and which images are missing.
std::map<int, std::string> restoreUris(const TokenizedGltf& tokenized, const Source& source,
                                       tinygltf::Model& model) {
  std::map<int, std::string> bad;
  for (size_t i = 0; i < model.images.size(); ++i) {
    const int place = placeOfToken(model.images[i].uri);
    if (place < 0 || static_cast<size_t>(place) >= tokenized.uris.size()) continue;
    model.images[i].uri = shownUri(tokenized.uris[static_cast<size_t>(place)]);
    if (const auto error = source.errors.find(place); error != source.errors.end())
      bad[static_cast<int>(i)] = error->second;
  }
  return bad;
}

}  // namespace

GltfFile parseGltf(std::span<const unsigned char> file, const SceneFolder& folder) {
  if (file.size() > std::numeric_limits<unsigned>::max())
    fail("{} bytes, but a glTF file has less than 4 GiB: put the data into .bin files",
         file.size());
  const std::string_view json = checkedJson(file);
  const std::string completed = completedJson(json);
  TokenizedGltf tokenized = tokenizeUris(completed.empty() ? json : completed);
  std::vector<unsigned char> changed;
  if (isBinaryGltf(file) && tokenized.json != json)
    file = changed = withJson(file, json, tokenized.json);
  auto model = std::make_shared<tinygltf::Model>();
  Source source{&folder, &tokenized.uris};
  std::string errors;
  bool parsed = false;
  try {
    parsed = parse(file, tokenized, source, *model, errors);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    errors = e.what();
  }
  if (!parsed) {
    explainFailure(tokenized.json);
    if (!source.errors.empty()) fail("{}", source.errors.begin()->second);
    fail("damaged glTF file: {}", firstLine(errors));
  }
  checkVersion(model->asset.version, model->asset.minVersion);
  checkRequired(model->extensionsRequired);
  if (const std::string unread = unreadOf(tokenized.json); !unread.empty())
    warn("left out, as nothing reads it: {}", unread);
  decompress(*model);
  auto bad = restoreUris(tokenized, source, *model);
  return {std::move(model), std::move(bad), std::move(tokenized.uris)};
}

}  // namespace ninefold
