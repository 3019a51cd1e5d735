// scheduler_types.h: what goes into the scheduler and what comes out. Plain values, no behaviour.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/clock.h"
#include "proto/sha256.h"

namespace ninefold {

// Given by the caller, one for each accepted connection, never used again in a run.
using ClientId = uint32_t;

// Names one task on master, client and wire: the pixels of one phase in one tile of one frame, or a
// unit of a step of a method's state.
struct TaskId {
  uint32_t frame = 0;  // FrameKey::frame or StepKey::number
  int tile = 0;        // 0..TileGrid::tiles()-1; of a step: the unit, as StepKey counts
  int phase = 0;       // 0..Interleave::sets()-1; of a step: 0
  auto operator<=>(const TaskId&) const = default;
};

// Of a result's content, however it was compressed.
using Digest = Sha256;

// How a frame is to be rendered.
struct FrameKind {
  // A task is a whole tile, named by its phase 0. Whoever works on the frame makes all light sets,
  // so that the frame counts as one set.
  bool wholeTiles = false;
  bool urgent = false;    // soon, whatever that costs in light sets and messages
  bool freeSets = false;  // a light set costs nothing
  double rays = 1;        // that a task is expected to take, its light set included (task_rays.h)
};

// A task that was sent to a client and has not been answered.
struct HeldTask {
  TaskId task;
  int set = 0;          // light set
  double rays = 1;      // that it is expected to take (FrameKind::rays)
  bool isStep = false;  // a unit of a step
  // When the client began it: since then fewer tasks than it has threads were ahead.
  std::optional<Time> begun = std::nullopt;
};

// Send this task to this client.
struct Assignment {
  ClientId client = 0;
  TaskId task;
  Duration allowed{0};  // that a thread may be at work on it
  bool operator==(const Assignment&) const = default;
};

// Tell this client to forget its tasks of all frames, or units of all steps, before firstWanted.
// Its credit is given back at once, so it need not answer; what it sends all the same is dropped as
// stale.
struct Cancellation {
  ClientId client = 0;
  uint32_t firstWanted = 0;
  bool steps = false;
  bool operator==(const Cancellation&) const = default;
};

// "frame 3, tile 5, set 2", "step 4, unit 7"
inline std::string nameOf(const HeldTask& held) {
  if (held.isStep) return fmt::format("step {}, unit {}", held.task.frame, held.task.tile);
  return fmt::format("frame {}, tile {}, set {}", held.task.frame, held.task.tile, held.set);
}

// For people: a client is stuck, or is not any more.
struct StuckNote {
  ClientId client = 0;
  bool isBack = false;
  Duration time{0};  // for which it was at work on `task`, or was stuck
  HeldTask task = {};
};

// Two other clients gave another result for the task than this one.
struct WrongNote {
  ClientId client = 0;
  HeldTask task;
};

struct Actions {
  std::vector<Cancellation> cancel;  // to be sent before `assign`
  std::vector<Assignment> assign;
  std::vector<StuckNote> notes;
  std::vector<WrongNote> wrong;
};

// What a result cost its client.
struct TaskCost {
  TaskCost(Duration b, bool made = false) : busy(b), madeLight(made) {}
  Duration busy;   // of one thread, light sets that it made included
  bool madeLight;  // it made one
};

// What became of a result. Only `accepted` may be placed in a frame.
enum class Verdict : uint8_t {
  accepted,
  completedFrame,  // accepted, and it was the frame's or the step's last
  duplicate,       // another client was faster
  stale,           // its frame was superseded, or its client has left
  unknown,         // never asked of this client, or no such task
  compared,        // only to be compared with another client's
};
inline bool isAccepted(Verdict v) { return v == Verdict::accepted || v == Verdict::completedFrame; }

// Counts over the whole run.
struct SchedulerCounts {
  uint64_t assigned = 0;  // all that were sent, copies included
  uint64_t accepted = 0;
  uint64_t duplicated = 0;      // copies given to idle clients because the first holder seemed slow
  uint64_t reissued = 0;        // taken back from lost, suspect or stuck clients
  uint64_t clientsStuck = 0;    // at least once
  uint64_t cancelledTasks = 0;  // neither done nor wanted any more, by viewChanged
  uint64_t cancelledFrames = 0;
  uint64_t completedFrames = 0;
  uint64_t completedSteps = 0, completedUnits = 0;
  uint64_t droppedDuplicate = 0;
  uint64_t droppedStale = 0;
  uint64_t droppedUnknown = 0;
};

// Of results that a second client does again (verification.h).
struct VerificationCounts {
  uint64_t checked = 0;   // two clients agreed
  uint64_t wrong = 0;     // results that differed from what two clients gave
  uint64_t alone = 0;     // chosen, but nobody was there to check them
  uint64_t disputed = 0;  // that differ, and wait for a third client
};

// One client's share of the run; kept after it is lost.
struct ClientReport {
  ClientId client = 0;
  int threads = 1;
  bool lost = false;
  bool suspect = false;  // silent for too long at the moment
  bool stuck = false;    // a task of it is past its deadline at the moment
  uint64_t timesStuck = 0;
  std::optional<HeldTask> oldest = std::nullopt;  // that it holds, or held when it was lost
  uint64_t tasks = 0;                             // accepted results
  uint64_t frames = 0;                            // frames it was given tasks of
  uint64_t lightSets = 0;                         // summed over those frames: distinct light sets
  Duration busy{0};     // time spent on tasks as the client reports it, summed over threads
  Duration present{0};  // joined until lost or now
  int inFlight = 0, window = 0;
  double busyFraction() const {
    return present.count() > 0 ? seconds(busy) / (seconds(present) * threads) : 0;
  }
  double setsPerFrame() const {
    return frames > 0 ? static_cast<double>(lightSets) / static_cast<double>(frames) : 0;
  }
};

}  // namespace ninefold
