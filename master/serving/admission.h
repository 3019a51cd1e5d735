// admission.h: who may join a run, and whether all that render for it give equal pixels. Pure.
//
// Another release is refused. The first client sets the pixel class of the run; one of another
// class is let in with a warning, and the run is no longer reproducible. Who only visits renders
// nothing and sets nothing.
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

  bool reproducible() const { return reproducible_; }
  // Of the run; empty until a client has set it.
  std::string pixelClass() const { return first_ ? first_->probeClass : ""; }

 private:
  std::optional<msg::Hello> first_;
  bool reproducible_ = true;
};

}  // namespace ninefold
