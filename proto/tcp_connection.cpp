#include "proto/tcp_connection.h"

#include <algorithm>
#include <utility>

namespace ninefold {
namespace {

constexpr size_t kBatchBytes = 256 << 10;  // what one flush encrypts and sends
constexpr Duration kFinish = std::chrono::seconds(1);

size_t sizeOf(const Frame& frame) {
  return kFrameHeadBytes + frame.header.size() + frame.payload.size();
}

void append(const Frame& frame, Bytes& out) {
  const auto add = [&out](ByteView bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); };
  add(frameHead(frame));
  add(viewOf(frame.header));
  add(frame.payload);
}

}  // namespace

TcpConnection::TcpConnection(asio::io_context& io, std::shared_ptr<SecureSocket> socket, Peer other,
                             const ConnectionOptions& options)
    : io_(io),
      socket_(std::move(socket)),
      other_(other),
      options_(options),
      wakeWriter_(io),
      wakeWatch_(io) {}

TcpConnection::~TcpConnection() = default;

void TcpConnection::start(Events events) {
  NINEFOLD_CHECK(!started_);
  started_ = true;
  events_ = std::move(events);
  if (isClosed_) {  // close() came first
    asio::post(io_,
               [onClosed = std::move(events_.onClosed), why = closeReason_] { onClosed(why); });
    return;
  }
  readDeadline_ = Clock::now() + options_.handshake;
  using Part = asio::awaitable<void> (TcpConnection::*)();
  for (const Part part : {&TcpConnection::readAll, &TcpConnection::writeAll, &TcpConnection::watch})
    spawn(io_, [self = shared_from_this(), part] { return (self.get()->*part)(); });
}

// --- sending ---

bool TcpConnection::send(Message message) {
  Frame frame = encodeMessage(std::move(message));
  const size_t size = sizeOf(frame);
  {
    const std::lock_guard lock(mutex_);
    if (state_ != State::open) return false;
    if (queuedBytes_ + size <= options_.queueBytes) {
      queue_.push_back(std::move(frame));
      queuedBytes_ += size;
      if (std::exchange(writerSleeps_, false)) wake();
      return true;
    }
  }
  close("the send queue is full: the peer takes too little");
  return false;
}

void TcpConnection::wake() {
  asio::post(io_, [self = shared_from_this()] { self->wakeWriter_.cancel(); });
}

std::deque<Frame> TcpConnection::takeBatch(size_t& bytes) {
  const std::lock_guard lock(mutex_);
  std::deque<Frame> batch;
  for (bytes = 0; !queue_.empty() && bytes < kBatchBytes; queue_.pop_front()) {
    bytes += sizeOf(queue_.front());
    batch.push_back(std::move(queue_.front()));
  }
  writerSleeps_ = batch.empty();
  return batch;
}

void TcpConnection::written(size_t bytes) {
  const std::lock_guard lock(mutex_);
  queuedBytes_ -= bytes;
}

asio::awaitable<void> TcpConnection::sleepUntilWoken() {
  NetError woken;
  wakeWriter_.expires_at(Time::max());
  co_await wakeWriter_.async_wait(asio::redirect_error(asio::use_awaitable, woken));
}

asio::awaitable<void> TcpConnection::writeFrames() {
  while (!isClosed_) {
    size_t bytes = 0;
    const std::deque<Frame> batch = takeBatch(bytes);
    for (const Frame& frame : batch) append(frame, plain_);
    socket_->write(plain_);  // at once: few, full records of TLS
    plain_.clear();
    if (socket_->hasOutput()) {
      const auto moved = [this] { writeDeadline_ = Clock::now() + options_.write; };
      moved();
      co_await socket_->flush(moved);
      writeDeadline_ = Time::max();
      written(bytes);
    } else if (state() == State::finishing) {
      // The reader now waits for the peer to end its side too, so that nothing in flight is cut
      // off.
      co_return co_await socket_->end();
    } else {
      co_await sleepUntilWoken();
    }
  }
}

