#include <fmt/core.h>
#include <openssl/evp.h>

#include "common/base/check.h"
#include "master/web/page.h"
#include "proto/sha256.h"

namespace ninefold {
namespace {

// What lies between <tag> and </tag>, once each.
std::string_view inside(std::string_view page, const std::string& tag) {
  const std::string opening = "<" + tag + ">", closing = "</" + tag + ">";
  const size_t begin = page.find(opening), end = page.find(closing);
  NINEFOLD_CHECK(begin != std::string_view::npos && end != std::string_view::npos);
  return page.substr(begin + opening.size(), end - begin - opening.size());
}

std::string hashOf(std::string_view text) {
  const Sha256 hash = sha256(std::as_bytes(std::span(text)));
  std::string base64(4 * ((hash.size() + 2) / 3) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()), hash.data(),
                                   static_cast<int>(hash.size()));
  base64.resize(static_cast<size_t>(size));
  return "'sha256-" + base64 + "'";
}

}  // namespace

std::string policyOf(std::string_view page) {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {}; connect-src 'self'; img-src data:; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      hashOf(inside(page, "script")), hashOf(inside(page, "style")));
}

}  // namespace ninefold
