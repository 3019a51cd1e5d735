#include "master/options/numbered_name.h"

#include <fmt/format.h>

namespace ninefold {

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
