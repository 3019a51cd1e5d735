#include "client/scene_builder.h"

#include <set>
#include <utility>

#include "common/base/error.h"
#include "proto/scene_blobs.h"

namespace ninefold {
namespace {

// A question for each blob of the largest scene, and some for what comes after it.
constexpr size_t kQuestions = kMaxBlobs + 64;

}  // namespace

SceneBuilder::SceneBuilder(std::optional<BlobCache> cache, Isa isa, int threads, Answers answers)
    : isa_(isa),
      threads_(threads),
      answers_(std::move(answers)),
      cache_(std::move(cache)),
      queue_(kQuestions),
      thread_([this] {
        while (auto question = queue_.pop()) (*question)();
      }) {}

SceneBuilder::~SceneBuilder() {
  queue_.removeIf([](const auto&) { return true; });
  queue_.close();
  thread_.join();
}

void SceneBuilder::ask(act::FindBlobs&& question) { queue(std::move(question)); }
void SceneBuilder::ask(act::KeepBlob&& question) { queue(std::move(question)); }
void SceneBuilder::ask(act::BuildScene question) { queue(question); }
void SceneBuilder::ask(act::EditScene&& question) { queue(std::move(question)); }
void SceneBuilder::ask(act::RestoreScene question) { queue(question); }
void SceneBuilder::ask(act::PrepareJob&& question) { queue(std::move(question)); }

template <typename Question>
void SceneBuilder::queue(Question question) {
  const uint32_t load = question.load;
  const auto held = std::make_shared<Question>(std::move(question));
  std::function<void()> work = [this, held] {
    try {
      answer(*held);
    } catch (const std::exception& error) {  // Error, or no memory
      answers_.failed(held->load, error.what());
    }
  };
  if (!queue_.tryPush(work)) answers_.failed(load, "more parts than a scene may have");
}

void SceneBuilder::answer(act::FindBlobs& question) {
  manifest_ = std::move(question.manifest);
  std::set<Sha256> wanted;
  for (const BlobInfo& blob : manifest_) wanted.insert(blob.hash);
  std::erase_if(raw_, [&](const auto& entry) { return !wanted.contains(entry.first); });

  std::vector<BlobInfo> missing;
  for (const BlobInfo& blob : manifest_)  // erase: a blob that the scene has twice is fetched once
    if (wanted.erase(blob.hash) == 1 && !have(blob)) missing.push_back(blob);
  answers_.found(question.load, std::move(missing));
}

bool SceneBuilder::have(const BlobInfo& blob) {
  if (raw_.contains(blob.hash)) return true;
  auto raw = cache_ ? cache_->load(blob) : std::nullopt;
  if (raw) raw_[blob.hash] = std::move(*raw);
  return raw.has_value();
}

void SceneBuilder::answer(act::KeepBlob& question) {
  raw_[question.blob.hash] = unpackBlob(question.blob, question.compressed);
  if (cache_) cache_->store(question.blob, question.compressed);
}

void SceneBuilder::answer(const act::BuildScene& question) {
  std::map<Sha256, int> uses;
  for (const BlobInfo& blob : manifest_) ++uses[blob.hash];
  std::vector<Bytes> raw;
  for (const BlobInfo& blob : manifest_) {
    Bytes& bytes = raw_.at(blob.hash);
    raw.push_back(--uses[blob.hash] > 0 ? bytes : std::move(bytes));
  }
  raw_.clear();
  latest_.reset(), scene_.reset();  // the old one first: two at once may not fit
  edits_ = {};
  scene_ = std::make_shared<TracedScene>(std::make_shared<const Scene>(unpackScene(manifest_, raw)),
                                         isa_);
  answers_.built(question.load);
}

void SceneBuilder::answer(const act::EditScene& question) {
  checkEdit(*scene_->asFetched, question.edit);
  merge(edits_, question.edit);
  if (!question.more) scene_ = TracedScene::after(scene_, edits_, question.moving);
}

void SceneBuilder::answer(const act::RestoreScene&) {
  edits_ = {};
  scene_ = std::make_shared<TracedScene>(scene_->asFetched, isa_);
}

void SceneBuilder::answer(const act::PrepareJob& question) {
  const bool lit = latest_ && latest_->hasLightOf(scene_, question.settings, question.delivery);
  auto job = lit ? std::make_shared<RenderJob>(*latest_, question.jobVersion, question.settings,
                                               question.delivery)
                 : std::make_shared<RenderJob>(scene_, question.jobVersion, question.settings,
                                               question.delivery, threads_, latest_.get());
  latest_ = job;
  answers_.prepared(question, std::move(job));
}

}  // namespace ninefold
