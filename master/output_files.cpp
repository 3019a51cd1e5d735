#include "master/output_files.h"

#include "common/base/written_file.h"
#include "common/image/image_file.h"
#include "master/stats.h"

namespace ninefold {

void checkFiles(const Options& options) {
  const bool isSeries = !options.window && (options.animate || options.script);
  if (options.output)
    checkOutputPath(isSeries && isNumbered(*options.output) ? numbered(*options.output, 0)
                                                            : *options.output);
  if (options.stats && *options.stats != kStandardOutput) checkWritable(*options.stats);
}

bool isNumbered(const std::string& output) {
  const size_t name = output.rfind('/') + 1;  // npos + 1 = 0
  return output.find('#', name) != std::string::npos;
}

std::string numbered(const std::string& output, int number) {
  const size_t last = output.rfind('#'), first = output.find_last_not_of('#', last) + 1;
  return output.substr(0, first) + fmt::format("{:0{}}", number, last + 1 - first) +
         output.substr(last + 1);
}

}  // namespace ninefold
