// options.h: the command line of ninefold-client. Flags, then environment (NINEFOLD_*), then
// defaults. Errors: UsageError with one line that names the flag. Threads: pure but for reading the
// environment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/error.h"
#include "common/tracing/tracer.h"

namespace ninefold::client {

class UsageError : public Error {
 public:
  using Error::Error;
};

struct Options {
  bool help = false;
  std::string master;  // address:port
  int threads = 1;     // 1..1024
  std::optional<std::filesystem::path> keyFile;
  std::optional<std::filesystem::path> cache;  // nothing: no cache on disk
  Isa isa = Isa::automatic;
  std::string name;  // for people; default the machine's name
  int keyDescriptor =
      -1;  // >= 0: started by the master, which hands its key over by this descriptor
  bool local() const { return keyDescriptor >= 0; }
};

Options parseOptions(int argc, const char* const* argv);
std::string helpText();

}  // namespace ninefold::client
