#include "master/web/web_tls.h"

#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/rand.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <string.h>

#include "common/base/error.h"
#include "master/web/web_access.h"
#include "proto/tls_context.h"

namespace ninefold {
namespace {

constexpr long kHour = 3600, kValid = 90 * 24 * kHour;  // [s]

using KeyPointer = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using CertificatePointer = std::unique_ptr<X509, Freed<X509_free>>;

// Of an error without words for people: the layer above only says that one below has failed.
bool isOfPem(unsigned long error) {
  return ERR_GET_LIB(error) == ERR_LIB_PEM || ERR_GET_REASON(error) == ERR_R_PEM_LIB ||
         ERR_GET_REASON(error) == ERR_R_ASN1_LIB;
}

// Why a file with `what` was not taken. The first error in OpenSSL's queue is the cause: the
// system's, or a reader's; the last one is what was to be done.
std::string reason(const char* what) {
  const unsigned long first = ERR_peek_error(), last = ERR_peek_last_error();
  ERR_clear_error();
  if (ERR_SYSTEM_ERROR(first)) return ::strerror(ERR_GET_REASON(first));
  if (first == 0 || isOfPem(last)) return fmt::format("holds no {} in PEM", what);
  const char* text = ERR_reason_error_string(last);
  return text == nullptr ? "it cannot be read" : text;
}

int noPassword(char*, int, int, void*) { return -1; }

std::shared_ptr<WebTls> emptyTls() {
  namespace ssl = boost::asio::ssl;
  auto tls = std::make_shared<WebTls>(WebTls{ssl::context(ssl::context::tls_server), {}, {}});
  SSL_CTX* context = tls->context.native_handle();
  NINEFOLD_CHECK(SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION) == 1);
  SSL_CTX_set_default_passwd_cb(context, noPassword);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  return tls;
}

std::string fingerprintOf(const X509* certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  NINEFOLD_CHECK(X509_digest(certificate, EVP_sha256(), digest.data(), &size) == 1);
  std::string text;
  for (unsigned i = 0; i < size; ++i)
    text += fmt::format("{}{:02X}", i == 0 ? "" : ":", unsigned{digest[i]});
  return text;
}

std::vector<std::string> namesOf(const X509* certificate) {
  std::vector<std::string> names;
  const std::unique_ptr<GENERAL_NAMES, Freed<GENERAL_NAMES_free>> all(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; all != nullptr && i < sk_GENERAL_NAME_num(all.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(all.get(), i);
    if (name->type != GEN_DNS) continue;
    const auto* text = reinterpret_cast<const char*>(ASN1_STRING_get0_data(name->d.dNSName));
    names.emplace_back(text, static_cast<size_t>(ASN1_STRING_length(name->d.dNSName)));
  }
  return names;
}

void describe(WebTls& tls) {
  const X509* certificate = SSL_CTX_get0_certificate(tls.context.native_handle());
  tls.fingerprint = fingerprintOf(certificate);
  tls.names = namesOf(certificate);
}

// What a host name may be made of; OpenSSL's syntax of names has more.
bool isPlainName(const std::string& text) {
  return !text.empty() && text.find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyz"
                              "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789.-") == std::string::npos;
}

void setNames(X509* certificate, const std::vector<std::string>& namesAndAddresses) {
  std::string list;
  for (const std::string& name : namesAndAddresses) {
    if (!isAddress(name) && !isPlainName(name)) continue;
    list += fmt::format("{}{}:{}", list.empty() ? "" : ",", isAddress(name) ? "IP" : "DNS", name);
  }
  const std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, list.c_str()));
  NINEFOLD_CHECK(extension != nullptr);
  NINEFOLD_CHECK(X509_add_ext(certificate, extension.get(), -1) == 1);
}

CertificatePointer certify(EVP_PKEY* key, const std::vector<std::string>& namesAndAddresses) {
  CertificatePointer certificate(X509_new());
  NINEFOLD_CHECK(certificate != nullptr);
  uint64_t serial = 0;
  NINEFOLD_CHECK(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1);
  X509_set_version(certificate.get(), X509_VERSION_3);
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate.get()), serial >> 1 | 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kHour);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kValid);
  X509_NAME* name = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("ninefold-master"), -1, -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  X509_set_pubkey(certificate.get(), key);
  setNames(certificate.get(), namesAndAddresses);
  NINEFOLD_CHECK(X509_sign(certificate.get(), key, EVP_sha256()) > 0);
  return certificate;
}

}  // namespace

std::shared_ptr<WebTls> loadWebTls(const std::string& certificate, const std::string& key) {
  auto tls = emptyTls();
  SSL_CTX* context = tls->context.native_handle();
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    fail("--serve-certificate {}: {}; give a PEM file with the certificate and its chain",
         certificate, reason("certificate"));
  if (SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) != 1)
    fail(
        "--serve-key {}: {}; give a PEM file with the certificate's private key, without a "
        "password",
        key, reason("private key"));
  describe(*tls);
  return tls;
}

std::shared_ptr<WebTls> makeWebTls(const std::vector<std::string>& namesAndAddresses) {
  auto tls = emptyTls();
  const KeyPointer key(EVP_EC_gen("P-256"));
  NINEFOLD_CHECK(key != nullptr);
  const CertificatePointer certificate = certify(key.get(), namesAndAddresses);
  SSL_CTX* context = tls->context.native_handle();
  NINEFOLD_CHECK(SSL_CTX_use_certificate(context, certificate.get()) == 1);
  NINEFOLD_CHECK(SSL_CTX_use_PrivateKey(context, key.get()) == 1);
  describe(*tls);
  return tls;
}

}  // namespace ninefold
