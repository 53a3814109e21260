// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/transform_store.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <vector>

#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/ros/frame_id.h"

namespace external_command {

namespace {

constexpr double kMaxTranslation = 1e9;  // [m], more than any map's coordinates
constexpr double kMaxNormError = 1e-2;   // of a rotation's squared length; as tf2
constexpr double kMaxBackStep = 0.01;    // of ROS time that is no jump [s]
constexpr double kForgetPause = 0.1;     // between two times that tf2's buffer is made anew for the sake of a frame [s]

std::string edgeName(const geometry_msgs::TransformStamped& transform) {
  return text(quoted(transform.header.frame_id), " -> ", quoted(transform.child_frame_id));
}

std::string frameProblem(const geometry_msgs::TransformStamped& transform) {
  const std::string& parent = transform.header.frame_id;
  const std::string& child = transform.child_frame_id;
  if (parent.empty() || child.empty()) return "a frame id is empty";
  if (parent == child) return "both frame ids are the same";
  if (std::max(parent.size(), child.size()) > TransformStore::kMaxFrameName) return "a frame id is too long";
  return "";
}

std::string valueProblem(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  for (const double value : {t.x, t.y, t.z}) {
    if (!(std::abs(value) <= kMaxTranslation)) return "its translation is not finite, or over 1e9 m";
  }
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(norm - 1.0) <= kMaxNormError)) return "its rotation is no unit quaternion";
  return "";
}

}  // namespace

TransformStore::TransformStore(double max_future_stamp)
    : max_future_stamp_(max_future_stamp), buffer_(std::make_shared<tf2::BufferCore>()) {}

std::string TransformStore::add(const geometry_msgs::TransformStamped& transform, bool is_static, ros::Time now,
                                double arrival) {
  noteTime(now);
  Edge edge;
  edge.newest = transform;
  edge.is_static = is_static;
  edge.arrival = arrival;
  edge.newest.header.frame_id = frameId(transform.header.frame_id);
  edge.newest.child_frame_id = frameId(transform.child_frame_id);
  std::string problem = frameProblem(edge.newest);
  if (problem.empty()) problem = valueProblem(edge.newest.transform);
  if (problem.empty()) problem = stampProblem(&edge.newest, &edge, now);
  if (problem.empty()) problem = makeWay(edge, arrival);
  if (problem.empty()) problem = insert(edge);
  if (problem.empty()) return "";
  return text("transform ", edgeName(edge.newest), " refused: ", problem);
}

void TransformStore::tidy(ros::Time now, double arrival) {
  noteTime(now);
  for (auto late = waiting_.begin(); late != waiting_.end();) {
    const auto moving = edges_.find(late->first);
    if (moving != edges_.end() && isFresh(moving->second, arrival)) {
      late = arrival - late->second.arrival > kHandover ? waiting_.erase(late) : std::next(late);
      continue;
    }
    if (!mayForget(arrival)) return;
    forget(late->first);
    if (openLoop(late->second, arrival).empty()) insert(late->second);
    late = waiting_.erase(late);
  }
}

geometry_msgs::TransformStamped TransformStore::lookup(const std::string& target, const std::string& source) const {
  return buffer()->lookupTransform(target, source, ros::Time(0));
}

bool TransformStore::isCarried(const std::string& frame, const std::string& vehicle, const std::string& world) const {
  const std::shared_ptr<tf2::BufferCore> tree = buffer();
  std::string above = frame;
  for (std::size_t depth = 0; depth <= kMaxDepth && above != world; ++depth) {
    if (above == vehicle) return true;
    const std::string below = above;
    if (!tree->_getParent(below, ros::Time(0), above)) break;
  }
  try {
    return tree->lookupTransform(vehicle, frame, ros::Time(0)).header.stamp.isZero();
  } catch (const tf2::TransformException&) {
    return false;
  }
}

bool TransformStore::isFresh(const Edge& edge, double arrival) const {
  return edge.is_static || arrival - edge.arrival <= kFresh;
}

void TransformStore::noteTime(ros::Time now) {
  if (now.toSec() < last_now_.toSec() - kMaxBackStep) {
    for (auto edge = edges_.begin(); edge != edges_.end();) edge = edge->second.is_static ? ++edge : edges_.erase(edge);
    rebuild();
  }
  last_now_ = now;
}

std::string TransformStore::stampProblem(geometry_msgs::TransformStamped* transform, Edge* edge, ros::Time now) const {
  if (edge->is_static) {
    transform->header.stamp = ros::Time();  // it has no meaning, and tf2 adds up what it is given
    return "";
  }
  if (transform->header.stamp.isZero()) {
    const auto known = edges_.find(transform->child_frame_id);
    if (known != edges_.end() && !known->second.is_unstamped && isFresh(known->second, edge->arrival)) {
      return "it has no stamp, others of this frame have";
    }
    edge->is_unstamped = true;
    transform->header.stamp = now;
    return "";
  }
  const double ahead = transform->header.stamp.toSec() - now.toSec();
  if (ahead <= max_future_stamp_) return "";
  return text("its stamp is ", seconds(ahead), " in the future; the limit is ", seconds(max_future_stamp_),
              " (~max_future_stamp): do the clocks agree?");
}

