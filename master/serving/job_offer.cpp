#include "master/serving/job_offer.h"

#include <algorithm>
#include <iterator>

#include "common/base/error.h"
#include "proto/edit_messages.h"

namespace ninefold {

JobOffer::JobOffer(std::vector<Blob> blobs, const Settings& settings, const Delivery& delivery)
    : blobs_(std::move(blobs)), settings_(settings), delivery_(delivery) {
  for (const Blob& blob : blobs_) byHash_[blob.info.hash] = &blob;
}

void JobOffer::setJob(uint32_t version, const Settings& settings, const Delivery& delivery) {
  NINEFOLD_CHECK(version > job_);
  job_ = version;
  settings_ = settings;
  delivery_ = delivery;
}

std::vector<msg::Edit> JobOffer::setEdit(uint32_t version, const SceneEdit& edit, bool moving) {
  NINEFOLD_CHECK(version > version_);
  version_ = version;
  edits_.add(edit, moving);
  return editMessages(version, edit, moving);
}

std::vector<msg::Edit> JobOffer::allEdits() const {
  std::vector<msg::Edit> edits;
  if (!edits_.settled.empty()) edits = editMessages(version_, edits_.settled, false);
  if (!edits_.moving.empty())
    std::ranges::copy(editMessages(version_, edits_.moving, true), std::back_inserter(edits));
  return edits;
}

msg::SceneOffer JobOffer::sceneOffer() const {
  msg::SceneOffer offer{kScene, {}};
  for (const Blob& blob : blobs_) offer.blobs.push_back(blob.info);
  return offer;
}

msg::BlobChunk JobOffer::piece(const msg::BlobRequest& request) const {
  const auto found = byHash_.find(request.hash);
  if (found == byHash_.end()) fail("asked for a part of the scene that does not exist");
  return pieceOf(*found->second, request);
}

msg::BlobChunk pieceOf(const Blob& blob, const msg::BlobRequest& request) {
  const ByteView all = blob.compressed;
  if (request.offset >= all.size()) fail("asked for a piece of a blob that does not exist");
  const auto offset = static_cast<size_t>(request.offset);
  const ByteView piece = all.subspan(offset, std::min(kBlobChunkBytes, all.size() - offset));
  return {request.hash, request.offset, all.size(), Bytes(piece.begin(), piece.end())};
}

}  // namespace ninefold
