// doctor_verdict.h: what the facts of a visit (doctor_visit.h) mean.
// Threads: pure.   Errors: none.
#pragma once

#include <cmath>

#include "tools/doctor_finding.h"
#include "tools/doctor_visit.h"

namespace ninefold {

inline constexpr double kLateMs = 50;  // a round trip that people feel
inline constexpr double kSlowMB = 2;   // a second; a client sends about that much
inline constexpr double kSkewedS = 5;  // clocks in two logs

inline bool isProblem(const VisitFacts& v, std::initializer_list<ConnectProblem> problems) {
  return v.failure && std::ranges::find(problems, v.failure->problem) != problems.end();
}

inline Finding skipped(const char* what) { return {Grade::skipped, what, "not looked at"}; }

// `noKey`: why the visit went without the user's key.
inline Findings judgeReach(const VisitFacts& v, const Endpoint& master,
                           const std::optional<Finding>& noKey) {
  using enum ConnectProblem;
  const Finding key = noKey.value_or(skipped("key"));
  if (isProblem(v, {badAddress}))
    return {{Grade::bad, "name", v.failure->line}, skipped("port"), key};
  Findings all{
      {Grade::good, "name",
       v.peer.empty() ? master.host + " is found" : fmt::format("{} is {}", master.host, v.peer)}};
  if (isProblem(v, {unreachable, refused, timedOut, notNinefold, lost})) {
    all.push_back({Grade::bad, "port", v.failure->line});
    all.push_back(key);
    return all;
  }
  all.push_back({Grade::good, "port", fmt::format("a master answers at {}", master.port)});
  if (noKey)
    all.push_back(key);
  else if (v.failure)
    all.push_back({Grade::bad, "key", v.failure->line});
  else
    all.push_back({Grade::good, "key",
                   fmt::format("accepted, TLS 1.3 within {:.1f} ms", 1e3 * seconds(v.connected))});
  return all;
}

inline Finding judgeRelease(const VisitFacts& v) {
  if (!v.refusal.empty()) return {Grade::bad, "release", v.refusal};
  if (!v.welcome)
    return {Grade::bad, "release", v.lost.empty() ? "the master says nothing" : v.lost,
            "look into its log"};
  if (v.welcome->release != releaseName())
    return {Grade::bad, "release",
            fmt::format("{} there, {} here", v.welcome->release, releaseName()),
            "install one release on both"};
  return {Grade::good, "release", v.welcome->release + " on both"};
}

inline Finding judgeClass(const msg::Welcome& welcome, const msg::Hello& ours) {
  if (welcome.probeClass.empty()) return {Grade::good, "pixel class", "no client has set one yet"};
  if (welcome.probeClass == ours.probeClass)
    return {Grade::good, "pixel class", "that of the other clients"};
  return {Grade::note, "pixel class",
          fmt::format("{} here, {} in the run: pictures are not the same to the last bit",
                      ours.probeClass, welcome.probeClass),
          "--isa avx2 on all makes them alike, with one version of Embree"};
}

inline Finding judgeClock(const VisitFacts& v) {
  const double trip = v.roundTrip ? seconds(*v.roundTrip) : 0;
  const double ahead =
      1e-3 * (static_cast<double>(v.welcome->wallClockMs) - static_cast<double>(v.ourClockMs)) +
      trip / 2;
  const std::string found = fmt::format("the master's is {:+.3f} s ahead", ahead);
  if (std::abs(ahead) <= kSkewedS) return {Grade::good, "clock", found};
  return {Grade::note, "clock", found,
          "pictures do not mind, logs do not go together: set the time (timedatectl set-ntp true)"};
}

inline Finding judgeRoundTrip(Duration trip) {
  const double ms = 1e3 * seconds(trip);
  const std::string found = fmt::format("{:.2f} ms", ms);
  if (ms <= kLateMs) return {Grade::good, "round trip", found};
  return {Grade::note, "round trip", found, "good enough at rest; what moves is seen that late"};
}

inline Finding judgeLine(uint64_t bytes, Duration time) {
  if (bytes == 0 || time == Duration{0}) return {Grade::skipped, "line", "no scene to fetch"};
  const double rate = 1e-6 * static_cast<double>(bytes) / seconds(time);
  const std::string found = fmt::format("{:.1f} MB/s from the master", rate);
  if (rate >= kSlowMB) return {Grade::good, "line", found};
  return {Grade::note, "line", found,
          "the master's --filter-at clients takes a third of the bytes"};
}

inline Findings judgeVisit(const VisitFacts& v, const msg::Hello& ours) {
  Findings all{v.failure ? skipped("release") : judgeRelease(v)};
  if (all[0].grade != Grade::good) {
    for (const char* what : {"pixel class", "clock", "round trip", "line"})
      all.push_back(skipped(what));
    return all;
  }
  all.push_back(judgeClass(*v.welcome, ours));
  all.push_back(judgeClock(v));
  all.push_back(v.roundTrip
                    ? judgeRoundTrip(*v.roundTrip)
                    : Finding{Grade::bad, "round trip", "no answer", "look into the master's log"});
  all.push_back(judgeLine(v.loadBytes, v.loadTime));
  return all;
}

}  // namespace ninefold
