// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace external_command {

enum class LogLevel { kInfo, kWarn, kError, kFatal };

/// Lets one line through per period, and counts those it keeps back. Thread-safe.
class LogThrottle {
 public:
  explicit LogThrottle(double period) : period_(period) {}  ///< [s]

  /// @param kept_back  how many since the last line that was let through.
  bool lets(std::size_t* kept_back);

 private:
  const std::chrono::duration<double> period_;
  std::mutex mutex_;
  std::size_t kept_back_ = 0;
  std::chrono::steady_clock::time_point next_;
};

/// Writes log lines on a thread of its own: output that nobody reads (a full pipe, a stalled disk) blocks whoever
/// writes, and must not delay an answer, a status, or a STOP. Of more than 1,000 waiting lines the newest are dropped,
/// and counted. Thread-safe.
class LogWriter {
 public:
  /// The live one of this process, or a new one. Kept by who needs it to live.
  static std::shared_ptr<LogWriter> acquire();

  LogWriter();

  /// Writes what waits; gives up after a second where the output stalls.
  ~LogWriter();

  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  void write(LogLevel level, std::string line);

 private:
  struct State;
  const std::shared_ptr<State> state_;  ///< shared with the thread, which may be stuck in a write for good
  std::thread thread_;
};

/// By the live log writer; by this thread itself where there is none.
void logLater(LogLevel level, std::string line);

/// The same for lines that may come often.
void logLater(LogLevel level, LogThrottle& throttle, const std::string& line);

}  // namespace external_command
