// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <boost/signals2/signal.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "external_command/ros/command_gate.h"
#include "external_command/ros/command_registry.h"
#include "external_command/ros/conditions.h"
#include "external_command/ros/display.h"
#include "external_command/ros/executor.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/master_watch.h"
#include "external_command/ros/motion_watch.h"
#include "external_command/ros/parameters.h"
#include "external_command/ros/planning_pads.h"
#include "external_command/ros/planning_pool.h"
#include "external_command/ros/progress_topic.h"
#include "external_command/ros/readiness_topic.h"
#include "external_command/ros/refusal_counts.h"
#include "external_command/ros/request_limits.h"
#include "external_command/ros/vehicle_pose.h"

namespace external_command {

class Diagnostics;
class ReferencePaths;

/// What all processors of one namespace share. Read once, by whoever makes the context.
struct ContextParams {
  std::string map_file;  ///< empty: no map
  MapOrigin map_origin;
  std::string map_cache_folder;  ///< of files from which large maps are loaded sooner; empty: none
  MapParams map;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double max_pose_age = 1.0;             ///< an older vehicle pose counts as missing [s]
  double max_future_stamp = 0.5;         ///< pose, grid, chassis stamped further ahead of now do not count [s]
  double planner_silence_timeout = 5.0;  ///< a running command's message tells when nothing was reported so long [s]
  double max_start_shift =
      0.5;  ///< by which a vehicle may move while its path is planned, and the path stay as it is [m]
  ReportRules reports;
  MotionWatchParams motion_watch;
  PlanningLimits planning;
  RequestLimits requests;
  std::string status_topic = "external_command/status";
  std::string progress_topic = "external_command/progress";
  double progress_rate = 2.0;  ///< of that topic [Hz]
  std::string readiness_topic = "external_command/readiness";
  bool planner_follows_path = false;  ///< the planner listens to path_topic instead of commands, and reports nothing
  std::string log_topic = "external_command/log";
  std::string routing_response_topic = "routing_response";
  std::string path_topic = "external_command/path";
  VehicleParams vehicle;
  RouterParams router;
  LaneWayParams lane_way;
  ReferencePathParams reference_path;
  PathBounds path_bounds;
  DriveLimits limits;
  DisplayParams display;
};

/// @throws InvalidParameter
ContextParams readContextParams(const ParameterReader& reader);

/// What became of the wish to cancel a command.
struct Cancellation {
  bool was_running = false;
  CommandStatus status;  ///< of that command, after it
};

/// Holds what all processors of one namespace in one process share: map, vehicle pose, gate, registry, publishers.
/// Processors keep it alive; the first that asks makes it. Thread-safe.
class ProcessContext {
 public:
  /// The live context of the namespace of `nh`, or a new one with parameters from `parameters`.
  /// @throws InvalidParameter, MapError
  static std::shared_ptr<ProcessContext> acquire(const ros::NodeHandle& nh, const ros::NodeHandle& parameters);

  ProcessContext(const ros::NodeHandle& nh, const ros::NodeHandle& parameters);
  ~ProcessContext();

  const ContextParams& params() const { return params_; }

  /// The namespace, which tells the vehicles of one process apart.
  const std::string& vehicleName() const { return nh_.getNamespace(); }

  /// nullptr where no map is configured.
  const Router* router() const { return router_.get(); }

  /// @throws NotReady  no map is configured; the text names the parameter.
  const Router& requireRouter() const;

  /// What the map's reference paths are made by. @throws NotReady  as requireRouter()
  const ReferencePaths& requireReferencePaths() const;

  const VehiclePose& vehiclePose() const { return vehicle_pose_; }
  CommandGate& gate() { return gate_; }
  CommandRegistry& registry() { return registry_; }
  MotionWatch& motionWatch() { return motion_watch_; }
  PlanningPool& planningPool() { return *planning_pool_; }
  PlanningPads& planningPads() { return planning_pads_; }
  Display& display() { return display_; }

  /// What the commands of all processors need, for readiness and diagnostics.
  Conditions& conditions() { return conditions_; }

  /// The map in a few words. @throws NotReady  as requireRouter()
  std::string mapWords() const;

  /// True where the planner has reported anything since the start.
  bool hasPlannerReported() const { return last_report_ > 0.0; }

  /// Of commands, since the start.
  RefusalCounts& refusals() { return refusals_; }

  MasterWatch& masterWatch() { return *master_watch_; }

