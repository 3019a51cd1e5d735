// standard_streams.h: what programs say.
//
// Standard error   lines for people. They may be lost without harm: the reader may be gone, the
//                  terminal closed, the disk or the pipe full.
// Standard output  somebody's result. It arrives, or the program fails.
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
