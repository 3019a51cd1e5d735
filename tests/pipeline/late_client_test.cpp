// Clients that come while somebody drags a lamp about: one who was there from the start, one who
// joins in the middle, one whose scene is still being built, and one who lost the line and is back.
// All of them render the same bytes from then on. The master's offer, the client's session and its
// builder are the real ones; only the wire between them XX
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "client/scene_builder.h"
#include "client/session.h"
#include "common/scene/methods.h"
#include "master/serving/job_offer.h"
#include "tests/scene/random_edits.h"
#include "tests/scene/table_room.h"

namespace ninefold {
namespace {

// What the builder answered last: its thread writes, the test waits.
class Answered {
 public:
  void prepared(std::shared_ptr<RenderJob> job) {
    const std::scoped_lock lock(mutex_);
    job_ = std::move(job), ++jobs_;
    changed_.notify_all();
  }
  void failed(const std::string& line) {
    const std::scoped_lock lock(mutex_);
    failure_ = line, ++jobs_;
    changed_.notify_all();
  }
  // The job of the `count`-th question.
  std::shared_ptr<RenderJob> job(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_ >= count; });
    EXPECT_EQ(failure_, "");
    return job_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<RenderJob> job_;
  std::string failure_;
  int jobs_ = 0;
};

class Client {
 public:
  Client()
      : session_(options(), now_),
        builder_(
            std::nullopt, Isa::automatic, 1,
            {.found = [](uint32_t, const auto&) {},
             .built = [](uint32_t) {},
             .prepared = [this](const auto&, auto job) { answered_.prepared(std::move(job)); },
             .failed = [this](uint32_t, const std::string& line) { answered_.failed(line); }}) {}

  // Holds back what the cache says until `goOn`: edits come in the meantime.
  void join(const JobOffer& offer) {
    connect(offer);
    goOn();
  }
  void connect(const JobOffer& offer) {
    now_ += std::chrono::minutes(1);  // whatever there was to wait for is over
    session_.tick(now_);
    session_.connected(now_);
    tell(msg::Welcome{7});
    offer_ = &offer;
    tell(offer.sceneOffer());
    for (msg::Edit& edit : offer.allEdits()) tell(std::move(edit));
    tell(offer.configure());
  }
  void goOn() {
    waits_ = false;
    carryOut();
  }
  void lose() {
    session_.disconnected("the line went dead", now_);
    carryOut();
  }
  void tell(Message message) {
    session_.received(std::move(message), now_);
    if (!waits_) carryOut();
  }

  // Two tasks of a frame, as they would travel. The key says all about the views that light is made
  // for.
  std::vector<Bytes> renders() {
    FrameKey key;
    key.photonRadius = 0.05f;
    key.lightCameras.resize(kMostLightCameras);
    key.lightCameras[3].eye = Vec3(0.2f, 0.1f, 0.3f);
    const auto job = answered_.job(questions_);
    std::vector<Bytes> results;
    for (const uint32_t phase : {0u, 4u})
      results.push_back(
          job->run(key, {0, phase, 0}, 1, 1, 0, [] { return Time(); }).result.encoded);
    return results;
  }

 private:
  static SessionOptions options() {
    SessionOptions o;
    o.hello.name = "late";
    o.master = "here";
    o.reconnect = true;
    return o;
  }
  void carryOut() {
    for (auto actions = session_.takeActions(); !actions.empty(); actions = session_.takeActions())
      for (act::Action& action : actions) std::visit([this](auto& a) { on(std::move(a)); }, action);
  }
  void on(act::FindBlobs&& a) {
    std::vector<BlobInfo> missing = a.manifest;
    const uint32_t load = a.load;
    builder_.ask(std::move(a));
    session_.blobsFound(load, std::move(missing), now_);
  }
  void on(act::KeepBlob&& a) { builder_.ask(std::move(a)); }
  void on(act::BuildScene&& a) {
    builder_.ask(a);
    session_.sceneBuilt(a.load, now_);
  }
  void on(act::EditScene&& a) { builder_.ask(std::move(a)); }
  void on(act::RestoreScene&& a) { builder_.ask(a); }
  void on(act::PrepareJob&& a) {
    ++questions_;
    builder_.ask(std::move(a));
  }
  void on(act::Send&& a) {
    if (const auto* wanted = std::get_if<msg::BlobRequest>(&a.message))
      tell(offer_->piece(*wanted));
  }
  template <typename Other>
  void on(Other&&) {}

  Time now_ = Time(std::chrono::hours(1));
  Session session_;
  const JobOffer* offer_ = nullptr;
  bool waits_ = true;
  int questions_ = 0;
  Answered answered_;
  SceneBuilder builder_;  // last: its thread answers until it is gone
};

class LateClient : public ::testing::TestWithParam<MethodFacts> {
 protected:
  LateClient()
      : scene_(tableRoomWithSpot()),
        random_(scene_, 7),
        offer_(packScene(scene_), settings(), {}) {}

  Settings settings() const {
    Settings s;
    s.method = GetParam().method;
    s.width = 96, s.height = 72;
    s.camera = scene_.cameras.front();
    return s;
  }
  // What the master does with an edit: into the offer, and to those who are there.
  void edits(int count, bool moving, const std::vector<Client*>& there) {
    for (int i = 0; i < count; ++i) {
      const auto messages = offer_.setEdit(offer_.edits() + 1, random_.next(), moving);
      offer_.setJob(offer_.job() + 1, settings(), {});
      for (Client* client : there) {
        for (const msg::Edit& edit : messages) client->tell(edit);
        client->tell(offer_.configure());
      }
    }
  }
  // By somebody who is told of all edits, but not that they are a gesture.
  std::vector<Bytes> renderedAtRest() const {
    JobOffer offer(packScene(scene_), settings(), {});
    uint32_t version = 0;
    for (const msg::Edit& edit : offer_.allEdits()) offer.setEdit(++version, edit.edit, false);
    Client client;
    client.join(offer);
    return client.renders();
  }

  Scene scene_;
  RandomEdits random_;
  JobOffer offer_;
};

TEST_P(LateClient, InTheMiddleOfAGestureRendersTheSameBytes) {
  Client first, slow, late, back;
  first.join(offer_), back.join(offer_);
  edits(4, false, {&first, &back});
  edits(3, true, {&first, &back});
  back.lose();
  slow.connect(offer_);
  edits(3, true, {&first, &slow});
  slow.goOn();
  late.join(offer_);
  back.join(offer_);
  const auto expected = first.renders();
  EXPECT_EQ(late.renders(), expected) << "who joined";
  EXPECT_EQ(slow.renders(), expected) << "who was told of edits before the scene was built";
  EXPECT_EQ(back.renders(), expected) << "who was there before";
  EXPECT_NE(renderedAtRest(), expected) << "nothing was seen of the gesture: choose another seed";

  edits(3, true, {&first, &slow, &late, &back});
  const auto later = first.renders();
  EXPECT_NE(later, expected);
  for (Client* client : {&slow, &late, &back}) EXPECT_EQ(client->renders(), later);

  edits(1, false, {&first, &slow, &late, &back});  // the hand lets go
  const auto atRest = first.renders();
  for (Client* client : {&slow, &late, &back}) EXPECT_EQ(client->renders(), atRest);
}

INSTANTIATE_TEST_SUITE_P(By, LateClient,
                         ::testing::ValuesIn(allMethods().begin(), allMethods().end()),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           std::ranges::replace(name, '-', '_');  // as test names must be
                           return name;
                         });

}  // namespace
}  // namespace ninefold
