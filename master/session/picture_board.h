// picture_board.h: the latest picture of a session: as it is shown, in files, in the panel's
// numbers.
//
// Pictures come tone mapped; one is mapped anew only when the exposure or the curve changes while
// it is shown.
// Files are ninefold.NNNN and, while it records, record.NNNN in the working folder, with numbers
// that no file has.
// Threads: the main thread.   Errors: one line for what cannot be written; that ends a recording.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/interaction/notice.h"
#include "master/running/live_run.h"
#include "master/session/panel_values.h"

namespace ninefold {

class PictureBoard {
 public:
  explicit PictureBoard(Notice& notice) : notice_(notice) {}

  // The run's latest picture; `tasks`: that the cluster has done so far. False if it is known.
  bool take(const std::shared_ptr<const Shown>& latest, uint64_t tasks);
  // What is to be seen from now on, until the next call; null if it is what it was.
  const DisplayImage* draw(const Scene& scene, const std::optional<Selection>& selection);

  const DisplayImage& display();                       // needs a picture
  const Shown* shown() const { return shown_.get(); }  // null before the first
  const Tone& tone() const { return tone_; }
  void setTone(const Tone& tone) { tone_ = tone; }
  void toggleRecording() { recording_ = !recording_; }
  // Into the next file with that extension. Radiance waits for a picture that has it.
  void save(const std::string& extension);
  // Throws Error.
  void write(const std::string& path);
  void tell(PanelView& view) const;

 private:
  void count(uint64_t tasks);
  Tone toneShown() const;

  Notice& notice_;
  std::shared_ptr<const Shown> shown_;
  Tone tone_;
  struct Drawn {
    const Shown* shown = nullptr;
    Tone tone;
    std::optional<Selection> selection;
    bool operator==(const Drawn&) const = default;
  };
  Drawn drawn_;
  DisplayImage exposed_, outlined_;  // kept for their memory
  bool recording_ = false;
  std::optional<std::string> waiting_;  // extension to be saved
  int saved_ = 0, recorded_ = 0;        // files

  std::vector<float> frameTimes_;  // [ms]
  Time ratesAt_{};
  uint64_t raysThen_ = 0, tasksThen_ = 0;
  double raysPerSecond_ = 0, tasksPerSecond_ = 0;
};

}  // namespace ninefold
