#include "common/base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <string>

namespace ninefold {
namespace {

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made = spdlog::stderr_logger_mt("ninefold");
    made->set_pattern("%v");
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *instance;
}

}  // namespace

void nameLog(std::string_view name) { logger().set_pattern("[" + std::string(name) + "] %v"); }

void logLine(std::string_view text) { logger().info(text); }
void warnLine(std::string_view text) { logger().warn("warning: {}", text); }

}  // namespace ninefold
