// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace external_command {

struct Registrations;

/// Keeps this process known to the ROS master. roscpp registers everything once: where the master was started anew, its
/// services and topics are there, but nobody finds them any more. A thread asks the master once a second, by calls that
/// do not wait for ever, and puts back what it has lost: parameters first, then topics, services last.
/// One per process; lives as long as somebody holds it. Thread-safe.
class MasterWatch {
 public:
  static std::shared_ptr<MasterWatch> ofProcess();

  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// Notes the parameters below `name`, as they are, to set those again that a new master lacks.
  void keepParameters(const std::string& name);

  /// The services of this process that the master knows; asks it. Empty where it does not answer.
  std::vector<std::string> services();

 private:
  struct KeptParameters;
  struct Lost;

  void run();
  void look();
  void noteAnswer(bool is_there);
  void noteServices(const std::set<std::string>& registered);
  Registrations present();
  bool endsForTwin();
  void putBack(const Registrations& lost, bool is_new);

  std::mutex mutex_;
  std::condition_variable is_ending_changed_;
  bool is_ending_ = false;                      ///< guarded by mutex_
  std::set<std::string> services_;              ///< once seen at the master; guarded by mutex_
  const std::unique_ptr<KeptParameters> kept_;  ///< guarded by mutex_
  const std::unique_ptr<Lost> lost_before_;     ///< at the last look
  bool is_silent_ = false;                      ///< the master did not answer the last look
  int master_pid_ = 0;
  std::thread thread_;  // last: uses all others
};

}  // namespace external_command
