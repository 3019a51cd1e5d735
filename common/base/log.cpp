#include "common/base/log.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <string>

#include "common/base/standard_streams.h"

namespace ninefold {
namespace {

// spdlog's own sinks die with the reader of a pipe, or wait for it.
class Sink : public spdlog::sinks::base_sink<std::mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    sayToPeople({text.data(), text.size()});
  }
  void flush_() override {}
};

spdlog::logger& logger() {
  static spdlog::logger instance = [] {
    spdlog::logger made("ninefold", std::make_shared<Sink>());
    made.set_pattern("%v");
    return made;
  }();
  return instance;
}

}  // namespace

void nameLog(std::string_view name) { logger().set_pattern("[" + std::string(name) + "] %v"); }

void logLine(std::string_view text) { logger().info(text); }
void warnLine(std::string_view text) { logger().warn("warning: {}", text); }

}  // namespace ninefold
