// network_fixture.h: a listener and clients on loopback in one event loop, for the connection's
// tests.
#pragma once

#include <gtest/gtest.h>

#include "proto/connection.h"

namespace ninefold {

// One end of a connection and what it has seen.
struct End {
  std::shared_ptr<Connection> connection;
  std::vector<Message> got;
  std::string closed;  // reason; empty while open
  std::optional<ConnectFailure> failure;
};

class Network : public testing::Test {
 protected:
  void listen(ConnectionOptions options = {}, bool withCluster = true) {
    Listener::Events events;
    events.onConnection = [this](std::shared_ptr<Connection> c) {
      served.push_back(std::make_unique<End>());
      attach(*served.back(), std::move(c));
    };
    events.onRefused = [this](const std::string& line) { refused.push_back(line); };
    listener = Listener::open(loop, {"127.0.0.1", 0}, {local, withCluster ? cluster : nullptr},
                              std::move(events), options);
  }
  static void attach(End& end, std::shared_ptr<Connection> c) {
    end.connection = std::move(c);
    end.connection->start({[&end](Message&& m) { end.got.push_back(std::move(m)); },
                           [&end](const std::string& reason) { end.closed = reason; }});
  }
  // Dials and waits for the outcome on both sides.
  End& join(KeyUse use, const std::shared_ptr<const Key>& key, ConnectionOptions options = {}) {
    const size_t before = served.size();
    End& end = dial(listener->endpoint().port, use, key, options);
    EXPECT_TRUE(until([&] { return end.failure || (end.connection && served.size() > before); }));
    return end;
  }
  End& joinLocal(ConnectionOptions options = {}) { return join(KeyUse::local, local, options); }
  End& dial(uint16_t port, KeyUse use, const std::shared_ptr<const Key>& key,
            ConnectionOptions options) {
    End& end = *clients.emplace_back(std::make_unique<End>());
    connect(
        loop, {"127.0.0.1", port}, use, key,
        [&end, this](std::shared_ptr<Connection> c) {
          if (startClients)
            attach(end, std::move(c));
          else
            end.connection = std::move(c);
        },
        [&end](const ConnectFailure& failure) { end.failure = failure; }, options);
    return end;
  }

  // Runs the loop until `done`; false if that does not come in generous time.
  bool until(const std::function<bool()>& done) {
    const auto tooLate = loop.after(std::chrono::seconds(20), [this] { loop.stop(); });
    std::unique_ptr<EventLoop::Timer> next;
    const std::function<void()> look = [&] {
      if (done()) return loop.stop();
      next = loop.after(milliseconds(1), look);
    };
    loop.post(look);
    loop.run();
    return done();
  }

  EventLoop loop;
  std::shared_ptr<const Key> local = std::make_shared<Key>(Key::random());
  std::shared_ptr<const Key> cluster = std::make_shared<Key>(Key::random());
  std::unique_ptr<Listener> listener;
  std::vector<std::unique_ptr<End>> served, clients;
  std::vector<std::string> refused;
  bool startClients = true;
};

}  // namespace ninefold
