// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/log_writer.h"

#include <ros/console.h>

#include "external_command/core/text.h"
#include "thread_priority.h"

namespace external_command {

namespace {

constexpr std::size_t kMostWaiting = 1000;       // lines
constexpr std::chrono::seconds kLastWords(1);    // for what waits when the writer ends
constexpr std::chrono::milliseconds kPause(10);  // after a line; to wake a thread for each takes as long as a call may

std::mutex live_mutex;
std::weak_ptr<LogWriter>& live() {
  static std::weak_ptr<LogWriter> writer;
  return writer;
}

void writeNow(LogLevel level, const std::string& line) {
  switch (level) {
    case LogLevel::kInfo:
      ROS_INFO_STREAM(line);
      break;
    case LogLevel::kWarn:
      ROS_WARN_STREAM(line);
      break;
    case LogLevel::kError:
      ROS_ERROR_STREAM(line);
      break;
    case LogLevel::kFatal:
      ROS_FATAL_STREAM(line);
      break;
  }
}

}  // namespace

bool LogThrottle::lets(std::size_t* kept_back) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) {
    ++kept_back_;
    return false;
  }
  next_ = now + std::chrono::duration_cast<std::chrono::steady_clock::duration>(period_);
  *kept_back = std::exchange(kept_back_, 0);
  return true;
}

struct LogWriter::State {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::pair<LogLevel, std::string>> waiting;
  std::size_t dropped = 0;
  bool is_asleep = false;  // until somebody wakes it
  bool is_ending = false;
  bool has_ended = false;

  void run() {
    lowerThreadPriority();
    std::unique_lock<std::mutex> lock(mutex);
    while (true) {
      if (waiting.empty()) changed.wait_for(lock, kPause, [this] { return is_ending; });
      is_asleep = true;
      changed.wait(lock, [this] { return is_ending || !waiting.empty(); });
      is_asleep = false;
      if (waiting.empty()) break;
      const auto line = std::move(waiting.front());
      waiting.pop_front();
      const std::size_t lost = std::exchange(dropped, 0);
      lock.unlock();
      writeNow(line.first, line.second);
      if (lost > 0) writeNow(LogLevel::kWarn, text(lost, " log lines were dropped: the output stalled"));
      lock.lock();
    }
    has_ended = true;
    changed.notify_all();
  }
};

std::shared_ptr<LogWriter> LogWriter::acquire() {
  const std::lock_guard<std::mutex> lock(live_mutex);
  auto writer = live().lock();
  if (!writer) live() = writer = std::make_shared<LogWriter>();
  return writer;
}

LogWriter::LogWriter() : state_(std::make_shared<State>()), thread_([state = state_] { state->run(); }) {}

LogWriter::~LogWriter() {
  std::unique_lock<std::mutex> lock(state_->mutex);
  state_->is_ending = true;
  state_->changed.notify_all();
  const bool has_ended = state_->changed.wait_for(lock, kLastWords, [this] { return state_->has_ended; });
  lock.unlock();
  if (has_ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

void LogWriter::write(LogLevel level, std::string line) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (state_->waiting.size() >= kMostWaiting) {
    ++state_->dropped;
    return;
  }
  state_->waiting.emplace_back(level, std::move(line));
  if (state_->is_asleep) state_->changed.notify_all();
}

void logLater(LogLevel level, std::string line) {
  std::unique_lock<std::mutex> lock(live_mutex);
  const auto writer = live().lock();
  lock.unlock();
  if (writer) {
    writer->write(level, std::move(line));
  } else {
    writeNow(level, line);
  }
}

void logLater(LogLevel level, LogThrottle& throttle, const std::string& line) {
  std::size_t kept_back = 0;
  if (!throttle.lets(&kept_back)) return;
  logLater(level, kept_back == 0 ? line : text(line, " (", kept_back, " such lines were left out before this one)"));
}

}  // namespace external_command