  /// Every motion that was sent, in the order of sending; told with sendingMutex() held.
  using SentMotions = boost::signals2::signal<void(const SentMotion&)>;
  SentMotions& sentMotions() { return sent_motions_; }

  /// Every change of any command's status, in order; told while the registry is held: who listens must not wait.
  using StatusChanges = boost::signals2::signal<void(CommandSerial, const CommandStatus&)>;
  StatusChanges& statusChanges() { return status_changes_; }

  /// Held from the commit of a motion until everyone knows of it. A stop does not take it.
  std::mutex& sendingMutex() { return sending_mutex_; }

  /// Shows route and path of what was sent, behind the answer and in the order of sending, on the housekeeping
  /// executor. A stop does not wait for it.
  void showSentLater();

  /// Puts route and path of the motion under way back onto their topics, from where the vehicle has come: it goes on
  /// after a stop. What the planning module got is not sent once more.
  void showMotionAgain();

  /// Ends one command, whatever it waits for, and no other; it is then ERROR, CANCELLED. What is planned is not sent;
  /// the planner clears what is driven; what else was sent (an action, a signal) is waited for no longer. Waits for
  /// nothing.
  /// @param by  who cancels it, for the status' message.
  Cancellation cancel(CommandSerial serial, const std::string& by);

  /// The same for the newest command by that id.
  Cancellation cancelById(std::int64_t command_id, const std::string& by);

  /// A report of the vehicle's about a command of `processor`.
  void takeReport(CommandStatus report, const std::string& processor);

  /// For the vehicle's reports. Nothing that could wait runs there.
  Executor& reports() { return reports_; }

  /// For other short callbacks that need nothing but this context.
  Executor& housekeeping() { return housekeeping_; }

  /// One publisher per topic for all processors: several latched ones on a topic would each hand a new subscriber its
  /// own last message, and the newest command would not be the last to arrive.
  /// @throws InternalError  the topic is published with another type in this process.
  template <class Message>
  ros::Publisher advertise(const std::string& topic, bool latch) {
    const std::string type = ros::message_traits::datatype<Message>();
    const std::string name = nh_.resolveName(topic);
    const std::lock_guard<std::mutex> lock(publishers_mutex_);
    Shared& shared = publishers_[name];
    if (!shared.publisher) shared = {nh_.advertise<Message>(topic, kQueueSize, latch), type};
    requireAdvertised(shared.publisher && shared.type == type, name, type);
    return shared.publisher;
  }

 private:
  std::vector<ros::Publisher> configuredPads();
  void showSent();

  struct Shared {
    ros::Publisher publisher;
    std::string type;
  };

  static constexpr int kQueueSize = 100;

  /// What plans leave behind in the allocator's arenas goes back to the system, in a quiet moment: an arena is locked
  /// for some milliseconds then.
  void giveBackMemory();

  std::unique_ptr<Diagnostics> makeDiagnostics(const ros::NodeHandle& parameters);

  const ContextParams params_;
  const std::shared_ptr<MasterWatch> master_watch_ = MasterWatch::ofProcess();
  ros::NodeHandle nh_;
  std::mutex publishers_mutex_;
  std::map<std::string, Shared> publishers_;
  const std::shared_ptr<LogWriter> log_writer_;
  const std::shared_ptr<PlanningPool> planning_pool_;
  const std::shared_ptr<const Router> router_;
  const std::shared_ptr<const ReferencePaths> reference_paths_;  ///< nullptr where there is no router
  const VehiclePose vehicle_pose_;
  PlanningPads planning_pads_;
  CommandGate gate_;
  StatusChanges status_changes_;
  CommandRegistry registry_;
  MotionWatch motion_watch_;
  ProgressTopic progress_topic_;
  Conditions conditions_;
  ReadinessTopic readiness_topic_;
  RefusalCounts refusals_;
  std::atomic<double> last_report_{0.0};  ///< of the planner, steady time [s]; 0: none came
  std::unique_ptr<Diagnostics> diagnostics_;
  SentMotions sent_motions_;
  std::mutex sending_mutex_;
  Display display_;
  LogThrottle odd_reports_{10.0};
  Executor housekeeping_, reports_;  // after all that their callbacks use, before what is bound to their queues
  ArrivalNumber last_arrival_ = 0;   ///< giveBackMemory() looked at it
  bool has_memory_ = false;          ///< that was not given back since
  Periodic silence_timer_, motion_timer_, progress_timer_, readiness_timer_, diagnostics_timer_, memory_timer_;
};

}  // namespace external_command
