#include "common/scene/gltf_file.h"

#include <tiny_gltf.h>

#include <limits>
#include <string_view>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/gltf_guard.h"
#include "common/scene/gltf_unread.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

// What the parser's callbacks share: where files may come from and how many bytes are left to read.
struct Source {
  const SceneFolder* folder;
  uint64_t bytesLeft = kMaxFileBytes;
};

// Exceptions pass through the parser, which holds nothing that its destructors do not free.
bool readWholeFile(std::vector<unsigned char>* out, std::string*, const std::string& path,
                   void* user) {
  auto& source = *static_cast<Source*>(user);
  *out = source.folder->read(path, source.bytesLeft);
  if (out->empty()) fail("'{}' is empty", path);
  source.bytesLeft -= out->size();
  return true;
}

bool fileExists(const std::string&, void*) { return true; }  // readWholeFile says what is wrong
std::string samePath(const std::string& path, void*) { return path; }
bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

// Keeps the compressed bytes of images from URIs. Those in buffer views are taken from there later,
// because the parser does not check the view before it makes this pointer of it.
bool keepImage(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
               const unsigned char* bytes, int size, void*) {
  image->as_is = true;
  if (image->bufferView >= 0) return true;
  if (size <= 0) fail("image {} has no bytes, or too many", index);
  image->image.assign(bytes, bytes + size);
  return true;
}

template <typename Callbacks>  // newer versions of the parser also ask for a file's size
void setSizeCallback(Callbacks& callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](size_t* bytes, std::string*, const std::string& path,
                                      void* user) {
      *bytes = std::filesystem::file_size(static_cast<Source*>(user)->folder->resolve(path));
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

void checkExtensions(const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired)
    if (!isReadExtension(name))
      fail("needs the glTF extension {}, which is not supported: export without it", name);
}

std::string firstLine(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "not a glTF file" : line;
}

}  // namespace

std::shared_ptr<const tinygltf::Model> parseGltf(std::span<const unsigned char> file,
                                                 const SceneFolder& folder) {
  if (file.size() > std::numeric_limits<unsigned>::max())
    fail("{} bytes, but a glTF file has less than 4 GiB: put the data into .bin files",
         file.size());
  const std::string_view json = checkedJson(file);
  auto model = std::make_shared<tinygltf::Model>();
  tinygltf::TinyGLTF parser;
  Source source{&folder};
  setCallbacks(parser, source);
  std::string errors, warnings;
  bool parsed = false;
  try {
    parsed = isBinaryGltf(file)
                 ? parser.LoadBinaryFromMemory(model.get(), &errors, &warnings, file.data(),
                                               static_cast<unsigned>(file.size()))
                 : parser.LoadASCIIFromString(model.get(), &errors, &warnings, json.data(),
                                              static_cast<unsigned>(json.size()), "");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    fail("damaged glTF file: {}", firstLine(e.what()));
  }
  if (!parsed) fail("damaged glTF file: {}", firstLine(errors));
  checkExtensions(*model);
  if (const std::string unread = unreadOf(json); !unread.empty())
    warn("left out, as nothing reads it: {}", unread);
  return model;
}

}  // namespace ninefold
