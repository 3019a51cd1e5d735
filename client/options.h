// options.h: the command line of ninefold-client: flags, then environment (NINEFOLD_*), then
// defaults.
// Errors: UsageError with one line that names the flag.
// Threads: pure but for reading the environment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/command_line.h"
#include "common/tracing/tracer.h"

namespace ninefold::client {

struct Options {
  bool help = false, version = false;  // print that and end; nothing else counts
  std::string master;  // address:port; empty: masterFile has it, or it is looked for
  std::optional<std::filesystem::path> masterFile;
  int threads = 1;  // 1..1024
  std::optional<std::filesystem::path> keyFile;
  std::optional<std::filesystem::path> cache;  // nothing: no cache on disk
  Isa isa = Isa::automatic;
  std::string name;                             // for people; default the machine's name
  std::optional<std::filesystem::path> record;  // keep all results there
  int keyDescriptor =
      -1;  // >= 0: started by the master, which hands its key over by this descriptor
  bool local() const { return keyDescriptor >= 0; }
};

// `cores`: of this machine; one thread for each is the default.
Options parseOptions(int argc, const char* const* argv, const Variable& variable, int cores);
std::string helpText();

}  // namespace ninefold::client
