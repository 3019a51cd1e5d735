// Peers without a key, on either side: each ends in one clear line and harms nothing.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "proto/line_limiter.h"
#include "tests/proto/network_fixture.h"
#include "tests/proto/raw_socket.h"

namespace ninefold {
namespace {

using Intruders = Network;

std::string randomBytes(std::mt19937& random, size_t count) {
  std::string bytes(count, 0);
  for (char& b : bytes) b = static_cast<char>(random());
  return bytes;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
}

TEST_F(Intruders, WrongKeyIsOneClearLineOnBothSides) {
  listen();
  const auto other = std::make_shared<Key>(Key::random());
  for (const KeyUse use : {KeyUse::local, KeyUse::cluster}) {
    refused.clear();
    End& client = join(use, other);
    ASSERT_TRUE(client.failure);
    EXPECT_EQ(client.failure->problem, ConnectProblem::wrongKey);
    EXPECT_TRUE(contains(client.failure->line, "does not accept this key")) << client.failure->line;
    ASSERT_TRUE(until([&] { return refused.size() == 1; }));
    EXPECT_TRUE(contains(refused[0], "another key")) << refused[0];
  }
  EXPECT_TRUE(served.empty());
}

TEST_F(Intruders, AKeyWorksForItsOwnUseOnly) {
  listen();
  EXPECT_TRUE(join(KeyUse::local, cluster).failure);
  EXPECT_TRUE(join(KeyUse::cluster, local).failure);
  EXPECT_TRUE(served.empty());
}

TEST_F(Intruders, AMasterWithoutClusterKeySaysSo) {
  listen({}, false);
  End& client = join(KeyUse::cluster, cluster);
  ASSERT_TRUE(client.failure);
  EXPECT_EQ(client.failure->problem, ConnectProblem::wrongKey);
  ASSERT_TRUE(until([&] { return refused.size() == 1; }));
  EXPECT_TRUE(contains(refused[0], "does not have")) << refused[0];
}

TEST_F(Intruders, RandomBytesHarmNothing) {
  ConnectionOptions options;
  options.refusalLines = 1000;
  listen(options);
  std::mt19937 random(1);
  std::vector<RawSocket> sockets;
  for (int i = 0; i < 40; ++i) {
    sockets.push_back(RawSocket::dial(listener->endpoint().port));
    std::string bytes = randomBytes(random, 1 + random() % 3000);
    if (i % 2 == 0)
      bytes = std::string("\x16\x03\x01\x02\x00", 5) + bytes;  // looks like TLS at first
    if (i == 0) bytes = "GET / HTTP/1.1\r\n\r\n";
    sockets.back().send(bytes);
    sockets.back().endWriting();
  }
  ASSERT_TRUE(until([&] { return refused.size() == sockets.size(); }));
  EXPECT_TRUE(served.empty());
  EXPECT_FALSE(joinLocal().failure);
}

TEST_F(Intruders, HalfClosedAndSilentPeersAreLetGo) {
  ConnectionOptions options;
  options.handshake = milliseconds(150);
  listen(options);
  const RawSocket gone = RawSocket::dial(listener->endpoint().port);
  gone.endWriting();
  ASSERT_TRUE(until([&] { return refused.size() == 1; }));
  EXPECT_TRUE(contains(refused[0], "lost")) << refused[0];
  const RawSocket silent = RawSocket::dial(listener->endpoint().port);
  ASSERT_TRUE(until([&] { return refused.size() == 2; }));
  EXPECT_TRUE(contains(refused[1], "within 0.1 s") || contains(refused[1], "within 0.2 s"))
      << refused[1];
}

TEST_F(Intruders, TricklingBytesDoNotExtendTheDeadline) {
  ConnectionOptions options;
  options.handshake = milliseconds(150);
  listen(options);
  const RawSocket slow = RawSocket::dial(listener->endpoint().port);
  slow.send(std::string("\x16\x03\x01\x02\x00\x01", 6));
  // One more byte with every look at the clock, for as long as the master listens.
  ASSERT_TRUE(until([&] {
    slow.send("x");
    return !refused.empty();
  }));
  EXPECT_TRUE(contains(refused[0], "did not show its key") ||
              contains(refused[0], "not a Ninefold"));
}

TEST_F(Intruders, BytesBeforeTheKeyAreFew) {
  listen();
  const RawSocket loud = RawSocket::dial(listener->endpoint().port);
  // A handshake record that announces 16 KiB and a ClientHello that never ends.
  loud.send(std::string("\x16\x03\x01\x40\x00\x01\x00\x3f\xfc", 9) + std::string(8000, 'x'));
  ASSERT_TRUE(until([&] { return refused.size() == 1; }));
  EXPECT_TRUE(contains(refused[0], "too much")) << refused[0];
}

TEST_F(Intruders, AFloodPushesOutItselfAndNotUs) {
  ConnectionOptions options;
  options.pendingConnections = 4;
  options.refusalLines = 1000;
  listen(options);
  std::vector<RawSocket> flood;
  for (int i = 0; i < 20; ++i) flood.push_back(RawSocket::dial(listener->endpoint().port));
  EXPECT_FALSE(joinLocal().failure);
  ASSERT_TRUE(until([&] { return refused.size() >= 16; }));
  EXPECT_TRUE(contains(refused[0], "too many others")) << refused[0];
}

TEST_F(Intruders, TheLogIsNotFlooded) {
  ConnectionOptions options;
  options.refusalLines = 3;
  listen(options);
  for (int i = 0; i < 20; ++i) RawSocket::dial(listener->endpoint().port).send("knock knock");
  EXPECT_FALSE(joinLocal().failure);
  ASSERT_TRUE(until([&] { return refused.size() == 3; }));
  EXPECT_FALSE(joinLocal().failure);
  EXPECT_EQ(refused.size(), 3u);
}

TEST(LineLimiter, CountsWhatItSwallowsAndStartsAnew) {
  LineLimiter limiter(2, std::chrono::seconds(10));
  const Time start{};
  EXPECT_EQ(limiter.admit("a", start), "a");
  EXPECT_EQ(limiter.admit("b", start), "b");
  EXPECT_EQ(limiter.admit("c", start), std::nullopt);
  EXPECT_EQ(limiter.admit("d", start + std::chrono::seconds(9)), std::nullopt);
  EXPECT_EQ(limiter.admit("e", start + std::chrono::seconds(10)), "e (and 2 more like it)");
  EXPECT_EQ(limiter.admit("f", start + std::chrono::seconds(11)), "f");
}

TEST_F(Intruders, NobodyListensIsRefused) {
  uint16_t port = 0;
  { port = RawSocket::listen().port(); }
  End& client = dial(port, KeyUse::local, local, {});
  ASSERT_TRUE(until([&] { return client.failure.has_value(); }));
  EXPECT_EQ(client.failure->problem, ConnectProblem::refused);
  EXPECT_TRUE(contains(client.failure->line, "nobody listens"));
}

TEST_F(Intruders, AMasterThatSaysNothingTimesOut) {
  const RawSocket mute = RawSocket::listen();
  ConnectionOptions options;
  options.handshake = milliseconds(100);
  End& client = dial(mute.port(), KeyUse::local, local, options);
  ASSERT_TRUE(until([&] { return client.failure.has_value(); }));
  EXPECT_EQ(client.failure->problem, ConnectProblem::timedOut);
}

// A server that greets its one visitor with `greeting` and hears it out; without greeting it hangs
// up.
void serveOnce(const RawSocket& server, const std::string& greeting) {
  const RawSocket peer = server.accept();
  if (greeting.empty()) return;
  peer.send(greeting);
  char heard[4096];
  while (::recv(peer.descriptor(), heard, sizeof heard, 0) > 0) {
  }
}

TEST_F(Intruders, OtherServersAreNotNinefold) {
  const std::pair<const char*, ConnectProblem> cases[] = {
      {"SSH-2.0-OpenSSH_9.2p1 Debian-2\r\n", ConnectProblem::notNinefold},
      {"HTTP/1.1 400 Bad Request\r\n\r\n", ConnectProblem::notNinefold},
      {"", ConnectProblem::lost}};
  for (const auto& [greeting, problem] : cases) {
    const RawSocket server = RawSocket::listen();
    std::thread answer(serveOnce, std::cref(server), std::string(greeting));
    End& client = dial(server.port(), KeyUse::local, local, {});
    ASSERT_TRUE(until([&] { return client.failure.has_value(); }));
    answer.join();
    EXPECT_EQ(client.failure->problem, problem) << client.failure->line;
    EXPECT_TRUE(contains(client.failure->line, "Ninefold master")) << client.failure->line;
  }
}

TEST_F(Intruders, ListeningBeyondLoopbackNeedsAClusterKey) {
  const auto open = [this](const char* host, uint16_t port, std::shared_ptr<const Key> clusterKey) {
    return Listener::open(loop, {host, port}, {local, std::move(clusterKey)}, {});
  };
  EXPECT_THROW(open("0.0.0.0", 0, nullptr), Error);
  EXPECT_THROW(open("no-address", 0, cluster), Error);
  const auto first = open("0.0.0.0", 0, cluster);
  EXPECT_NE(first->endpoint().port, 0);
  EXPECT_THROW(open("0.0.0.0", first->endpoint().port, cluster), Error) << "taken";
}

TEST(Endpoint, IsAHostAndAPort) {
  EXPECT_EQ(parseEndpoint("192.168.1.20:4700", "--master").host, "192.168.1.20");
  EXPECT_EQ(parseEndpoint("[fd00::1]:4700", "--master").host, "fd00::1");
  EXPECT_EQ(parseEndpoint("render-7:65535", "--master").port, 65535);
  EXPECT_EQ(parseEndpoint("127.0.0.1:0", "--listen").port, 0);
  for (const char* bad :
       {"", ":", "host", "host:", ":80", "host:65536", "host:-1", "host:8x", "a:b:1", "[::1]",
        "[::1]80", "[]:80", "fd00::1:80", "[[::1]]:80", "[::1]]:80", "a]:80", "a b:80", "a\t:80"})
    EXPECT_THROW(parseEndpoint(bad, "--master"), Error) << bad;
}

}  // namespace
}  // namespace ninefold
