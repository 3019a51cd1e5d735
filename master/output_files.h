// output_files.h: the files that a run shall leave: looked at before it begins, and the names of
// numbered ones.
// Threads: any. Errors: checkFiles throws Error that names the file.
#pragma once

#include "master/options.h"

namespace ninefold {

// Whether --output and --stats can be written.
void checkFiles(const Options& options);

// out.####.png with a number in place of the last # of the file's name.
bool isNumbered(const std::string& output);
std::string numbered(const std::string& output, int number);

}  // namespace ninefold
