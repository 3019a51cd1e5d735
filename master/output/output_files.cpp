#include "master/output/output_files.h"

#include <stdlib.h>

#include <filesystem>

#include "common/base/error.h"
#include "common/base/written_file.h"
#include "common/image/image_file.h"
#include "master/options/numbered_name.h"
#include "master/output/stats.h"
#include "master/output/video_file.h"

namespace ninefold {

void checkFiles(const Options& options) {
  const bool isSeries = !isWatched(options) && (options.animate || options.script);
  if (options.output && isVideo(*options.output))
    checkVideo(*options.output);
  else if (options.output)
    checkOutputPath(isSeries && isNumbered(*options.output) ? numbered(*options.output, 0)
                                                            : *options.output);
  if (options.checkpoint) checkWritable(*options.checkpoint);
  if (options.metrics) checkWritable(*options.metrics);
  if (options.stats && *options.stats != kStandardOutput) checkWritable(*options.stats);
}

void writeSomewhere(const std::string& name, const std::function<void(const std::string&)>& write) {
  namespace fs = std::filesystem;
  try {
    write(name);
  } catch (const Error& error) {
    std::error_code none;
    std::string folder = (fs::temp_directory_path(none) / "ninefold-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) throw;
    const fs::path elsewhere = fs::path(folder) / fs::path(name).filename();
    try {
      write(elsewhere.string());
    } catch (const Error&) {
      fs::remove(folder, none);
      throw error;
    }
    fail("{}; it is in {}", error.what(), elsewhere.string());
  }
}

}  // namespace ninefold
