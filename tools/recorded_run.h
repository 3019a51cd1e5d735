// recorded_run.h: a task of a recording: how it was asked for, in which state of the scene, and
// what came of it. Messages are followed as a client follows them (client/session.h): a job sees
// all edits before it.
// Threads: plain values.   Errors: Error that names what is not there.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/state_store.h"
#include "proto/messages.h"

namespace ninefold {

struct TaskPlace {
  uint32_t frame = 0, tile = 0, phase = 0;
};

struct RecordedTask {
  msg::Hello client;
  std::vector<BlobInfo> scene;
  std::vector<msg::Edit> edits;  // that the scene had had, in their order
  msg::Configure job;
  msg::Tasks order;  // of which it was one
  msg::TaskItem item;
  StatePages state;                   // of the method, that lit the frame
  std::optional<msg::Result> result;  // none: the client did not finish it
};

class RecordedRun {
 public:
  explicit RecordedRun(const std::vector<Message>& messages) : messages_(messages) {}

  RecordedTask find(const TaskPlace& place) {
    for (const Message& message : messages_)
      std::visit([&](const auto& m) { on(m, place); }, message);
    if (found_) return *found_;
    if (!first_) fail("the recording holds no task");
    fail(
        "the recording holds no task of frame {}, tile {}, phase {}; it begins with frame {}, tile "
        "{}, "
        "phase {}",
        place.frame, place.tile, place.phase, first_->frame, first_->tile, first_->phase);
  }

 private:
  struct Job {
    msg::Configure configure;
    size_t edits = 0;
  };

  void on(const msg::Hello& m, const TaskPlace&) { now_.client = m; }
  void on(const msg::SceneOffer& m, const TaskPlace&) {  // of a connection; jobs count anew
    now_.scene = m.blobs;
    now_.edits.clear(), jobs_.clear();
    states_.clear();
  }
  void on(const msg::StateOffer& m, const TaskPlace&) {
    states_.offer(msg::StateOffer(m));
    states_.requests();
  }
  void on(const msg::BlobChunk& m, const TaskPlace&) {
    states_.chunk(msg::BlobChunk(m));
    states_.requests();
  }
  void on(const msg::StateDelta& m, const TaskPlace&) { states_.add(msg::StateDelta(m)); }
  void on(const msg::Edit& m, const TaskPlace&) { now_.edits.push_back(m); }
  void on(const msg::Configure& m, const TaskPlace&) {
    jobs_[m.jobVersion] = {m, now_.edits.size()};
  }
  void on(const msg::Tasks& m, const TaskPlace& place) {
    for (const msg::TaskItem& item : m.items) {
      if (!first_) first_ = {m.frame.frame, item.tile, item.phase};
      if (m.frame.frame != place.frame || item.tile != place.tile || item.phase != place.phase)
        continue;
      const auto job = jobs_.find(m.jobVersion);
      if (job == jobs_.end()) fail("the recording holds tasks of a job that it does not hold");
      found_ = now_;
      found_->job = job->second.configure, found_->edits.resize(job->second.edits);
      found_->order = m, found_->item = item;
      const auto state = states_.find(m.frame.state);
      if (!state) fail("the recording lacks version {} of the method's state", m.frame.state);
      found_->state = *state;
    }
  }
  void on(const msg::Result& m, const TaskPlace& place) {
    if (found_ && m.frame == place.frame && m.tile == place.tile && m.phase == place.phase)
      found_->result = m;
  }
  template <typename Other>
  void on(const Other&, const TaskPlace&) {}

  const std::vector<Message>& messages_;
  RecordedTask now_;
  std::map<uint32_t, Job> jobs_;
  StateStore states_;
  std::optional<TaskPlace> first_;
  std::optional<RecordedTask> found_;
};

}  // namespace ninefold
