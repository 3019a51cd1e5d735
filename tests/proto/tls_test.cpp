// TLS without sockets: two sessions whose bytes we carry, and spoil, ourselves.
#include "proto/tls.h"

#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <algorithm>

namespace ninefold {
namespace {

using Kind = TlsError::Kind;

// Hands `bytes` of the wire to the session and goes on with its handshake.
bool advance(TlsSession& session, const Bytes& bytes) {
  session.receive(bytes);
  return session.handshake();
}

Bytes take(TlsSession& session) { return std::exchange(session.output(), {}); }

struct Pair {
  TlsSession client, master;
  Pair(KeyUse use, const Key& clientKey, const Key& local, const Key* cluster)
      : client(TlsContext::forClient(use, clientKey)),
        master(TlsContext::forMaster(local, cluster)) {}

  void shakeHands() {
    EXPECT_FALSE(client.handshake());
    EXPECT_FALSE(advance(master, take(client)));
    EXPECT_TRUE(advance(client, take(master)));
    EXPECT_TRUE(advance(master, take(client)));
  }
};

std::string readAll(TlsSession& session, const Bytes& bytes) {
  session.receive(bytes);
  std::string text;
  std::byte piece[100];
  for (size_t got = 0; (got = session.read(piece)) > 0;)
    text.append(reinterpret_cast<const char*>(piece), got);
  return text;
}

// The kind of TlsError that `work` throws; fails if it throws none.
template <typename Work>
Kind kindOf(Work work) {
  try {
    work();
  } catch (const TlsError& error) {
    return error.kind();
  }
  ADD_FAILURE() << "no TlsError";
  return Kind::broken;
}

TEST(Tls, BothKeysLetDataThroughBothWays) {
  const Key local = Key::random(), cluster = Key::random();
  for (const KeyUse use : {KeyUse::local, KeyUse::cluster}) {
    Pair pair(use, use == KeyUse::local ? local : cluster, local, &cluster);
    pair.shakeHands();
    EXPECT_EQ(pair.master.keyUse(), use);
    pair.client.write(viewOf("to the master"));
    EXPECT_EQ(readAll(pair.master, take(pair.client)), "to the master");
    pair.master.write(viewOf(std::string(100000, 'x')));
    EXPECT_EQ(readAll(pair.client, take(pair.master)), std::string(100000, 'x'));
  }
}

TEST(Tls, NothingReadableIsOnTheWire) {
  const Key local = Key::random();
  Pair pair(KeyUse::local, local, local, nullptr);
  pair.shakeHands();
  pair.client.write(viewOf("attack at dawn"));
  const Bytes wire = take(pair.client);
  const std::string text(reinterpret_cast<const char*>(wire.data()), wire.size());
  EXPECT_EQ(text.find("dawn"), std::string::npos);
}

TEST(Tls, HandshakeIsSmallAndSurvivesSingleBytes) {
  const Key local = Key::random();
  Pair pair(KeyUse::local, local, local, nullptr);
  EXPECT_FALSE(pair.client.handshake());
  const Bytes hello = take(pair.client);
  EXPECT_LT(hello.size(), 1000u) << "far below the 4 KiB that a stranger may send";
  for (const std::byte b : hello) advance(pair.master, Bytes(1, b));
  EXPECT_TRUE(advance(pair.client, take(pair.master)));
}

TEST(Tls, AnotherKeyIsSeenByBothSides) {
  const Key local = Key::random(), other = Key::random();
  Pair pair(KeyUse::local, other, local, nullptr);
  pair.client.handshake();
  const Bytes hello = take(pair.client);
  EXPECT_EQ(kindOf([&] { advance(pair.master, hello); }), Kind::wrongKey);
  const Bytes alert = take(pair.master);
  EXPECT_FALSE(alert.empty());
  EXPECT_EQ(kindOf([&] { advance(pair.client, alert); }), Kind::wrongKey);
}

TEST(Tls, UsesAreBoundIntoTheKey) {
  // The same 32 bytes for both uses: a client cannot pass one off as the other.
  const Key local = Key::random();
  Pair pair(KeyUse::cluster, local, local, nullptr);
  pair.client.handshake();
  const Bytes hello = take(pair.client);
  EXPECT_EQ(kindOf([&] { advance(pair.master, hello); }), Kind::wrongKey);
}

TEST(Tls, AMastersWordsPlayedBackOpenNothing) {
  const Key local = Key::random();
  Pair pair(KeyUse::local, local, local, nullptr);
  pair.client.handshake();
  advance(pair.master, take(pair.client));
  const Bytes answer = take(pair.master);
  TlsSession other(TlsContext::forMaster(local, nullptr));
  EXPECT_EQ(kindOf([&] { advance(other, answer); }), Kind::foreign);
}

TEST(Tls, AReplayedHelloGetsNoFurther) {
  const Key local = Key::random();
  const auto context = TlsContext::forMaster(local, nullptr);
  TlsSession client(TlsContext::forClient(KeyUse::local, local)), first(context), second(context);
  client.handshake();
  const Bytes hello = take(client);
  advance(first, hello);
  advance(client, take(first));
  const Bytes finished = take(client);
  EXPECT_TRUE(advance(first, finished));
  EXPECT_FALSE(advance(second, hello));  // the eavesdropper's connection
  EXPECT_EQ(kindOf([&] { advance(second, finished); }), Kind::foreign);
}

TEST(Tls, OneFlippedBitBreaksTheStream) {
  const Key local = Key::random();
  for (const size_t bit : {40u, 100u, 300u}) {
    Pair pair(KeyUse::local, local, local, nullptr);
    pair.shakeHands();
    pair.client.write(viewOf(std::string(50, 'x')));
    Bytes wire = take(pair.client);
    wire[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    EXPECT_EQ(kindOf([&] { readAll(pair.master, wire); }), Kind::broken);
  }
}

TEST(Tls, KeysAreRenewedInTheMiddleOfTheStream) {
  const Key local = Key::random();
  Pair pair(KeyUse::local, local, local, nullptr);
  pair.shakeHands();
  pair.client.write(viewOf("old key, "));
  pair.client.renewKeys();
  pair.client.write(viewOf("new key"));
  EXPECT_EQ(readAll(pair.master, take(pair.client)), "old key, new key");
  pair.master.write(viewOf("heard"));
  EXPECT_EQ(readAll(pair.client, take(pair.master)), "heard");
}

TEST(Tls, AnEndInOrderIsToldFromACut) {
  const Key local = Key::random();
  Pair pair(KeyUse::local, local, local, nullptr);
  pair.shakeHands();
  EXPECT_FALSE(pair.master.ended());
  pair.client.write(viewOf("bye"));
  pair.client.end();
  EXPECT_EQ(readAll(pair.master, take(pair.client)), "bye");
  EXPECT_TRUE(pair.master.ended());
}

// An ordinary TLS 1.3 server with a self-signed certificate, as stands on many ports of a LAN.
Bytes answerOfACertificateServer(const Bytes& clientHello) {
  SSL_CTX* ctx = SSL_CTX_new(TLS_server_method());
  EVP_PKEY* key = EVP_EC_gen("P-256");
  X509* certificate = X509_new();
  X509_gmtime_adj(X509_getm_notBefore(certificate), 0);
  X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
  X509_set_pubkey(certificate, key);
  X509_sign(certificate, key, EVP_sha256());
  EXPECT_EQ(SSL_CTX_use_certificate(ctx, certificate), 1);
  EXPECT_EQ(SSL_CTX_use_PrivateKey(ctx, key), 1);
  SSL* ssl = SSL_new(ctx);
  BIO *in = BIO_new(BIO_s_mem()), *out = BIO_new(BIO_s_mem());
  SSL_set_bio(ssl, in, out);
  BIO_write(in, clientHello.data(), static_cast<int>(clientHello.size()));
  SSL_accept(ssl);
  char* data = nullptr;
  const long size = BIO_get_mem_data(out, &data);
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  const Bytes answer(bytes, bytes + size);
  SSL_free(ssl), X509_free(certificate), EVP_PKEY_free(key), SSL_CTX_free(ctx);
  return answer;
}

TEST(Tls, ACertificateDoesNotReplaceTheKey) {
  const Key local = Key::random();
  TlsSession client(TlsContext::forClient(KeyUse::local, local));
  client.handshake();
  const Bytes answer = answerOfACertificateServer(take(client));
  ASSERT_GT(answer.size(), 300u) << "the server went on with its certificate";
  EXPECT_EQ(kindOf([&] { advance(client, answer); }), Kind::foreign);
}

}  // namespace
}  // namespace ninefold
