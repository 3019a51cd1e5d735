// Connections between peers that hold a key: delivery, order, closing, deadlines, bounds.
#include "proto/connection.h"

#include <algorithm>
#include <thread>

#include "tests/proto/network_fixture.h"

namespace ninefold {
namespace {

using Connections = Network;

msg::Result resultOf(size_t bytes, uint32_t tile = 0) {
  msg::Result result;
  result.tile = tile;
  result.encoded.assign(bytes, std::byte{42});
  return result;
}

TEST_F(Connections, BothKeysOpenTheDoor) {
  listen();
  joinLocal();
  join(KeyUse::cluster, cluster);
  ASSERT_EQ(served.size(), 2u);
  EXPECT_EQ(served[0]->connection->keyUse(), KeyUse::local);
  EXPECT_EQ(served[1]->connection->keyUse(), KeyUse::cluster);
  EXPECT_TRUE(refused.empty());
}

TEST_F(Connections, MessagesArriveBothWaysAndInOrder) {
  listen();
  End& client = joinLocal();
  client.connection->send(msg::Hello{});
  served[0]->connection->send(msg::Welcome{7});
  for (uint32_t i = 0; i < 300; ++i) client.connection->send(resultOf(i * 997 % 100000, i));
  ASSERT_TRUE(until([&] { return served[0]->got.size() == 301 && client.got.size() == 1; }));
  EXPECT_EQ(std::get<msg::Welcome>(client.got[0]).clientId, 7u);
  for (uint32_t i = 0; i < 300; ++i) {
    const auto& result = std::get<msg::Result>(served[0]->got[i + 1]);
    ASSERT_EQ(result.tile, i);
    ASSERT_EQ(result.encoded.size(), i * 997 % 100000);
  }
  EXPECT_GT(served[0]->connection->bytesReceived(), 10u << 20);
  EXPECT_EQ(served[0]->connection->bytesReceived(), client.connection->bytesSent());
}

TEST_F(Connections, ManyThreadsMaySend) {
  listen();
  End& client = joinLocal();
  client.connection->send(msg::Hello{});
  std::vector<std::thread> threads;
  for (uint32_t t = 0; t < 4; ++t)
    threads.emplace_back([&client, t] {
      for (uint32_t i = 0; i < 200; ++i) client.connection->send(resultOf(1000, t * 1000 + i));
    });
  ASSERT_TRUE(until([&] { return served[0]->got.size() == 801; }));
  for (std::thread& thread : threads) thread.join();
  std::vector<uint32_t> next(4);
  for (size_t i = 1; i <= 800; ++i) {
    const uint32_t tile = std::get<msg::Result>(served[0]->got[i]).tile;
    EXPECT_EQ(tile % 1000, next[tile / 1000]++) << "each thread's messages keep their order";
  }
}

TEST_F(Connections, LastWordsAreHeardBeforeTheEnd) {
  listen();
  End& client = joinLocal();
  client.connection->send(msg::Hello{});
  ASSERT_TRUE(until([&] { return !served[0]->got.empty(); }));
  for (uint32_t i = 0; i < 20; ++i) client.connection->send(resultOf(60000, i));  // still in flight
  served[0]->connection->send(msg::Refuse{"another release"});
  served[0]->connection->finish("refused");
  EXPECT_FALSE(served[0]->connection->send(msg::Ping{}));
  ASSERT_TRUE(until([&] { return !client.closed.empty() && !served[0]->closed.empty(); }));
  ASSERT_EQ(client.got.size(), 1u);
  EXPECT_EQ(std::get<msg::Refuse>(client.got[0]).reason, "another release");
  EXPECT_EQ(served[0]->closed, "refused");
}

TEST_F(Connections, CloseIsToldOnceOnBothSides) {
  listen();
  End& client = joinLocal();
  client.connection->close("enough");
  client.connection->close("again");
  EXPECT_FALSE(client.connection->send(msg::Ping{}));
  ASSERT_TRUE(until([&] { return !client.closed.empty() && !served[0]->closed.empty(); }));
  EXPECT_EQ(client.closed, "enough");
}

TEST_F(Connections, AnErrorOfTheHandlerClosesOnlyThatConnection) {
  listen();
  startClients = false;
  End& client = joinLocal();
  client.connection->start({[](Message&&) { fail("this message makes no sense now"); },
                            [&](const std::string& reason) { client.closed = reason; }});
  startClients = true;
  End& other = joinLocal();
  served[0]->connection->send(msg::Ping{});
  ASSERT_TRUE(until([&] { return !client.closed.empty() && !served[0]->closed.empty(); }));
  EXPECT_EQ(client.closed, "this message makes no sense now");
  EXPECT_EQ(other.closed, "");
}

TEST_F(Connections, TheFirstMessageMustBeSmall) {
  listen();
  End& client = joinLocal();
  client.connection->send(resultOf(100000));
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty() && !client.closed.empty(); }));
  EXPECT_NE(served[0]->closed.find("announces"), std::string::npos) << served[0]->closed;
}

