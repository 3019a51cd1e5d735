// assembly.h: from results to finished frames, off the network thread, on all cores. Workers unpack
// each result as it comes. They finish a tile (filter, film) as soon as all around it is there,
// while its data is in their cache. Frames leave in the order of their index.
//
//   network thread: open, take     workers: unpack, answer, finish     film's thread: next, release
//
// One frame is finished at a time; the film's thread looks at what came of it between next and
// release. Results of later frames are unpacked meanwhile and wait, in about as many bytes as they
// travelled in. hasRoom bounds the frames and these bytes: a slow film slows the cluster down
// instead of filling memory. The queue has room for every copy of every task that may be on its
// way, so it is full only if a peer sends more than it was asked for. A second copy of a result is
// dropped. assembly_books.h knows what is where.
//
// Threads: as said; each function from any thread.   Owner: joins its workers when destroyed.
// Errors: a result that cannot be unpacked is answered with the reason.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/clock.h"
#include "common/image/patch.h"
#include "common/math/camera.h"
#include "common/scene/settings.h"
#include "master/assembly/assembly_books.h"
#include "master/assembly/received_tile.h"
#include "proto/tile_codec.h"

namespace ninefold {

// A frame to be gathered, and how it is to be looked at.
struct FrameView {
  FrameKey key;
  FrameShape shape;
  Camera camera;
  float neighbourWeight = 1;  // of the filter, in [0, 1]
};

// The results of a frame; those that a tile needs are there while it is finished.
struct GatheredFrame {
  FrameView view;
  std::vector<UnpackedTile> tasks;  // tile * sets + phase

  const UnpackedTile& task(int tile, int phase) const {
    return tasks[static_cast<size_t>(tile * view.shape.grid.interleave().sets() + phase)];
  }
};

class Assembly {
 public:
  static constexpr int kMostFrames = 16;
  static constexpr int kLeastFrames = 2;  // one fills while the other is finished
  // Of results that wait: no further frame is opened if the open ones, each as large as the one
  // finished last, would bring more. kLeastFrames are opened always.
  static constexpr size_t kMostBytes = 96 << 20;

  // Called on a worker's thread for each result that was taken.
  using Answer =
      std::function<void(ReceivedTile&& tile, const std::optional<std::string>& malformed)>;
  // Called on worker `worker` (0..workers-1) for each tile (0..TileGrid::tiles()-1): all of one
  // frame, at once for different tiles, before the first of the next.
  using Finish = std::function<void(int worker, const GatheredFrame& frame, int tile)>;

  Assembly(int workers, Answer answer, Finish finish);
  ~Assembly();
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  bool hasRoom() const;              // for one more frame
  void open(const FrameView& view);  // needs room
  bool take(ReceivedTile& tile);     // false when the queue is full
  // No frame before `firstWanted` is wanted any more. Waits for tiles that are being finished; a
  // frame that was given out stays until its release, and none is finished before.
  void supersede(uint32_t firstWanted);

  // The end: nothing is finished any more. Waits for tiles that are being finished.
  void close();

  struct Complete {
    FrameKey key;
    Time opened;
    Time lastResult;  // when the last result came in
    Time finished;
  };
  // The front frame, if it is finished by `deadline`. Give it back with release.
  std::optional<Complete> next(Time deadline);
  void release(const Complete& frame);

  // Processor time that workers have spent, summed over them.
  struct Busy {
    Duration unpacking{0}, finishing{0};
  };
  Busy busy() const;

 private:
  struct Slot {
    GatheredFrame frame;
    size_t bytes = 0;  // of all results that came
    Time opened, lastResult, finished;
  };

  // A result between the queue and its frame. Workers take several at once: a look at the
  // processor's clock, a turn at the lock and a wake-up for each would cost as much as the results
  // themselves.
  struct Unpacking {
    ReceivedTile tile;
    std::optional<TileShape> shape;  // nothing: nobody wants it any more
    UnpackedTile unpacked;
    std::optional<std::string> malformed;
  };

  void run(int worker);
  void wakeAnother();  // if there is work left
  void unpackSome(std::unique_lock<std::mutex>& lock, TileDecoder& decoder);
  std::vector<Unpacking> takeSome();
  void unpack(Unpacking& one, TileDecoder& decoder) const;
  std::optional<TileShape> shapeIfWanted(const msg::Result& result) const;
  void place(Unpacking& one);
  void finishOne(std::unique_lock<std::mutex>& lock, int worker);
  void closeFrame(uint32_t frame);

  const Answer answer_;
  const Finish finish_;

  mutable std::mutex mutex_;  // guards all below
  std::condition_variable work_, complete_, idle_;
  AssemblyBooks books_;
  std::map<uint32_t, std::unique_ptr<Slot>> slots_;
  std::deque<ReceivedTile> queue_;
  size_t queueLimit_ = 0;               // what the open frames may have on their way
  size_t bytes_ = 0;                    // of results that wait
  std::optional<FrameShape> measured_;  // of the last frame that was finished
  double bytesPerPixel_ = 0;            // of its results
  int finishing_ = 0;                   // tiles
  std::optional<uint32_t> held_;        // between next and release
  bool closing_ = false;
  Busy busy_;

  std::vector<std::thread> workers_;
};

}  // namespace ninefold