/// Decides between a transform and what is known. @return why it is not taken.
std::string TransformStore::makeWay(const Edge& edge, double arrival) {
  std::string problem = makeWayForKind(edge, arrival);
  if (problem.empty()) problem = openLoop(edge, arrival);
  if (problem.empty()) problem = makeRoom(edge.newest.child_frame_id, arrival);
  return problem;
}

/// tf2 never lets a static frame move, and takes a static transform of a moving one for a sample of its stamp.
std::string TransformStore::makeWayForKind(const Edge& edge, double arrival) {
  const std::string& child = edge.newest.child_frame_id;
  const auto known = edges_.find(child);
  if (known == edges_.end() || known->second.is_static == edge.is_static) return "";
  if (edge.is_static) {
    waiting_[child] = edge;
    return "the frame moves on /tf";
  }
  if (!insists(child, arrival)) return "the frame is fixed by /tf_static";
  forget(child);
  return "";
}

std::string TransformStore::openLoop(const Edge& edge, double arrival) {
  const std::string& child = edge.newest.child_frame_id;
  std::vector<std::string> way;
  std::string frame = edge.newest.header.frame_id;
  for (auto up = edges_.find(frame); frame != child && up != edges_.end(); up = edges_.find(frame)) {
    way.push_back(frame);
    frame = up->second.newest.header.frame_id;
    if (way.size() > kMaxDepth) return text("it would lie deeper than ", kMaxDepth, " frames");
  }
  if (frame != child) return "";
  const auto is_stale = [&](const std::string& name) { return !isFresh(edges_.at(name), arrival); };
  const auto is_fixed = [&](const std::string& name) { return edges_.at(name).is_static; };
  const auto known = edges_.find(child);
  const bool has_stale = std::any_of(way.begin(), way.end(), is_stale);
  const bool is_alone = known == edges_.end() || !isFresh(known->second, arrival);
  const bool displaces = is_alone && std::any_of(way.begin(), way.end(), is_fixed);
  if (has_stale ? !mayForget(arrival) : !(displaces && insists(child, arrival))) return "it would close a loop";
  for (const std::string& name : way) {
    if (has_stale ? is_stale(name) : is_fixed(name)) forget(name);
  }
  return "";
}

std::string TransformStore::makeRoom(const std::string& child, double arrival) {
  if (edges_.size() < kMaxFrames || edges_.count(child) != 0) return "";
  if (arrival - last_room_made_ >= kFresh) {
    last_room_made_ = arrival;
    for (auto edge = edges_.begin(); edge != edges_.end();) {
      edge = isFresh(edge->second, arrival) ? ++edge : edges_.erase(edge);
    }
    rivals_.clear();
    waiting_.clear();
    rebuild();
  }
  if (edges_.size() < kMaxFrames) return "";
  return text("there are ", kMaxFrames, " frames already; who publishes so many?");
}

/// True for what comes again and again, as a transform that is meant does.
bool TransformStore::insists(const std::string& child, double arrival) {
  if (rivals_.size() > kMaxFrames) rivals_.clear();
  Rival& rival = rivals_[child];
  if (rival.count == 0 || arrival - rival.since > kFresh) rival = {0, arrival};
  if (++rival.count < kInsists || !mayForget(arrival)) return false;
  rivals_.erase(child);
  return true;
}

bool TransformStore::mayForget(double arrival) {
  if (arrival != last_forgotten_ && arrival - last_forgotten_ < kForgetPause) return false;
  last_forgotten_ = arrival;
  return true;
}

void TransformStore::forget(const std::string& child) {
  edges_.erase(child);
  must_rebuild_ = true;
}

void TransformStore::rebuild() {
  auto buffer = std::make_shared<tf2::BufferCore>();
  for (const auto& [child, edge] : edges_) buffer->setTransform(edge.newest, "", edge.is_static);
  must_rebuild_ = false;
  const std::lock_guard<std::mutex> lock(mutex_);
  buffer_ = std::move(buffer);
}

std::string TransformStore::insert(const Edge& edge) {
  if (must_rebuild_) rebuild();
  Edge& known = edges_[edge.newest.child_frame_id];
  // tf2 would look for the place of an old one; nobody asks for the past here.
  if (!edge.is_static && edge.newest.header.stamp <= known.newest.header.stamp) return "";
  known = edge;
  try {
    if (buffer()->setTransform(edge.newest, "", edge.is_static)) return "";
  } catch (const std::exception& error) {
    return text("tf2 cannot take it: ", error.what());
  }
  return "tf2 does not take it";
}

std::shared_ptr<tf2::BufferCore> TransformStore::buffer() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return buffer_;
}

}  // namespace external_command
