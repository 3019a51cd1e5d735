// connection.h: messages over TCP, inside TLS 1.3 with a pre-shared key. Sockets are touched here
// only.
//
//   master: Listener -> Connection          client: connect(...) -> Connection
//
// A Connection exists only after the TLS handshake: its peer has proved that it holds a key. There
// are two. The one-time key is for the clients that the master starts itself. The cluster key is
// for all others; without it a listener takes loopback addresses only. The master always listens
// and the client always dials. Both roles go into the key that TLS sees (tls.h), so nothing that
// one side says can be played back to it.
//
// Deadlines: handshake, first message, silence of the peer, a write that does not move.
// Bounds: peers that have not proved themselves (the oldest is dropped), their bytes, and the queue
// of what is to be sent. A full queue closes the connection: the scheduler's credit keeps a healthy
// peer far below.
// Threads: callbacks run in the loop's thread. send(), finish() and close() from any thread,
// everything else in the loop's.
// Owner: shared_ptr; an open connection keeps itself alive.
// Errors: a running connection throws none; onClosed gets one line.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/clock.h"
#include "proto/event_loop.h"
#include "proto/key.h"
#include "proto/messages.h"

namespace ninefold {

struct Endpoint {
  std::string host;  // name or address, IPv6 without brackets
  uint16_t port = 0;
};
// "host:port", "1.2.3.4:4700", "[::1]:4700"; throws Error naming `flag`.
Endpoint parseEndpoint(std::string_view text, std::string_view flag);
// The other way round.
std::string addressText(const Endpoint& endpoint);
bool isLoopback(const std::string& host);
// Whether it stands for all interfaces of this machine.
bool isAnyAddress(const std::string& host);

struct ConnectionOptions {
  Duration handshake =
      std::chrono::seconds(5);  // dialling included; then the same for the first message
  Duration silence = std::chrono::seconds(20);  // no byte from the peer; heartbeats keep it busy
  Duration write = std::chrono::seconds(20);    // no byte accepted by the peer
  size_t queueBytes = 64 << 20;                 // waiting to be sent
  int refusalLines = 10;                        // of a listener, in ten seconds; others are counted
  size_t pendingConnections = 64;               // of a listener: not yet authenticated
};

class Connection {
 public:
  struct Events {
    // An Error thrown here is the peer's fault: it closes this connection, with its text as reason.
    std::function<void(Message&&)> onMessage;
    // Exactly once, last, whoever closed: one line for people. May destroy the owner's pointer.
    std::function<void(const std::string& reason)> onClosed;
  };
  virtual ~Connection() = default;

  // Begins to read. Once, in the loop's thread.
  virtual void start(Events events) = 0;

  // Queues a message. False if the connection is closed, or closes now because its queue is full.
  virtual bool send(Message message) = 0;

  // Sends what is queued (for a second at most), then closes. Nothing is received any more.
  virtual void finish(std::string reason) = 0;
  // Closes at once.
  virtual void close(std::string reason) = 0;

  virtual KeyUse keyUse() const = 0;
  virtual const std::string& peer() const = 0;  // "address:port"
  virtual uint64_t bytesReceived() const = 0;   // from the network, any thread
  virtual uint64_t bytesSent() const = 0;
  // What the line takes, as far as it was used so far [bytes/s]; 0 if not known. The loop's thread.
  virtual double lineRate() = 0;
};

class Listener {
 public:
  struct Keys {
    std::shared_ptr<const Key> local;    // required
    std::shared_ptr<const Key> cluster;  // may be null: then only loopback
  };
  struct Events {
    std::function<void(std::shared_ptr<Connection>)>
        onConnection;  // authenticated; call start() on it
    std::function<void(const std::string& line)>
        onRefused;  // one line about a peer that failed, for the log
  };
  // Throws Error: address in use, not an address of this machine, beyond loopback without a cluster
  // key.
  static std::unique_ptr<Listener> open(EventLoop& loop, const Endpoint& at, Keys keys,
                                        Events events, ConnectionOptions options = {});
  virtual ~Listener() = default;                 // stops listening and drops the unauthenticated
  virtual const Endpoint& endpoint() const = 0;  // with the port that was really taken
};

enum class ConnectProblem : uint8_t {
  badAddress,   // the name cannot be resolved, yet
  unreachable,  // no route, network down
  refused,      // nobody listens there
  timedOut,
  wrongKey,     // a Ninefold master that does not accept our key
  notNinefold,  // something else answers there
  lost,         // closed in mid-handshake
};

struct ConnectFailure {
  ConnectProblem problem = ConnectProblem::lost;
  std::string line;  // what, where, what to do
};

// One attempt to reach a master. Exactly one of the callbacks is called, later, in the loop's
// thread.
void connect(EventLoop& loop, const Endpoint& to, KeyUse use, std::shared_ptr<const Key> key,
             std::function<void(std::shared_ptr<Connection>)> onConnected,
             std::function<void(const ConnectFailure&)> onFailed, ConnectionOptions options = {});

}  // namespace ninefold
