// asio.h: the parts of Boost.Asio that the connection uses, and the names it uses them by.
// Internal to the connection.
#pragma once

#include <utility>  // Boost 1.74's awaitable.hpp needs it and does not say so

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <memory>
#include <vector>

#include "proto/event_loop.h"

namespace ninefold {

namespace asio = boost::asio;
using asio::ip::tcp;
using NetError = boost::system::error_code;

struct EventLoop::Impl {
  asio::io_context io{1};
  asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
  std::vector<std::unique_ptr<asio::signal_set>> signals;
};

// Runs a coroutine on the loop. What it lets out comes out of EventLoop::run().
template <typename Coroutine>
void spawn(asio::io_context& io, Coroutine coroutine) {
  asio::co_spawn(io, std::move(coroutine), [](std::exception_ptr error) {
    if (error) std::rethrow_exception(error);
  });
}

}  // namespace ninefold
