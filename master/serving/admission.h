// admission.h: who may join a run, and whether all that render for it give equal pixels. Pure.
//
// Another release is refused. The first client sets the pixel class of the run; one of another
// class is let in with a warning, and the run is no longer reproducible. A run that goes on has the
// class that it began with. Who only visits renders nothing and sets nothing.
#pragma once

#include <optional>
#include <string>

#include "proto/messages.h"

namespace ninefold {

class Admission {
 public:
  struct Verdict {
    std::optional<std::string> refusal;
    std::optional<std::string> warning;
  };
  Verdict judge(const msg::Hello& hello, const std::string& peer);

  // The run goes on that clients of this class have begun. `reproducible`: all of them were.
  void resume(const std::string& pixelClass, const std::string& isa, bool reproducible);

  bool reproducible() const { return reproducible_; }
  // Of the first client; empty: there was none.
  const std::string& pixelClass() const { return first_.probeClass; }
  const std::string& isa() const { return first_.isa; }

 private:
  msg::Hello first_;
  bool reproducible_ = true;
};

}  // namespace ninefold
