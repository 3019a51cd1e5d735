#include "common/base/program.h"

#include "common/base/command_line.h"
#include "common/base/standard_streams.h"

namespace ninefold {

int runProgram(std::string_view name, const std::function<int()>& run) {
  prepareStreams();
  try {
    return run();
  } catch (const UsageError& error) {
    sayToPeople(fmt::format("{}: {}\n", name, error.what()));
    return 2;
  } catch (const std::exception& error) {
    sayToPeople(fmt::format("{}: {}\n", name, error.what()));
    return 1;
  }
}

}  // namespace ninefold
