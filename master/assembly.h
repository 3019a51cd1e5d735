// assembly.h: from results to complete frames, off the network thread: decoders unpack tiles and
// place them in the buffers of the open frames; complete frames leave in the order of their index.
//
//   network thread: open, take      decoders: decode, place, answer      film's thread: next,
//   release
//
// There are kBuffers frame buffers and no more: a frame is opened only when one is free, so a slow
// film slows the cluster down instead of filling memory. The queue holds every copy of every task
// that may be on its way, so it is full only if a peer sends more than it was asked for. A second
// copy of a tile that is placed, or being placed, is dropped. Threads: as said; each function from
// any thread. Owner: joins its decoders when destroyed. Errors: a tile that cannot be decoded is
// answered with the reason.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/concurrency.h"
#include "common/image/frame_buffer.h"
#include "common/scene/settings.h"
#include "master/received_tile.h"
#include "proto/tile_codec.h"

namespace ninefold {

class Assembly {
 public:
  static constexpr size_t kBuffers = 3;

  // Called on a decoder's thread for each tile that was taken.
  using Answer =
      std::function<void(ReceivedTile&& tile, const std::optional<std::string>& malformed)>;

  Assembly(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask, int decoders, Answer answer);
  ~Assembly();
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  bool hasRoom() const;              // for one more frame
  void open(const FrameKey& frame);  // needs room
  bool take(ReceivedTile& tile);     // false when the queue is full

  struct Complete {
    FrameKey key;
    const FrameBuffer* buffer = nullptr;
    Time completed;  // when its last tile was placed
  };
  // The next frame by index, if it is complete by `deadline`. Give it back with release.
  std::optional<Complete> next(Time deadline);
  void release(const Complete& frame);

  // Time that decoders have spent, summed over them.
  Duration busy() const;

 private:
  struct Slot {
    explicit Slot(FrameBuffer&& b) : buffer(std::move(b)) {}
    FrameBuffer buffer;
    bool used = false;
    FrameKey key;
    std::vector<bool> claimed;  // by task: placed or being placed
    int left = 0;
    Time completed;
  };

  void run();
  void decode(const ReceivedTile& tile, TileDecoder& decoder, TileResult& scratch);
  bool isWanted(const msg::Result& result);
  Slot* claim(const msg::Result& result);
  void placed(Slot& slot);
  size_t taskIndex(const msg::Result& result) const;
  Slot* find(uint32_t frame);

  const TileGrid grid_;
  const uint8_t layerMask_, extraMask_;
  const Answer answer_;
  BoundedQueue<ReceivedTile> queue_;

  mutable std::mutex mutex_;
  std::condition_variable complete_;
  std::vector<std::unique_ptr<Slot>> slots_;  // flags guarded by mutex_; pixels as FrameBuffer says
  uint32_t nextFrame_ = 0;                    // guarded by mutex_
  Duration busy_{0};                          // guarded by mutex_

  std::vector<std::thread> decoders_;
};

}  // namespace ninefold
