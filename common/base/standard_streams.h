// standard_streams.h: what programs say. Lines on standard error are for people and may be lost
// without harm: reader gone, terminal closed, disk or pipe full. Standard output is somebody's
// result: it arrives, or the program fails.
//
// Threads: any; a piece of text stays together.
// Errors:  writeOutput throws Error; sayToPeople has none.
#pragma once

#include <string_view>

namespace ninefold {

// First thing in main. Afterwards no file gets the number of a stream that was closed when we were
// started, and a limit of file sizes is an error of the writer's instead of a signal.
void prepareStreams();

// Waits a tenth of a second at most.
void sayToPeople(std::string_view text);
void writeOutput(std::string_view text);

}  // namespace ninefold
