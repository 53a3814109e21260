// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/display.h"

#include <ros/single_subscriber_publisher.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/frame_id.h"
#include "external_command/ros/map_markers.h"
#include "external_command/ros/prepared_message.h"

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kCommandPeriod = 0.05;  // [s]
constexpr double kMapPeriod = 0.5;       // between two looks at where the vehicle is [s]
constexpr double kIdsPeriod = 3.0;       // [s]
constexpr double kSmallestRing = 1.5;    // radius, in lengths of the vehicle
constexpr double kLargestRing = 25.0;    // [m]
constexpr double kRingShare = 0.02;      // of what is drawn of the map

/// roscpp would make the bytes while it holds a lock that every publisher of the process waits for, that of a stop too;
/// these are drawn on a thread of low priority.
void sendPrepared(const ros::Publisher& publisher, const MarkerArray& array) {
  PreparedMessage(publisher, array).send();
}

ros::NodeHandle onQueue(ros::NodeHandle nh, ros::CallbackQueueInterface* queue) {
  nh.setCallbackQueue(queue);
  return nh;
}

void append(MarkerArray added, MarkerArray* array) {
  std::move(added.markers.begin(), added.markers.end(), std::back_inserter(array->markers));
}

double ringRadius(const VehicleParams& vehicle, const BoundingBox& drawn) {
  const double size = (drawn.max - drawn.min).norm() / 2.0;
  return std::max(kSmallestRing * vehicle.length(), std::min(kLargestRing, kRingShare * size));
}

}  // namespace

void requireAdvertised(bool is_advertised, const std::string& topic, const std::string& type) {
  if (is_advertised) return;
  throw InternalError(text("topic ", topic, " cannot be published as ", type,
                           ": this process publishes another type there; give one of the two another name"));
}

DisplayParams readDisplayParams(const ParameterReader& reader) {
  DisplayParams params;
  reader.readName("markers_name", &params.markers_topic);
  reader.readName("map_ids_name", &params.map_ids_topic);
  reader.readName("look_at_name", &params.look_at_topic);
  const ParameterReader drawn = reader.within("display");
  drawn.readSize("max_objects", 1, 10000000, &params.map.max_objects);
  drawn.readWithin("radius", 10.0, 100000.0, &params.map.radius);
  drawn.readSize("max_ids", 0, 100000, &params.max_ids);
  return params;
}

Display::Display(ros::NodeHandle nh, const DisplayParams& params, std::shared_ptr<const HdMap> map, Whereabouts vehicle)
    : params_(params),
      map_(std::move(map)),
      vehicle_(std::move(vehicle)),
      executor_(ExecutorOptions{"the display's executor", 1, ExecutorPriority::kBackground}),
      nh_(onQueue(nh, executor_.queue())) {
  if (map_) {
    scene_.chooser.emplace(*map_, params_.map);
    ids_.chooser.emplace(*map_, MapPartParams{params_.max_ids, params_.map.radius});
  }
  // Who subscribes is greeted on the executor, by what is current then.
  const auto advertise = [&](const std::string& topic, bool latch, MarkerArray (Display::*greeting)()) {
    const ros::Publisher publisher = nh_.advertise<MarkerArray>(
        topic, 10,
        [this, greeting](const ros::SingleSubscriberPublisher& new_one) { new_one.publish((this->*greeting)()); },
        ros::SubscriberStatusCallback(), ros::VoidConstPtr(), latch);
    requireAdvertised(publisher, nh_.resolveName(topic), "visualization_msgs/MarkerArray");
    return publisher;
  };
  scene_.publisher = advertise(params_.markers_topic, true, &Display::wholeScene);
  ids_.publisher = advertise(params_.map_ids_topic, false, &Display::ids);
  look_at_subscriber_ = subscribeBounded<geometry_msgs::PointStamped>(
      nh_, params_.look_at_topic, 1,
      [this](const ros::MessageEvent<geometry_msgs::PointStamped const>& event) { lookAt(*event.getMessage()); },
      params_.requests);
  command_timer_ = executor_.every(
      kCommandPeriod, [this] { drawNewest(); }, [this] { return has_news_.load(); });
  map_timer_ = executor_.every(kMapPeriod, [this] { drawMap(); });
  ids_timer_ = executor_.every(kIdsPeriod, [this] { drawIds(); });
}

MarkerArray Display::wholeScene() {
  MarkerArray array;
  BoundingBox drawn = {Point2d::Zero(), Point2d::Zero()};
  if (scene_.chooser) {
    scene_.chooser->placeVehicle(vehicle_());
    const MapPart part = scene_.chooser->part();
    drawn = part.box;
    array = mapMarkers(part, params_.map_frame);
  }
  append(vehicleMarkers(params_.vehicle, params_.base_frame, ringRadius(params_.vehicle, drawn)), &array);
  append(command_, &array);
  return array;
}

MarkerArray Display::ids() {
  MarkerArray array;
  if (!ids_.chooser) return array;
  ids_.chooser->placeVehicle(vehicle_());
  const MapPart part = ids_.chooser->part();
  array = idMarkers(part, params_.map_frame);
  append(legendMarkers(part, params_.map_frame), &array);
  return array;
}

void Display::drawMap() {
  if (!scene_.chooser || scene_.publisher.getNumSubscribers() == 0) return;
  scene_.chooser->placeVehicle(vehicle_());
  if (scene_.chooser->hasMoved()) sendPrepared(scene_.publisher, wholeScene());
}

void Display::drawIds() {
  if (!ids_.chooser || ids_.publisher.getNumSubscribers() == 0) return;
  ids_.chooser->placeVehicle(vehicle_());
  MarkerArray array;
  if (ids_.chooser->hasMoved()) {  // there may be fewer than before
    array.markers.emplace_back();
    array.markers.back().header.frame_id = params_.map_frame;
    array.markers.back().action = Marker::DELETEALL;
  }
  append(ids(), &array);
  sendPrepared(ids_.publisher, array);
}

void Display::lookAt(const geometry_msgs::PointStamped& place) {
  const std::string frame = frameId(place.header.frame_id);
  const Point2d point(place.point.x, place.point.y);
  if ((!frame.empty() && frame != params_.map_frame) || !isPlausible(point)) return;
  for (View* view : {&scene_, &ids_}) {
    if (view->chooser) view->chooser->lookAt(point);
  }
}

void Display::show(CommandScene scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_ = std::move(scene);
  refused_.reset();
  has_news_ = true;
}

void Display::showRefused(CommandScene scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  refused_ = std::move(scene);
  has_news_ = true;
}

void Display::drawNewest() {
  std::optional<CommandScene> sent, refused;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sent.swap(sent_);
    refused.swap(refused_);
    has_news_ = false;
  }
  for (const auto& scene : {sent, refused}) {
    if (!scene) continue;
    command_ = commandMarkers(*scene, map_.get(), params_.vehicle, params_.map_frame);
    sendPrepared(scene_.publisher, command_);
  }
}

}  // namespace external_command
