#include "master/output/output_files.h"

#include "common/base/written_file.h"
#include "common/image/image_file.h"
#include "master/options/numbered_name.h"
#include "master/output/stats.h"

namespace ninefold {

void checkFiles(const Options& options) {
  const bool isSeries = !isWatched(options) && (options.animate || options.script);
  if (options.output)
    checkOutputPath(isSeries && isNumbered(*options.output) ? numbered(*options.output, 0)
                                                            : *options.output);
  if (options.stats && *options.stats != kStandardOutput) checkWritable(*options.stats);
}

}  // namespace ninefold
