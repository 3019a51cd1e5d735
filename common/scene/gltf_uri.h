// gltf_uri.h: the files and data that a glTF file names. The parser decodes names in its own way (a
// plus sign becomes a blank) and knows only some data URIs; so it gets tokens in their place, and
// asks for what stands behind a token.
//
//   name        percent-decoded as RFC 3986 says: %XX is a byte, all else is itself, also a lone %.
//               If no such file exists but one with the undecoded name does, that one.
//   data URI    RFC 2397, data:[media type][;parameters][;base64],... in any case of its letters; the
//               media type tells nothing: contents are known by their bytes.
//
// Errors: bytesOfUri throws Error. Threads: pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene_folder.h"

namespace ninefold {

struct TokenizedGltf {
  std::string json;               // with a token for the value of each "uri"
  std::vector<std::string> uris;  // of the tokens, as written
};
TokenizedGltf tokenizeUris(std::string_view json);

// The place of a token in `uris`, or -1 for what is none.
int placeOfToken(std::string_view token);

// At most `limit` bytes.
std::vector<unsigned char> bytesOfUri(const std::string& uri, const SceneFolder& folder,
                                      uint64_t limit);

// For messages: a data URI by its head alone.
std::string shownUri(const std::string& uri);

std::string percentDecoded(std::string_view text);

}  // namespace ninefold
