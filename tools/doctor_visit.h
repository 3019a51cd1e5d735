// doctor_visit.h: what ninefold-doctor finds out about a master by visiting it.
//
//   dial, TLS -> Hello(visits) -> Welcome | Refuse -> kPings pings -> pieces of the scene for
//   kLoadTime -> Goodbye
//
// Each step that fails ends the visit; all others are then findings that were skipped.
//   round trip   the shortest of the pings
//   clock        the master's clock at Welcome + half a round trip, less ours
//   line         bytes received in the time from the first piece's request on, while kInFlight
//                pieces are asked for at once; the largest part of the scene over and over
//
// Threads: everything in the loop's, which run() runs.   Errors: none thrown.
#pragma once

#include <algorithm>
#include <memory>

#include "proto/connection.h"
#include "tools/doctor_finding.h"

namespace ninefold {

struct VisitFacts {
  std::optional<ConnectFailure> failure;
  std::string peer;  // address:port; empty: not connected
  Duration connected{0};
  std::optional<msg::Welcome> welcome;
  uint64_t ourClockMs = 0;  // when it came
  std::string refusal;      // empty: none
  std::string lost;         // why the connection ended too early; empty: it did not
  std::optional<Duration> roundTrip;
  uint64_t loadBytes = 0;
  Duration loadTime{0};
};

class Visit {
 public:
  static constexpr int kPings = 10;
  static constexpr size_t kInFlight = 8;
  static constexpr Duration kLoadTime = std::chrono::seconds(1);
  static constexpr Duration kWithin = std::chrono::seconds(15);  // all of it

  Visit(const Endpoint& master, std::shared_ptr<const Key> key, msg::Hello hello)
      : master_(master), key_(std::move(key)), hello_(std::move(hello)) {
    hello_.visits = true;
  }

  VisitFacts run() {
    begun_ = Clock::now();
    connect(
        loop_, master_, KeyUse::cluster, key_,
        [this](std::shared_ptr<Connection> c) { begin(std::move(c)); },
        [this](const ConnectFailure& failure) {
          facts_.failure = failure;
          loop_.stop();
        });
    const auto deadline = loop_.after(kWithin, [this] {
      facts_.lost = "it does not answer";
      loop_.stop();
    });
    loop_.run();
    return facts_;
  }

 private:
  void begin(std::shared_ptr<Connection> connection) {
    connection_ = std::move(connection);
    facts_.peer = connection_->peer();
    facts_.connected = Clock::now() - begun_;
    Connection::Events events;
    events.onMessage = [this](Message&& m) { receive(m); };
    events.onClosed = [this](const std::string& reason) {
      if (!ending_ && facts_.refusal.empty()) facts_.lost = reason;
      loop_.stop();
    };
    connection_->start(std::move(events));
    connection_->send(hello_);
  }

  void receive(const Message& message) {
    if (const auto* m = std::get_if<msg::Refuse>(&message)) facts_.refusal = m->reason;
    if (const auto* m = std::get_if<msg::Welcome>(&message)) welcome(*m);
    if (const auto* m = std::get_if<msg::SceneOffer>(&message)) choosePart(*m);
    if (const auto* m = std::get_if<msg::Pong>(&message)) answered(*m);
    if (const auto* m = std::get_if<msg::BlobChunk>(&message)) take(*m);
    if (const auto* m = std::get_if<msg::Ping>(&message))
      connection_->send(msg::Pong{m->clockNs, nowNs()});
  }

  void welcome(const msg::Welcome& m) {
    facts_.welcome = m;
    facts_.ourClockMs = wallClockMs();
    connection_->send(msg::Ping{nowNs()});
  }

  void choosePart(const msg::SceneOffer& offer) {
    const auto largest = std::ranges::max_element(offer.blobs, {}, &BlobInfo::rawBytes);
    if (largest != offer.blobs.end()) part_ = largest->hash;
  }

  void answered(const msg::Pong& m) {
    const uint64_t now = nowNs();
    if (m.echoNs > now) return;
    const Duration time = std::chrono::nanoseconds(now - m.echoNs);
    facts_.roundTrip = std::min(facts_.roundTrip.value_or(time), time);
    if (++pings_ < kPings) return void(connection_->send(msg::Ping{now}));
    if (pings_ > kPings || !part_) return leave();
    loadBegun_ = Clock::now();
    beforeLoad_ = connection_->bytesReceived();
    for (size_t i = 0; i < kInFlight; ++i) ask(0);
  }

  void ask(uint64_t offset) { connection_->send(msg::BlobRequest{*part_, offset}); }

  void take(const msg::BlobChunk& m) {
    facts_.loadTime = Clock::now() - loadBegun_;
    facts_.loadBytes = connection_->bytesReceived() - beforeLoad_;
    if (facts_.loadTime > kLoadTime) return leave();
    const uint64_t next = m.offset + m.bytes.size();
    ask(next < m.total ? next : 0);
  }

  void leave() {
    if (std::exchange(ending_, true)) return;
    connection_->send(msg::Goodbye{"it has seen enough"});
    connection_->finish("done");
  }

  static uint64_t nowNs() {
    const auto since = Clock::now().time_since_epoch();
    return static_cast<uint64_t>(std::chrono::nanoseconds(since).count());
  }

  EventLoop loop_;
  const Endpoint master_;
  const std::shared_ptr<const Key> key_;
  msg::Hello hello_;
  VisitFacts facts_;
  std::shared_ptr<Connection> connection_;
  std::optional<Sha256> part_;
  Time begun_{}, loadBegun_{};
  uint64_t beforeLoad_ = 0;
  int pings_ = 0;
  bool ending_ = false;
};

}  // namespace ninefold
