// SPDX-License-Identifier: Apache-2.0
#include "command_draft.h"

#include "gateway_link.h"

namespace external_command {

namespace {

std::vector<Pose> asPoses(const std::vector<geometry_msgs::Point>& points) {
  std::vector<Pose> poses;
  for (const geometry_msgs::Point& point : points) {
    poses.emplace_back();
    poses.back().x = point.x;
    poses.back().y = point.y;
  }
  return poses;
}

template <class Command>
Command begin(const CommandDraft& draft, bool is_dry_run) {
  Command command;
  command.dry_run = is_dry_run;
  command.target_speed = draft.target_speed;
  return command;
}

}  // namespace

bool CommandDraft::needsGoal() const {
  return kind == CommandKind::kLaneFollow || kind == CommandKind::kFreeSpace || kind == CommandKind::kPreciseParking;
}

bool CommandDraft::needsHeading() const {
  return kind == CommandKind::kFreeSpace || kind == CommandKind::kPreciseParking;
}

std::uint8_t CommandDraft::objectKind() const {
  if (kind == CommandKind::kValetParking) return MapObject::PARKING_SPACE;
  return kind == CommandKind::kZoneCover ? MapObject::AREA : 0;
}

bool CommandDraft::takesPoints() const {
  return kind == CommandKind::kLaneFollow || kind == CommandKind::kPreciseParking || kind == CommandKind::kPathFollow;
}

QString CommandDraft::missing() const {
  if (needsGoal() && !goal) return "Give the goal: drag it in the map with the tool Destination (D).";
  if (needsHeading() && !goal->has_heading) return "The goal needs a heading: drag it in the map.";
  if (objectKind() == MapObject::PARKING_SPACE && object_id.empty()) {
    return "Give the parking space: click on it with the tool Pick (K), or choose it.";
  }
  if (objectKind() == MapObject::AREA && object_id.empty()) {
    return "Give the area: click on it with the tool Pick (K), or choose it.";
  }
  if (kind == CommandKind::kPathFollow && points.size() < 2) {
    return "Give the path: click on at least 2 points with the tool Pick (K).";
  }
  return "";
}

void CommandDraft::send(bool is_dry_run, GatewayLink* gateway) const {
  switch (kind) {
    case CommandKind::kLaneFollow: {
      auto command = begin<LaneFollowCommand>(*this, is_dry_run);
      command.end_pose = *goal;
      command.way_point = asPoses(points);
      return gateway->send(command);
    }
    case CommandKind::kFreeSpace: {
      auto command = begin<FreeSpaceCommand>(*this, is_dry_run);
      command.parking_spot_pose = *goal;
      return gateway->send(command);
    }
    case CommandKind::kPreciseParking: {
      auto command = begin<PreciseParkingCommand>(*this, is_dry_run);
      command.parking_spot_pose = *goal;
      command.parking_inwards = is_nose_in;
      command.way_point = asPoses(points);
      return gateway->send(command);
    }
    case CommandKind::kValetParking: {
      auto command = begin<ValetParkingCommand>(*this, is_dry_run);
      command.parking_spot_id = object_id;
      return gateway->send(command);
    }
    case CommandKind::kZoneCover: {
      auto command = begin<ZoneCoverCommand>(*this, is_dry_run);
      command.zone_cover_area_id = object_id;
      command.swath_width = swath_width;
      command.resume = is_resumed;
      return gateway->send(command);
    }
    case CommandKind::kPathFollow: {
      auto command = begin<PathFollowCommand>(*this, is_dry_run);
      command.way_point = points;
      return gateway->send(command);
    }
  }
}

}  // namespace external_command
