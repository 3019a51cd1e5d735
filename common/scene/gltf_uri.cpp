#include "common/scene/gltf_uri.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <nlohmann/json.hpp>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr std::string_view kToken = "uri-";

bool startsWithAnyCase(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char a, unsigned char b) {
           return a == static_cast<char>(std::tolower(b));
         });
}

bool isDataUri(std::string_view uri) { return startsWithAnyCase(uri, "data:"); }

// One past the closing quote of the JSON string that begins at `at`.
size_t endOfString(std::string_view json, size_t at) {
  for (size_t i = at + 1; i < json.size(); ++i) {
    if (json[i] == '\\') ++i;
    if (i < json.size() && json[i] == '"') return i + 1;
  }
  return json.size();
}

size_t skipBlanks(std::string_view json, size_t at) {
  while (at < json.size() && std::isspace(static_cast<unsigned char>(json[at])) != 0) ++at;
  return at;
}

// `at`: where a key ends. Returns where its string value begins; json.size() if it has none.
size_t valueOfKey(std::string_view json, size_t at) {
  at = skipBlanks(json, at);
  if (at == json.size() || json[at] != ':') return json.size();
  at = skipBlanks(json, at + 1);
  return at < json.size() && json[at] == '"' ? at : json.size();
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// The six bits that a letter of base64, or of its variant for URLs, stands for; -1 for others.
int base64Bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::vector<unsigned char> fromBase64(std::string_view text) {
  std::vector<unsigned char> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    if (std::isspace(static_cast<unsigned char>(c)) != 0) continue;
    const int value = base64Bits(c);
    if (value < 0) fail("a data URI is not base64 throughout: it is damaged, export anew");
    bits = bits << 6 | static_cast<uint32_t>(value), count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count));
  }
  return bytes;
}

std::vector<unsigned char> bytesOfDataUri(std::string_view uri, uint64_t limit) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) fail("a data URI has no comma: it is damaged, export anew");
  constexpr std::string_view kBase64 = ";base64";
  const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
  const bool isBase64 = head.size() >= kBase64.size() &&
                        startsWithAnyCase(head.substr(head.size() - kBase64.size()), kBase64);
  if (data.size() > 4 * (limit / 3) + 4)
    fail("a data URI has more than the {} bytes allowed: split or simplify the scene", limit);
  const bool isEncoded = data.find('%') != std::string_view::npos;
  const std::string decoded = isEncoded || !isBase64 ? percentDecoded(data) : std::string();
  if (isBase64) return fromBase64(isEncoded ? std::string_view(decoded) : data);
  return {decoded.begin(), decoded.end()};
}

}  // namespace

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    const bool isEscape = text[i] == '%' && high >= 0 && low >= 0;
    decoded += isEscape ? static_cast<char>(16 * high + low) : text[i];
    if (isEscape) i += 2;
  }
  return decoded;
}

TokenizedGltf tokenizeUris(std::string_view json) {
  TokenizedGltf out;
  size_t copied = 0;
  for (size_t at = json.find('"'); at < json.size(); at = json.find('"', at)) {
    const size_t end = endOfString(json, at);
    const bool isKey = json.substr(at, end - at) == "\"uri\"";
    at = end;
    const size_t value = isKey ? valueOfKey(json, end) : json.size();
    if (value == json.size()) continue;
    at = endOfString(json, value);
    const auto uri = nlohmann::json::parse(json.substr(value, at - value), nullptr, false);
    if (!uri.is_string()) continue;  // the parser says what is wrong
    out.json += json.substr(copied, value - copied);
    out.json += fmt::format("\"{}{}\"", kToken, out.uris.size());
    out.uris.push_back(uri.get<std::string>());
    copied = at;
  }
  out.json += json.substr(copied);
  return out;
}

int placeOfToken(std::string_view token) {
  if (token.substr(0, kToken.size()) != kToken) return -1;
  token.remove_prefix(kToken.size());
  int place = -1;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), place);
  return error == std::errc() && end == token.data() + token.size() ? place : -1;
}

std::vector<unsigned char> bytesOfUri(const std::string& uri, const SceneFolder& folder,
                                      uint64_t limit) {
  if (isDataUri(uri)) return bytesOfDataUri(uri, limit);
  const std::string decoded = percentDecoded(uri);
  const bool asWritten = decoded != uri && !folder.exists(decoded) && folder.exists(uri);
  return folder.read(asWritten ? uri : decoded, limit);
}

std::string shownUri(const std::string& uri) {
  return isDataUri(uri) ? uri.substr(0, std::min<size_t>(uri.find(','), 60)) : uri;
}

}  // namespace ninefold
