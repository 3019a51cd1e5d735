// server_report.cpp: what the server tells of itself and its clients.
#include "master/serving/server.h"

namespace ninefold {

std::optional<ClientReport> Server::workOf(const std::string& name, Time now) const {
  std::optional<ClientReport> latest;
  for (const ClientReport& report : scheduler_.report(now))
    if (peers_.at(report.client).session->hello().name == name) latest = report;
  return latest;
}

bool Server::nothingMoves() const {
  const auto isComing = [](const Handle& peer) {
    const ClientSession& session = *peer.second.session;
    return !session.over() && !session.ready() && !session.visits();
  };
  const bool nobodyCan = scheduler_.allAreStuck() || (started_ && scheduler_.clients() == 0);
  return nobodyCan && joining_.empty() && std::ranges::none_of(peers_, isComing);
}

std::string Server::stuckTasks(Time now) const {
  constexpr size_t kLongEnough = 150;
  std::string text;
  for (const ClientReport& report : scheduler_.report(now)) {
    if (!report.stuck || !report.oldest) continue;
    if (text.size() > kLongEnough) return text + ", ...";
    text += fmt::format("{}client {} in {}", text.empty() ? "" : ", ", report.client,
                        nameOf(*report.oldest));
  }
  return text;
}

std::vector<std::string> Server::explain(Time now) const {
  std::vector<std::string> lines = scheduler_.explainFrames(now);
  if (!started_)
    lines.push_back(fmt::format("no frame yet: {} of {} clients are ready (--wait-clients)",
                                scheduler_.clients(), setup_.waitClients));
  else if (lines.empty())
    lines.emplace_back("no frame is open: none is wanted, or there is no room for one");
  for (const auto& [id, peer] : peers_)
    if (!peer.session->over())
      lines.push_back(fmt::format("client {}, {}: {}", id, peer.session->title(),
                                  explainClient(id, *peer.session, now)));
  return lines;
}

std::string Server::explainClient(ClientId id, const ClientSession& session, Time now) const {
  if (session.visits()) return "only looks whether it can join";
  switch (session.status().state) {
    case ClientState::connecting:
      return "has not introduced itself";
    case ClientState::syncing:
      return fmt::format("has {:.0f} % of the scene", 100 * session.status().synced);
    case ClientState::building:
      return "builds the scene";
    default:
      break;
  }
  if (joining_.contains(id))
    return "is ready and waits: open frames are of a job that it has missed";
  return scheduler_.explainClient(id, now);
}

bool Server::isConnected() const {
  return std::ranges::any_of(peers_, [](const auto& p) { return p.second.connection != nullptr; });
}

ServerTally Server::tally() const {
  ServerTally tally = tally_;
  tally.tasks = scheduler_.counts();
  tally.reproducible = admission_.reproducible();
  tally.verification = scheduler_.verificationCounts();
  tally.firstUnsettled = scheduler_.firstUnsettled();
  if (marked_ && scheduler_.isMarkTrusted()) tally.trusted = marked_;
  tally.pixelClass = admission_.pixelClass(), tally.isa = admission_.isa();
  for (const auto& [id, peer] : peers_)
    tally.bytesReceived += peer.connection ? peer.connection->bytesReceived() : peer.bytesReceived;
  return tally;
}

std::vector<ClientInfo> Server::clients(Time now) const {
  std::map<ClientId, ClientReport> work;
  for (const ClientReport& report : scheduler_.report(now)) work[report.client] = report;
  std::vector<ClientInfo> infos;
  for (const auto& [id, peer] : peers_) {
    const ClientSession& session = *peer.session;
    if (session.visits()) continue;
    ClientInfo info{id, session.hello().name, session.hello().isa, session.peer(), session.status(),
                    {}};
    if (const auto found = work.find(id); found != work.end()) info.work = found->second;
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace ninefold