TEST_F(Connections, WordsOfTheOtherSideAreRefused) {
  listen();
  End& client = joinLocal();
  client.connection->send(msg::Welcome{});
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty(); }));
  EXPECT_NE(served[0]->closed.find("Welcome"), std::string::npos) << served[0]->closed;
}

TEST_F(Connections, SilenceHasADeadline) {
  ConnectionOptions options;
  options.silence = milliseconds(100);
  listen(options);
  End& client = joinLocal();
  client.connection->send(msg::Hello{});
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty(); }));
  EXPECT_EQ(served[0]->got.size(), 1u);
  EXPECT_EQ(served[0]->closed, "no sign of life for 0.1 s");
}

TEST_F(Connections, TheFirstMessageHasADeadline) {
  ConnectionOptions options;
  options.handshake = milliseconds(300);
  listen(options);
  joinLocal();
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty(); }));
  EXPECT_EQ(served[0]->closed, "no first message within 0.3 s");
}

TEST_F(Connections, APeerThatTakesNothingIsGivenUp) {
  ConnectionOptions options;
  options.write = milliseconds(200);
  listen(options);
  startClients = false;  // never reads
  joinLocal();
  for (int i = 0; i < 200; ++i)
    served[0]->connection->send(
        msg::BlobChunk{{}, 0, kBlobChunkBytes, Bytes(kBlobChunkBytes, std::byte{0})});
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty(); }));
  EXPECT_EQ(served[0]->closed, "the peer took nothing for 0.2 s");
}

TEST_F(Connections, AFullQueueClosesInsteadOfGrowing) {
  ConnectionOptions options;
  options.queueBytes = 1 << 20;
  listen(options);
  startClients = false;
  joinLocal();
  int taken = 0;
  while (taken < 1000 && served[0]->connection->send(msg::BlobChunk{
                             {}, 0, kBlobChunkBytes, Bytes(kBlobChunkBytes, std::byte{0})}))
    ++taken;
  EXPECT_EQ(taken, 3) << "a fourth chunk and its head are more than 1 MiB";
  ASSERT_TRUE(until([&] { return !served[0]->closed.empty(); }));
  EXPECT_NE(served[0]->closed.find("queue is full"), std::string::npos);
}

TEST_F(Connections, AClosedListenerLetsNobodyInAndKeepsItsConnections) {
  listen();
  End& client = joinLocal();
  const uint16_t port = listener->endpoint().port;
  listener.reset();
  End& late = dial(port, KeyUse::local, local, {});
  client.connection->send(msg::Hello{});
  ASSERT_TRUE(until([&] { return late.failure && served[0]->got.size() == 1; }));
  EXPECT_EQ(late.failure->problem, ConnectProblem::refused);
}

TEST_F(Connections, DroppingTheLoopWithOpenConnectionsIsClean) {
  listen();
  auto own = std::make_unique<EventLoop>();
  std::shared_ptr<Connection> connection;
  connect(
      *own, listener->endpoint(), KeyUse::local, local,
      [&](std::shared_ptr<Connection> c) {
        c->start({[](Message&&) {}, [](const std::string&) {}});
        own->stop();
      },
      [](const ConnectFailure&) {});
  std::thread master([&] { until([&] { return !served.empty(); }); });
  own->run();
  master.join();
  own.reset();  // the connection was open: its coroutines die with the loop
  EXPECT_TRUE(until([&] { return !served[0]->closed.empty(); }));
}

}  // namespace
}  // namespace ninefold
