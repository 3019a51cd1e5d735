#include "master/serving/admission.h"

#include <fmt/core.h>

namespace ninefold {

Admission::Verdict Admission::judge(const msg::Hello& hello, const std::string& peer) {
  if (hello.protocol != kProtocol || hello.release != releaseName())
    return {
        fmt::format("the master runs Ninefold {} (protocol {}), the client {} (protocol {}): build "
                    "both from one commit, or copy the programs of one",
                    releaseName(), kProtocol, hello.release, hello.protocol),
        {}};
  if (hello.visits) return {};
  if (!first_) first_ = hello;
  if (hello.probeClass == first_->probeClass) return {};
  reproducible_ = false;
  return {
      {},
      fmt::format("client {} ({}, {}) renders slightly different pixels than {} ({}): the picture "
                  "is not reproducible; --isa avx2 on all makes them alike",
                  hello.name, peer, hello.isa, first_->name, first_->isa)};
}

}  // namespace ninefold
