#include "master/scheduling/verification.h"

#include <algorithm>
#include <utility>

#include "common/base/error.h"
#include "common/sampling/hash.h"

namespace ninefold {

bool Verification::isChosen(const TaskId& task) const {
  const uint64_t hash = hashWords(seed_, uint64_t{task.frame}, static_cast<uint64_t>(task.tile));
  return static_cast<double>(hash) < fraction_ * 0x1p64;
}

void Verification::joined(ClientId client, const std::string& pixelClass) {
  givers_[client].pixelClass = pixelClass;
  review();
}

void Verification::lost(ClientId client) {
  const auto giver = givers_.find(client);
  if (giver == givers_.end()) return;
  giver->second.present = false;
  release(client);
}

void Verification::release(ClientId client) {
  for (auto& [task, check] : checks_)
    if (check.holder == client) check.holder.reset();
  review();
}

bool Verification::hasOpinion(const Check& check, ClientId client) const {
  return std::ranges::find(check.opinions, client, &Opinion::client) != check.opinions.end();
}

bool Verification::mayCheck(ClientId client, const Check& check) const {
  const Giver& first = givers_.at(check.opinions.front().client);
  const Giver& giver = givers_.at(client);
  return giver.present && giver.pixelClass == first.pixelClass && !hasOpinion(check, client);
}

bool Verification::canGoOn(const Check& check) const {
  return std::ranges::any_of(givers_,
                             [&](const auto& giver) { return mayCheck(giver.first, check); });
}

void Verification::accepted(ClientId client, const HeldTask& task,
                            const std::optional<Digest>& digest,
                            const std::vector<ClientId>& copies) {
  if (!isOn()) return;
  givers_.at(client).latest[task.isStep] = ++order_;
  if (!isChosen(task.task)) return;
  NINEFOLD_CHECK(digest.has_value());
  Check check{task, {{client, *digest, order_}}};
  if (!canGoOn(check)) {
    ++counts_.alone;
    return;
  }
  const auto copy = std::ranges::find_if(copies, [&](ClientId c) { return mayCheck(c, check); });
  if (copy != copies.end()) check.holder = *copy;
  checks_.emplace(task.task, std::move(check));
}

bool Verification::expects(ClientId client, const TaskId& task) const {
  const auto found = checks_.find(task);
  return found != checks_.end() && found->second.holder == client;
}

void Verification::answered(ClientId client, const TaskId& task, const Digest& digest) {
  const auto found = checks_.find(task);
  NINEFOLD_CHECK(found != checks_.end() && found->second.holder == client);
  Check& check = found->second;
  check.holder.reset();
  givers_.at(client).latest[check.task.isStep] = ++order_;
  check.opinions.push_back({client, digest, order_});
  judge(found);
}

// The latest opinion may agree with one before it: those that differ from the two are wrong.
void Verification::judge(Checks::iterator found) {
  const Check& check = found->second;
  const Digest& latest = check.opinions.back().digest;
  const auto agrees = [&](const Opinion& opinion) { return opinion.digest == latest; };
  if (std::ranges::count_if(check.opinions, agrees) < 2) return review();
  ++counts_.checked;
  for (const Opinion& opinion : check.opinions) {
    Giver& giver = givers_.at(opinion.client);
    uint64_t& agreed = giver.agreed[check.task.isStep];
    if (agrees(opinion))
      agreed = std::max(agreed, opinion.order);
    else
      ++counts_.wrong, wrong_.push_back({opinion.client, check.task});
  }
  checks_.erase(found);
}

// What nobody is there to check is left; a dispute waits until somebody is.
void Verification::review() {
  for (auto next = checks_.begin(); next != checks_.end();) {
    const auto check = next++;
    if (check->second.holder || canGoOn(check->second)) continue;
    if (!check->second.isDispute())
      ++counts_.alone;
    else if (++counts_.disputed; disputes_.size() < kMostDisputes)
      disputes_.insert(*check);
    checks_.erase(check);
  }
  for (auto next = disputes_.begin(); next != disputes_.end();) {
    const auto dispute = next++;
    if (!canGoOn(dispute->second)) continue;
    --counts_.disputed;
    checks_.insert(*dispute);
    disputes_.erase(dispute);
  }
}

std::optional<HeldTask> Verification::next(
    ClientId client, const std::function<bool(const TaskId&)>& mayHold) const {
  for (const auto& [task, check] : checks_)
    if (!check.holder && mayCheck(client, check) && mayHold(task)) return check.task;
  return std::nullopt;
}

void Verification::given(ClientId client, const TaskId& task) { checks_.at(task).holder = client; }

void Verification::drop(uint32_t firstWanted, bool steps) {
  const auto isVoid = [&](const auto& check) {
    return check.first.frame < firstWanted && check.second.task.isStep == steps;
  };
  std::erase_if(checks_, isVoid);
  counts_.disputed -= std::erase_if(disputes_, isVoid);
}

bool Verification::isOpen(uint32_t frame) const {
  const auto isOf = [frame](const Checks& checks) {
    const auto first = checks.lower_bound({frame, INT32_MIN, INT32_MIN});
    return first != checks.end() && first->first.frame == frame;
  };
  return isOf(checks_) || isOf(disputes_);
}

std::optional<uint32_t> Verification::firstOpen() const {
  return checks_.empty() ? std::nullopt : std::optional(checks_.begin()->first.frame);
}

void Verification::mark() {
  mark_ = Mark{order_, {}};
  for (const auto& [client, giver] : givers_) mark_->latest[client] = giver.latest;
}

bool Verification::isTrusted() const {
  if (!mark_) return false;
  const auto isOlder = [this](const auto& check) {
    return check.second.opinions.front().order <= mark_->order;
  };
  if (std::ranges::any_of(checks_, isOlder) || std::ranges::any_of(disputes_, isOlder))
    return false;
  const auto isAlone = [this](ClientId client, const Giver& giver) {
    return std::ranges::none_of(givers_, [&](const auto& other) {
      return other.first != client && other.second.present &&
             other.second.pixelClass == giver.pixelClass;
    });
  };
  return std::ranges::all_of(mark_->latest, [&](const auto& latest) {
    const Giver& giver = givers_.at(latest.first);
    const auto& [tasks, units] = latest.second;
    const bool isVouchedFor = giver.agreed[0] >= tasks && giver.agreed[1] >= units;
    return isVouchedFor || !giver.present || isAlone(latest.first, giver);
  });
}

std::vector<std::pair<ClientId, TaskId>> Verification::holders() const {
  std::vector<std::pair<ClientId, TaskId>> all;
  for (const auto& [task, check] : checks_)
    if (check.holder) all.emplace_back(*check.holder, task);
  return all;
}

}  // namespace ninefold
