// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/ros/command_identity.h"
#include "external_command/ros/motion_topics.h"
#include "external_command/ros/rising_stamps.h"

namespace external_command {

/// A motion command as it was sent.
struct SentMotion {
  AdmittedCommand command;
  std::shared_ptr<const Path> path;  ///< never nullptr
  /// What is to be added to an index of the path that was planned to get that of `path`: a stretch may have been put in
  /// front of it, or the vehicle may have driven the first of it already (negative then).
  std::ptrdiff_t index_shift = 0;
  std::shared_ptr<MotionTopics> topics;  ///< guarded by the gate; may be nullptr
};

/// Decides which motion command may move the vehicle. One mutex, held for a compare and for handing over what is
/// serialized already, never while planning. Thread-safe.
///
///   arrive()  when the request comes        -> what is stopped later than this stops it too
///   Planning  as long as work is done on it -> a stop, a later command that begins, or its cancelling ends that
///   begin()   before the long planning      -> ends the work on what arrived earlier
///   commit()  to send it                    -> refused where a stop or a later arrival came in between
///   cancel()  to end this one only          -> it is not sent, or cleared
///   retire()  when it has ended             -> it moves the vehicle no more
class CommandGate {
 private:
  struct Work;

 public:
  /// Work on one command, from its first check to its sending, as long as this lives. It must not outlive the gate.
  class Planning {
   public:
    enum class Kind { kMotion, kDryRun };  ///< a dry run moves nothing: neither a stop nor a later command ends it

    /// @param source  raised to end the work.
    /// @throws  for a motion, as requireNewest().
    Planning(CommandGate* gate, Kind kind, const AdmittedCommand& command, const CancelSource& source);
    ~Planning();
    Planning(const Planning&) = delete;
    Planning& operator=(const Planning&) = delete;

    const AdmittedCommand& command() const;
    CancelToken cancelToken() const;

   private:
    CommandGate& gate_;
    std::list<Work>::iterator work_;
  };

  /// The right to send one command once.
  class Ticket {
   public:
    const AdmittedCommand& command() const { return command_; }
    const CancelToken& cancelToken() const { return cancel_; }

   private:
    friend class CommandGate;
    AdmittedCommand command_;
    CancelToken cancel_;
  };

  CommandGate();

  /// The next number; every request that came in earlier has a smaller one. Takes no lock: the network thread calls it.
  ArrivalNumber arrive() { return ++*arrivals_; }

  /// The same for queues that take it of each callback: they may outlive the gate.
  std::function<ArrivalNumber()> arrivalStamp() const {
    return [arrivals = arrivals_] { return ++*arrivals; };
  }

  /// For what planners compare by its time, motions and stops: later than that of all that was stamped before.
  ros::Time stamp() { return stamps_.next(); }

  /// Differs from those of all other gates, of other processes too.
  const std::string& name() const { return name_; }

  /// True where a stop came in at `time` or later, by the time of day.
  bool wasStoppedSince(const ros::WallTime& time) const;

  /// @throws Cancelled   a stop came in since the command arrived.
  /// @throws Superseded  a command that arrived later has begun.
  void requireNewest(const AdmittedCommand& command) const;

  /// Calls `publish` for a command that moves nothing by itself, before or after any stop.
  /// @throws Cancelled  a stop came in since the command arrived; nothing is published.
  void sendUnlessStopped(const AdmittedCommand& command, const std::function<void()>& publish) const;

  /// Ends the work on older commands. A command may begin more than once.
  /// @throws  as requireNewest(); Cancelled also where `planning` was cancelled already.
  Ticket begin(const Planning& planning);

  /// Calls `publish` and makes the ticket's command the one that moves the vehicle.
  /// @return  the motion it replaces; nullptr where none was under way.
  /// @throws  as begin(); nothing is published.
  std::shared_ptr<const SentMotion> commit(const Ticket& ticket, std::shared_ptr<const SentMotion> motion,
                                           const std::function<void()>& publish);

  /// Ends the work on motions; nothing that arrived before is sent any more. Does not wait for it.
  /// `publish` (may be empty) is called while the gate is held, so that what it sends leaves after every commit before
  /// it and before every one after it.
  /// @param withdraws  the motion under way, too, so that a planner that starts later does not drive it.
  /// @return  that motion; nullptr where there is none.
  std::shared_ptr<const SentMotion> stop(bool withdraws, const std::function<void()>& publish);

  /// Ends the work on one command, and the command, and no other. Both functions are called while the gate is held.
  /// @param end    ends the command; false where it has ended already, then nothing is cleared.
  /// @param clear  tells the planner to clear the motion, where it is the one under way. The stamp to give lies before
  ///               that of any motion that is sent later: planners take a stop to be about the motions before its
  ///               stamp.
  void cancel(CommandSerial serial, const std::function<bool()>& end,
              const std::function<void(const ros::Time& stamp)>& clear);

  /// Ends the motion `serial` and withdraws it; does nothing where another one is under way.
  void retire(CommandSerial serial);

  /// Shows what is left of the motion `serial` again, where a stop withdrew it and it is under way still.
  void showAgain(CommandSerial serial, const Path& rest);

  /// The oldest motion that was sent, and of which no more was shown yet than the planning module needs; nullptr where
  /// there is none. Of more than 16 the oldest are left out, and all of them where a motion is withdrawn.
  std::shared_ptr<const SentMotion> unshown() const;

  /// Calls `publish`, unless `motion` is no longer what unshown() returns.
  void show(const SentMotion& motion, const std::function<void()>& publish);

  /// The motion under way: sent, and not retired since. May be nullptr.
  std::shared_ptr<const SentMotion> motion() const;

  /// The last that was sent, whether or not it is under way; 0 where none was.
  CommandSerial lastMotion() const;

 private:
  struct Work {
    Planning::Kind kind;
    AdmittedCommand command;
    CancelSource source;
  };

  void requireNotStoppedLocked(const AdmittedCommand& command) const;
  void requireNewestLocked(const AdmittedCommand& command) const;
  void endWorkLocked(const std::function<bool(const Work&)>& is_meant);
  void withdrawLocked();

  const std::string name_;
  RisingStamps stamps_;
  mutable std::mutex mutex_;
  const std::shared_ptr<std::atomic<ArrivalNumber>> arrivals_ = std::make_shared<std::atomic<ArrivalNumber>>(0);
  ArrivalNumber stopped_ = 0;  ///< arrivals up to this one were stopped
  ros::WallTime last_stop_;    ///< zero: never
  AdmittedCommand newest_;     ///< that began, by its arrival
  ros::Time newest_began_;     ///< every motion of it has a later stamp
  std::list<Work> works_;
  std::shared_ptr<const SentMotion> motion_;
  std::deque<std::shared_ptr<const SentMotion>> unshown_;
  CommandSerial last_motion_ = 0;
};

}  // namespace external_command
