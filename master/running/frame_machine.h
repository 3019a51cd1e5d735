// frame_machine.h: cluster and assembly wired together, once for every kind of run: work goes out,
// tiles come back and are placed, whole frames come out.
//
//   duty.nextWork -> cluster -> tiles -> assembly -> duty.finishTile -> next
//
// Threads: all of a duty but finishTile is called on the network thread, finishTile on
// a worker's; everything else from any thread.
// Owner: the run; ends all its threads when destroyed.
// Errors: the constructor throws Error (cannot listen, bad key); cluster().failure() tells what
// ends the run later.
#pragma once

#include "master/assembly/assembly.h"
#include "master/options/options.h"
#include "master/serving/cluster.h"
#include "proto/discovery/announcement.h"

namespace ninefold {

// What a run does at each station.
struct FrameDuty {
  // The next frame, after open() of it, or step; nothing if there is none now. Asked only if there
  // is room.
  std::function<std::optional<WorkOrder>()> nextWork;
  Assembly::Finish finishTile;
  // A tile is about to be taken. May be null.
  std::function<void(const ReceivedTile&)> tileCame = nullptr;
  // As ServerDuty::giveUp. May be null.
  std::function<uint32_t()> giveUp = nullptr;
  // As ServerDuty::stepDone. May be null.
  std::function<void(const StepKey&, const StatePages&)> stepDone = nullptr;
  // As ServerDuty::goBack and wentBack; when wentBack is called, no tile of those frames is being
  // finished. May be null.
  std::function<uint32_t()> goBack = nullptr;
  std::function<void()> wentBack = nullptr;
};

class FrameMachine {
 public:
  FrameMachine(const Options& options, const Listener::Keys& keys, JobOffer& offer, FrameDuty duty);
  ~FrameMachine();

  static int workers();  // threads that call finishTile: one for each core
  // Says where clients may join, and begins.
  void start();

  // Prepares for a frame of this shape, which nextWork gives afterwards.
  void open(const FrameOrder& order, const FrameShape& shape);
  // No frame before `firstWanted` is wanted any more.
  void supersede(uint32_t firstWanted);

  // The next whole frame, if it is there by `deadline`. Give it back with release.
  std::optional<Assembly::Complete> next(Time deadline) { return assembly_.next(deadline); }
  void release(const Assembly::Complete& frame);
  // No frame is finished any more: when it returns, finishTile is not called again.
  void finishNoMore();

  Cluster& cluster() { return cluster_; }
  const Cluster& cluster() const { return cluster_; }
  Assembly::Busy busy() const { return assembly_.busy(); }

 private:
  ServerDuty serverDuty();

  const Options& options_;
  const FrameDuty duty_;
  // In this order: the workers end before the cluster that they report to.
  Cluster cluster_;
  Assembly assembly_;
  std::optional<Announcement> announcement_;
};

}  // namespace ninefold
