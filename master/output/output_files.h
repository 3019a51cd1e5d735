// output_files.h: the files that a run shall leave, looked at before it begins.
// Threads: any. Errors: checkFiles throws Error that names the file.
#pragma once

#include "master/options/options.h"

namespace ninefold {

// Whether --output and --stats can be written.
void checkFiles(const Options& options);

}  // namespace ninefold
