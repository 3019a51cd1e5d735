#include "master/serving/state_keeper.h"

#include "common/base/error.h"
#include "proto/state_wire.h"

namespace ninefold {

void StateKeeper::resume(uint32_t version, StatePages pages) {
  NINEFOLD_CHECK(versions_.empty());
  versions_[version] = {std::move(pages), {}};
  oldest_ = version;
}

void StateKeeper::open(const StepKey& step) {
  NINEFOLD_CHECK(step.to > version());
  NINEFOLD_CHECK(step.from == 0 || versions_.contains(step.from));
  open_[step.number] = {step, {}};
}

void StateKeeper::drop(uint32_t firstWanted) {
  std::erase_if(open_, [&](const auto& step) { return step.first < firstWanted; });
}

const StatePages& StateKeeper::pagesOf(uint32_t version) const {
  static const StatePages kEmpty;
  return version == 0 ? kEmpty : versions_.at(version).pages;
}

void StateKeeper::take(msg::Stepped&& result) {
  Step& step = open_.at(result.number);
  const uint64_t hash = pagesOf(step.key.from).hash();
  if (result.stateHash != hash)
    fail(
        "unit {} of step {} was made of another state: version {} has the hash {:016x} there, "
        "{:016x} "
        "here",
        result.unit, result.number, step.key.from, result.stateHash, hash);
  PageDeltas deltas = decodeDeltas(result.deltas);
  pagesOf(step.key.from).check(deltas);  // what cannot be by itself is this client's fault
  step.results[result.unit] = {std::move(deltas), std::move(result.deltas)};
}

const std::vector<msg::StateDelta>& StateKeeper::complete(uint32_t number) {
  Step step = std::move(open_.at(number));
  open_.erase(number);
  NINEFOLD_CHECK(step.results.size() == step.key.units);
  Version version{pagesOf(step.key.from), {}};
  std::vector<PageDeltas> all;
  for (auto& [unit, result] : step.results) all.push_back(std::move(result.first));
  version.pages.applyAll(all);
  if (version.pages.all().size() > kMaxStatePages)
    fail("a method's state has {} pages; it may have {}", version.pages.all().size(),
         kMaxStatePages);
  const auto parts = static_cast<uint32_t>(step.results.size());
  for (auto& [unit, result] : step.results) {
    const auto part = static_cast<uint32_t>(version.messages.size());
    version.messages.push_back({step.key.from, step.key.to, part, parts, version.pages.hash(),
                                oldest_, std::move(result.second)});
  }
  return versions_.insert_or_assign(step.key.to, std::move(version)).first->second.messages;
}

void StateKeeper::forget(uint32_t oldest) {
  if (oldest <= oldest_) return;
  oldest_ = oldest;
  snapshot_.reset();
  std::erase_if(versions_, [&](const auto& v) { return v.first < oldest; });
}

std::shared_ptr<const StateKeeper::Snapshot> StateKeeper::snapshot() {
  if (oldest_ == 0 || !versions_.contains(oldest_)) return nullptr;
  if (snapshot_) return snapshot_;
  const StatePages& pages = versions_.at(oldest_).pages;
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->offer.version = oldest_;
  snapshot->offer.hash = pages.hash();
  for (const auto& [id, page] : pages.all()) {
    Blob blob = packPage(id, *page);
    snapshot->offer.pages.push_back({id, blob.info});
    snapshot->blobs.emplace(blob.info.hash, std::move(blob));
  }
  return snapshot_ = std::move(snapshot);
}

std::vector<msg::StateDelta> StateKeeper::since() const {
  std::vector<msg::StateDelta> messages;
  for (const auto& [number, version] : versions_)
    if (number > oldest_)
      messages.insert(messages.end(), version.messages.begin(), version.messages.end());
  return messages;
}

}  // namespace ninefold
