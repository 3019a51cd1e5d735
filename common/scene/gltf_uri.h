// gltf_uri.h: the files and data that a glTF file names. The parser decodes names in its own way (a
// plus sign becomes a blank) and knows only some data URIs. So it gets tokens in place of the URIs,
// and asks for the content behind a token.
//
//   name        percent-decoded as RFC 3986 says: %XX is a byte, all else is itself, also a lone %.
//               If no such file exists but one with the undecoded name does, that one.
//   data URI    RFC 2397, data:[media type][;parameters][;base64],... in any case of its letters.
//               The media type is ignored: contents are known by their bytes.
//
// Threads: pure functions.   Errors: bytesOfUri throws Error.
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

// The place of a token in `uris`; -1 if it is no token.
int placeOfToken(std::string_view token);

// The content that `uri` names; throws Error if it has more than `limit` bytes.
std::vector<unsigned char> bytesOfUri(const std::string& uri, const SceneFolder& folder,
                                      uint64_t limit);

// For messages: a data URI by its head alone.
std::string shownUri(const std::string& uri);

std::string percentDecoded(std::string_view text);

}  // namespace ninefold
