// page.h: the page that browsers show (page.html), as it was built in, and what it may do.
// Threads: constants. Errors: none.
#pragma once

#include <string>
#include <string_view>

namespace ninefold {

extern const std::string_view kPage;

// Content-Security-Policy of a page with one script and one style in it: these two, by their
// SHA-256, connections to where it came from, pictures that it made itself; nothing else.
std::string policyOf(std::string_view page);

}  // namespace ninefold
