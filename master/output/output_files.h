// output_files.h: the files that a run shall leave, looked at before it begins.
// Threads: any. Errors: throw Error that names the file.
#pragma once

#include <functional>

#include "master/options/options.h"

namespace ninefold {

// Whether --output, --checkpoint, --metrics and --stats can be written.
void checkFiles(const Options& options);

// Calls write(name). If that throws Error, what took long to make is not lost: it goes to a file of
// that name in a new folder among the temporary ones, and Error says where it is. (It says no more
// than the first one if that fails, too.)
void writeSomewhere(const std::string& name, const std::function<void(const std::string&)>& write);

}  // namespace ninefold
