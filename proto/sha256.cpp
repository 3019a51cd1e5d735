#include "proto/sha256.h"

#include <openssl/evp.h>

namespace ninefold {

Sha256 sha256(ByteView bytes) {
  Sha256 hash;
  NINEFOLD_CHECK(
      EVP_Digest(bytes.data(), bytes.size(), hash.data(), nullptr, EVP_sha256(), nullptr) == 1);
  return hash;
}

std::string hex(const Sha256& hash) {
  std::string text;
  for (const uint8_t byte : hash) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace ninefold
