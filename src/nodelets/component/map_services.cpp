// SPDX-License-Identifier: Apache-2.0
#include "map_services.h"

#include <algorithm>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/conversions.h"
#include "external_command/ros/status.h"
#include "serve.h"

namespace external_command {

namespace {

constexpr std::uint32_t kUsualCount = 100, kMostObjects = 10000;

/// To a request that is refused; the exception that tells why is being handled.
FindMapObjects::Response refusal() {
  const CommandStatus status = statusFrom(std::current_exception(), 0);
  FindMapObjects::Response response;
  response.error_code = status.error_code;
  response.error_message = status.message;
  return response;
}

std::optional<MapObjectKind> kindOf(std::uint8_t kind) {
  switch (kind) {
    case 0:
      return std::nullopt;
    case MapObject::LANE:
      return MapObjectKind::kLane;
    case MapObject::ROAD:
      return MapObjectKind::kRoad;
    case MapObject::PARKING_SPACE:
      return MapObjectKind::kParkingSpace;
    case MapObject::AREA:
      return MapObjectKind::kArea;
    default:
      throw InvalidRequest(text("kind is ", static_cast<int>(kind),
                                "; it must be 0 for any, LANE (1), ROAD (2), PARKING_SPACE (3) or AREA (4)"));
  }
}

std::uint8_t toMsg(MapObjectKind kind) {
  switch (kind) {
    case MapObjectKind::kLane:
      return MapObject::LANE;
    case MapObjectKind::kRoad:
      return MapObject::ROAD;
    case MapObjectKind::kParkingSpace:
      return MapObject::PARKING_SPACE;
    case MapObjectKind::kArea:
      break;
  }
  return MapObject::AREA;
}

}  // namespace

MapServices::MapServices(const ros::NodeHandle& nh, const ParameterReader& parameters,
                         std::shared_ptr<ProcessContext> context)
    : context_(std::move(context)) {
  std::string name = "external_command/map_objects";
  parameters.readName("map_objects_service_name", &name);
  BoundedServiceCallbacks<FindMapObjects> callbacks;
  callbacks.answer = [this](const auto& request, const MessageSize& size, const ros::M_string&) {
    return find(request, size);
  };
  callbacks.refuse = [](const ros::SerializedMessage& /*request*/, const ros::M_string& /*header*/) {
    return refusal();
  };
  server_ = serveOn<FindMapObjects>(&executor_, nh, name, std::move(callbacks), context_->params().requests);
}

MapServices::~MapServices() { server_.shutdown(); }

FindMapObjects::Response MapServices::find(const FindMapObjects::Request& request, const MessageSize& size) const try {
  context_->params().requests.requireTexts(size, ros::message_traits::definition<FindMapObjects::Request>());
  const HdMap& map = context_->requireRouter().map();
  const FoundObjects found = findObjects(map, toQuery(request));
  FindMapObjects::Response response;
  for (const FoundObject& object : found.objects) response.objects.push_back(toMsg(map, object));
  response.total_count = static_cast<std::uint32_t>(found.total);
  return response;
} catch (...) {
  return refusal();
}

ObjectQuery toQuery(const FindMapObjects::Request& request) {
  ObjectQuery query;
  query.kind = kindOf(request.kind);
  query.id = request.id;
  if (request.is_near) query.near = Point2d(request.point.x, request.point.y);
  if (request.is_near && request.radius != 0.0) query.radius = request.radius;
  query.max_count = std::min(request.max_count == 0 ? kUsualCount : request.max_count, kMostObjects);
  return query;
}

MapObject toMsg(const HdMap& map, const FoundObject& object) {
  MapObject message;
  message.kind = toMsg(object.kind);
  message.id = object.id;
  message.pose.x = object.pose.x;
  message.pose.y = object.pose.y;
  message.pose.heading = object.pose.heading;
  message.pose.has_heading = object.has_heading;
  message.pose.has_z = object.height.has_value();
  message.pose.z = object.height.value_or(0.0);
  if (object.lane) message.pose.lane_id = map.lane(*object.lane).id;
  message.distance = object.distance;
  message.length = object.length;
  message.width = object.width;
  message.lane_ids = object.lane_ids;
  if (object.polygon == nullptr) return message;
  for (const Point2d& point : object.polygon->points()) message.outline.push_back(toPointMsg(point));
  return message;
}

}  // namespace external_command
