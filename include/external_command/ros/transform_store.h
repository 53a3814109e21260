// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace external_command {

/// A tf2 buffer that no transform can spoil. What tf2 would keep for ever, or prefer to all that comes later, is
/// refused at the door: stamps from the future, rotations and frames that are none, an edge that closes a loop, a
/// moving frame that was fixed before or the other way round. Whoever comes regularly wins over what came once: an edge
/// that is no longer published gives way within kFresh. add() from one thread at a time; lookup() from any.
class TransformStore {
 public:
  static constexpr double kFresh = 1.0;             ///< an edge of /tf that was not repeated for so long gives way [s]
  static constexpr double kHandover = 2.0;          ///< a fixed edge waits so long for a moving one to end [s]
  static constexpr int kInsists = 3;                ///< so many within kFresh displace a fixed edge
  static constexpr std::size_t kMaxFrames = 10000;  ///< frames at once
  static constexpr std::size_t kMaxDepth = 200;     ///< edges from a frame to the root
  static constexpr std::size_t kMaxFrameName = 1000;  ///< [characters]

  /// @param max_future_stamp  a stamp of /tf further ahead of now is refused [s].
  explicit TransformStore(double max_future_stamp);

  /// Takes a transform of /tf, or of /tf_static where `is_static`.
  /// @param now      ROS time: where it is earlier than at the last call, time jumped back, and all of /tf is
  /// forgotten.
  /// @param arrival  of a clock that never jumps [s].
  /// @return why it was refused; empty where it was taken, or is older than what is known.
  std::string add(const geometry_msgs::TransformStamped& transform, bool is_static, ros::Time now, double arrival);

  /// For times at which nothing comes: to be called now and then, in the thread of add().
  void tidy(ros::Time now, double arrival);

  /// Of the newest time at which the whole way between both frames is known; stamp 0 where all of it is static.
  /// @throws tf2::TransformException
  geometry_msgs::TransformStamped lookup(const std::string& target, const std::string& source) const;

  /// True for a frame that goes where `vehicle` goes, which lies between it and `world`, or is fixed to it.
  bool isCarried(const std::string& frame, const std::string& vehicle, const std::string& world) const;

  std::size_t frames() const { return edges_.size(); }

 private:
  struct Edge {
    geometry_msgs::TransformStamped newest;
    bool is_static = false;
    bool is_unstamped = false;  ///< its publisher gives no stamps
    double arrival = 0.0;
  };
  /// Of what is refused in favour of another edge.
  struct Rival {
    int count = 0;
    double since = 0.0;
  };
  using Edges = std::map<std::string, Edge>;  // by child

  bool isFresh(const Edge& edge, double arrival) const;
  void noteTime(ros::Time now);
  std::string stampProblem(geometry_msgs::TransformStamped* transform, Edge* edge, ros::Time now) const;
  std::string makeWay(const Edge& edge, double arrival);
  std::string makeWayForKind(const Edge& edge, double arrival);
  std::string openLoop(const Edge& edge, double arrival);
  std::string makeRoom(const std::string& child, double arrival);
  bool insists(const std::string& child, double arrival);
  bool mayForget(double arrival);
  void forget(const std::string& child);
  void rebuild();
  std::string insert(const Edge& edge);
  std::shared_ptr<tf2::BufferCore> buffer() const;

  const double max_future_stamp_;
  ros::Time last_now_;
  double last_room_made_ = -kFresh, last_forgotten_ = -kFresh;
  Edges edges_;
  Edges waiting_;  ///< static ones whose frame still moves
  std::map<std::string, Rival> rivals_;
  bool must_rebuild_ = false;
  mutable std::mutex mutex_;
  std::shared_ptr<tf2::BufferCore> buffer_;  ///< guarded by mutex_; replaced as a whole, since tf2 forgets no frame
};

}  // namespace external_command
