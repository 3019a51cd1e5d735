// scheduler_frame.h: the books of one open frame: which task waits, which is in flight where, which
// is done. There is a queue of waiting tasks for each light set, and the tasks with a single holder
// are sorted by the time when they are late. A step of a method's state is a frame without pixels:
// its units are tasks of one light set that costs nothing.
//
// A task is  absent   (no pixels: the tile's corner of a small picture),
//            waiting  (no active holder), active (>= 1 active holder) or done.
// A holder is a client that was sent the task and has not answered. While it is suspect it is
// inactive.
// Owner: Scheduler.   Threads: none.   Errors: NINEFOLD_CHECK only.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/sampling/interleave.h"
#include "common/scene/settings.h"
#include "master/scheduling/scheduler_client.h"
#include "master/scheduling/scheduler_types.h"

namespace ninefold {

enum class TaskState : uint8_t { absent, waiting, active, done };

struct TaskHolder {
  ClientId client = 0;
  bool active = true;
  Time sent, expected, late;  // expected: its result should be here; late: something may be wrong
};

class SchedulerFrame {
 public:
  using Stragglers =
      std::set<std::pair<Time, int>>;  // (late, task) of tasks with one active holder

  // `ordinal`: of pictures, without steps.
  SchedulerFrame(const FrameKey& key, const TileGrid& grid, FrameKind kind, int ordinal);
  // A step of `units` units from `firstUnit` on, each of so many rays. `clients`: those present;
  // each begins at a place of its own, which it has in the next step, too.
  SchedulerFrame(uint32_t number, uint32_t firstUnit, int units, double rays, bool yields = false,
                 const std::vector<ClientId>& clients = {});

  const FrameKey& key() const { return key_; }
  bool isStep() const { return isStep_; }
  bool yields() const { return yields_; }  // to urgent frames
  int ordinal() const { return ordinal_; }
  bool sharesSets() const { return sharesSets_; }       // all clients work on it at once
  int sets() const { return wholeTiles_ ? 1 : sets_; }  // that tasks are of
  double raysOfTask() const { return rays_; }
  int tasksOfSet() const { return tasks() / sets_; }  // at most
  int tasks() const { return static_cast<int>(tasks_.size()); }
  // Index of a task of this frame, -1 if there is no such task.
  int indexOf(const TaskId& task) const;
  TaskId idOf(int task) const;
  HeldTask heldTask(int task) const {
    return {.task = idOf(task), .set = setOf(task), .rays = rays_, .isStep = isStep_};
  }
  int setOf(int task) const { return lightSetOfPhase(task % sets_, key_.rotation, sets_); }
  TaskState state(int task) const { return tasks_[static_cast<size_t>(task)].state; }
  const std::vector<TaskHolder>& holders(int task) const {
    return tasks_[static_cast<size_t>(task)].holders;
  }
  // When the first active holder's result should be here. Needs an active task.
  Time expected(int task) const;
  const Stragglers& stragglers() const { return stragglers_; }
  int left() const { return left_; }        // not done
  int waiting() const { return waiting_; }  // to hand out
  int waitingOf(int set) const { return queues_[static_cast<size_t>(set)].waiting; }

  // A light set with waiting tasks: that the client has; that nobody is at work on.
  std::optional<int> setToGoOnWith(ClientId client) const;
  std::optional<int> untouchedSet() const;
  int untouchedSets() const;
  // The set to be shared by one client more. Needs waiting() > 0.
  int setToShare(const SchedulerClient& client) const;
  // The set's next waiting task for that client; stays waiting until addHolder.
  int nextWaiting(int set, ClientId client);

  void addHolder(int task, const TaskHolder& holder);
  // Switches a suspect's claim off or on again. True if the task now waits, first in its queue.
  // Nothing happens once the task is done; the same for removeHolder.
  bool setHolderActive(int task, ClientId client, bool active);
  bool removeHolder(int task, ClientId client);
  void finish(int task);

  // Notes that the client works on the set. What is new by that?
  struct SetUse {
    bool firstInFrame = false;  // its first task of this frame
    bool newSet = false;        // its first task of this light set
  };
  SetUse useSet(ClientId client, int set);
  void forgetClient(ClientId client);  // it no longer counts as working on any set

  void checkInvariants() const;

 private:
  struct Task {
    TaskState state = TaskState::absent;
    std::vector<TaskHolder> holders;
  };
  struct SetQueue {
    std::deque<int> order;  // may hold tasks that wait no more; skipped when met
    int waiting = 0;
    int clients = 0;  // that work on this set
    bool isUntouched() const { return waiting > 0 && clients == 0; }
  };

  Task& at(int task) { return tasks_[static_cast<size_t>(task)]; }
  SetQueue& queueOf(int task) { return queues_[static_cast<size_t>(setOf(task))]; }
  TaskHolder& holder(int task, ClientId client);
  void enterStraggler(int task);
  void leaveStraggler(int task);
  bool settle(int task);

  FrameKey key_;
  int ordinal_ = 0;
  uint32_t firstUnit_ = 0;
  bool isStep_, sharesSets_, wholeTiles_, yields_ = false;
  double rays_;
  int sets_;  // = phases
  int left_ = 0, waiting_ = 0;
  std::vector<Task> tasks_;         // tile * sets + phase
  std::vector<SetQueue> queues_;    // by light set
  std::map<ClientId, int> places_;  // in a step: the unit at which a client goes on
  Stragglers stragglers_;
  std::map<ClientId, std::vector<int>> setsOfClient_;  // latest last
};

}  // namespace ninefold
