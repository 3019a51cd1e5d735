#include "client/state_store.h"

#include <algorithm>

#include "common/base/error.h"
#include "proto/state_wire.h"

namespace ninefold {
namespace {

constexpr size_t kWaiting = 65536;  // messages, while pages are fetched

}  // namespace

void StateStore::offer(msg::StateOffer&& offer) {
  clear();
  std::vector<BlobInfo> blobs;
  for (const StatePage& page : offer.pages) blobs.push_back(page.blob);
  fetch_ = BlobFetch(std::move(blobs));
  offered_ = std::move(offer);
  if (fetch_.complete()) keep(offered_->version, offered_->hash, {}), offered_.reset();
}

void StateStore::chunk(msg::BlobChunk&& chunk) {
  const auto whole = fetch_.chunk(std::move(chunk));
  if (!whole) return;
  const auto page = std::ranges::find(offered_->pages, whole->blob, &StatePage::blob);
  fetched_.apply({unpackPage(*page, whole->compressed)});
  if (!fetch_.complete()) return;
  keep(offered_->version, offered_->hash, std::move(fetched_));
  offered_.reset();
  for (const msg::StateDelta& delta : std::exchange(waiting_, {})) apply(delta);
}

void StateStore::add(msg::StateDelta&& delta) {
  if (isWhole()) return apply(delta);
  if (waiting_.size() == kWaiting) fail("more deltas of the state than can wait for its pages");
  waiting_.push_back(std::move(delta));
}

void StateStore::apply(const msg::StateDelta& delta) {
  if (delta.part == 0) {
    const Pages from = find(delta.from);
    if (!from) fail("a delta of version {} of the state, which is not there", delta.from);
    building_ = Building{delta.to, from};
  }
  if (!building_ || building_->version != delta.to || building_->parts.size() != delta.part)
    fail("part {} of version {} of the state does not follow", delta.part, delta.to);
  building_->parts.push_back(decodeDeltas(delta.deltas));
  if (delta.part + 1 < delta.parts) return;
  StatePages pages = *building_->from;
  pages.applyAll(building_->parts);
  keep(delta.to, delta.hash, std::move(pages));
  building_.reset();
  std::erase_if(versions_, [&](const auto& version) { return version.first < delta.oldest; });
}

void StateStore::keep(uint32_t version, uint64_t hash, StatePages&& pages) {
  if (pages.hash() != hash)
    fail("version {} of the state has the hash {:016x} here, {:016x} at the master", version,
         pages.hash(), hash);
  versions_[version] = std::make_shared<const StatePages>(std::move(pages));
}

StateStore::Pages StateStore::find(uint32_t version) const {
  static const auto kEmpty = std::make_shared<const StatePages>();
  if (version == 0) return kEmpty;
  const auto found = versions_.find(version);
  return found == versions_.end() ? nullptr : found->second;
}

}  // namespace ninefold