asio::awaitable<void> TcpConnection::writeAll() {
  try {
    co_await writeFrames();
  } catch (const Error& error) {
    // The peer's last words may wait to be read: the reader closes, soon.
    writeDeadline_ = Time::max();
    finishReason_ = error.what();
    finishDeadline_ = Clock::now() + kFinish;
    wakeWatch_.cancel();
  }
}

// --- receiving ---

void TcpConnection::heard(Frame&& frame) {
  if (!std::exchange(heardFirst_, true))
    wakeWatch_.cancel();  // another deadline counts from now on
  if (state() != State::open) return;
  events_.onMessage(decodeMessage(std::move(frame), other_));
}

asio::awaitable<void> TcpConnection::readFrames() {
  while (!isClosed_) {
    // What is there already takes no waiting.
    size_t got = socket_->readReceived(parser_.space());
    if (got == 0) got = co_await socket_->read(parser_.space());
    if (got == 0) break;
    std::optional<Frame> frame = parser_.filled(got);
    if (heardFirst_ || frame) readDeadline_ = Clock::now() + options_.silence;
    if (frame) heard(std::move(*frame));
    if (socket_->hasOutput()) wakeWriter_.cancel();  // TLS itself has something to answer
  }
  if (!parser_.atBoundary()) fail("the peer closed the connection inside a message");
}

asio::awaitable<void> TcpConnection::readAll() {
  std::string reason = "the peer closed the connection";
  try {
    co_await readFrames();
  } catch (const Error& error) {
    reason = error.what();
  }
  closed(finishReason_.empty() ? reason : finishReason_);
}

// --- closing ---

TcpConnection::State TcpConnection::state() {
  const std::lock_guard lock(mutex_);
  return state_;
}

void TcpConnection::finish(std::string reason) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ != State::open) return;
    state_ = State::finishing;
  }
  asio::post(io_, [self = shared_from_this(), why = std::move(reason)] {
    self->finishReason_ = why;
    self->finishDeadline_ = Clock::now() + kFinish;
    self->wakeWriter_.cancel();
    self->wakeWatch_.cancel();
  });
}

void TcpConnection::close(std::string reason) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::closing) return;
    state_ = State::closing;
  }
  asio::post(io_, [self = shared_from_this(), why = std::move(reason)] { self->closed(why); });
}

void TcpConnection::closed(const std::string& reason) {
  if (isClosed_) return;
  isClosed_ = true;
  closeReason_ = reason;
  {
    const std::lock_guard lock(mutex_);
    state_ = State::closing;
    queue_.clear();
  }
  socket_->close();
  wakeWriter_.cancel();
  wakeWatch_.cancel();
  const Events events = std::exchange(events_, {});
  if (events.onClosed) events.onClosed(reason);
}

// --- deadlines ---

std::string TcpConnection::overdue(Time now) const {
  if (now >= finishDeadline_) return finishReason_;
  if (now >= writeDeadline_)
    return fmt::format("the peer took nothing for {:.1f} s", seconds(options_.write));
  if (now < readDeadline_) return {};
  return heardFirst_ ? fmt::format("no sign of life for {:.1f} s", seconds(options_.silence))
                     : fmt::format("no first message within {:.1f} s", seconds(options_.handshake));
}

// When to look again. A write that begins later than now cannot be overdue before now + write.
Time TcpConnection::nextDeadline(Time now) const {
  return std::min({readDeadline_, finishDeadline_, writeDeadline_, now + options_.write});
}

asio::awaitable<void> TcpConnection::watch() {
  while (!isClosed_) {
    const Time now = Clock::now();
    if (const std::string why = overdue(now); !why.empty()) co_return closed(why);
    NetError woken;
    wakeWatch_.expires_at(nextDeadline(now));
    co_await wakeWatch_.async_wait(asio::redirect_error(asio::use_awaitable, woken));
  }
}

}  // namespace ninefold
