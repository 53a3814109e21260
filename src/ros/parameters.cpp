// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/parameters.h"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/time.h>

#include <algorithm>
#include <cstdlib>

#include "external_command/core/nearest_words.h"
#include "external_command/ros/parameter_check.h"

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;

constexpr const char* kVehicleSizes[] = {"wheelbase", "width", "front_overhang", "rear_overhang", "min_turning_radius"};
constexpr int kMasterTries = 3;
constexpr double kMasterPause = 0.2;  // [s]

const char* nameOfType(XmlRpcValue::Type type) {
  switch (type) {
    case XmlRpcValue::TypeBoolean:
      return "a boolean";
    case XmlRpcValue::TypeInt:
      return "a whole number";
    case XmlRpcValue::TypeDouble:
      return "a number";
    case XmlRpcValue::TypeString:
      return "a string";
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeStruct:
      return "a dictionary";
    default:
      return "something else";
  }
}

[[noreturn]] void refuseType(const std::string& name, const std::string& expected, XmlRpcValue::Type found) {
  throw InvalidParameter(text("parameter ", name, " must be ", expected, ", it is ", nameOfType(found)));
}

double toDouble(XmlRpcValue& value, const std::string& name) {
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<int>(value);
  if (value.getType() != XmlRpcValue::TypeDouble) refuseType(name, "a number", value.getType());
  return static_cast<double>(value);
}

Point2d toPoint(XmlRpcValue& value, const std::string& name) {
  if (value.getType() != XmlRpcValue::TypeArray || value.size() != 2) {
    throw InvalidParameter(text("parameter ", name, " must be a point [x, y]"));
  }
  return {toDouble(value[0], name), toDouble(value[1], name)};
}

template <class Value>
void readAs(const ParameterReader& reader, const std::string& key, XmlRpcValue::Type type, Value* value) {
  XmlRpcValue found;
  if (!reader.raw(key, &found)) return;
  if (found.getType() != type) refuseType(reader.nameOf(key), nameOfType(type), found.getType());
  *value = static_cast<Value&>(found);
}

void requireName(const std::string& parameter, const std::string& name) {
  std::string reason = name.empty() ? "it is empty" : "";
  if (!name.empty() && name[0] == '~') reason = "private names (~) have no meaning here";
  if (reason.empty() && ros::names::validate(name, reason)) return;
  throw InvalidParameter(text("parameter ", parameter, " is '", name, "', no name of a topic or service: ", reason));
}

template <class Number>
void requireRange(const std::string& name, Number low, Number high, Number value) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidParameter(text("parameter ", name, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

/// What is set beside the sizes of a vehicle, and may be one that is misspelt.
std::vector<std::string> otherVehicleKeys(const ParameterReader& reader) {
  std::vector<std::string> keys;
  XmlRpcValue tree;
  if (!ros::param::get(reader.name(), tree) || tree.getType() != XmlRpcValue::TypeStruct) return keys;
  for (const auto& item : tree) keys.push_back(item.first);
  for (const char* size : kVehicleSizes) keys.erase(std::remove(keys.begin(), keys.end(), size), keys.end());
  return keys;
}

void requireVehicleSizes(const ParameterReader& reader) {
  std::string names;
  for (const std::string& key : missingVehicleSizes(reader)) {
    NearestWords near(key);
    for (const std::string& other : otherVehicleKeys(reader)) near.offer(other);
    names += (names.empty() ? "" : ", ") + reader.nameOf(key);
    if (!near.words().empty()) names += text(" (", near.words().front(), " is set; is that what it is meant to be?)");
  }
  if (names.empty()) return;
  throw InvalidParameter(text("parameters not set: ", names, " [m]; a vehicle's size has no default. ",
                              "external_command_process.launch loads them from its vehicle:=FILE, a copy of ",
                              "config/vehicle.yaml"));
}

}  // namespace

bool ParameterReader::raw(const std::string& key, XmlRpcValue* value) const {
  noteKnownParameter(nameOf(key));
  for (int tries = 0; tries < kMasterTries && !ros::isShuttingDown(); ++tries) {
    if (nh_.getParam(key, *value)) return true;
    if (ros::master::check()) return false;
    ros::WallDuration(kMasterPause).sleep();  // a signal breaks a call off too, and roscpp needs a moment to act on it
  }
  throw InternalError(text("parameter ", nameOf(key), " cannot be read: the ROS master at ", ros::master::getURI(),
                           " does not answer; start it, and then this again"));
}

void ParameterReader::read(const std::string& key, bool* value) const {
  readAs(*this, key, XmlRpcValue::TypeBoolean, value);
}

void ParameterReader::read(const std::string& key, int* value) const {
  readAs(*this, key, XmlRpcValue::TypeInt, value);
}

void ParameterReader::read(const std::string& key, double* value) const {
  XmlRpcValue found;
  if (raw(key, &found)) *value = toDouble(found, nameOf(key));
}

void ParameterReader::read(const std::string& key, std::string* value) const {
  readAs(*this, key, XmlRpcValue::TypeString, value);
}

void ParameterReader::read(const std::string& key, std::vector<std::string>* value) const {
  XmlRpcValue found;
  if (!raw(key, &found)) return;
  if (found.getType() != XmlRpcValue::TypeArray) refuseType(nameOf(key), "a list of strings", found.getType());
  std::vector<std::string> items;
  for (int i = 0; i < found.size(); ++i) {
    if (found[i].getType() != XmlRpcValue::TypeString) {
      refuseType(text(nameOf(key), "[", i, "]"), "a string", found[i].getType());
    }
    items.push_back(static_cast<std::string>(found[i]));
  }
  *value = items;
}

void ParameterReader::readWithin(const std::string& key, double low, double high, double* value) const {
  read(key, value);
  requireRange(nameOf(key), low, high, *value);
}

void ParameterReader::readWithin(const std::string& key, int low, int high, int* value) const {
  read(key, value);
  requireRange(nameOf(key), low, high, *value);
}

void ParameterReader::readSize(const std::string& key, int low, int high, std::size_t* value) const {
  int number = static_cast<int>(*value);
  readWithin(key, low, high, &number);
  *value = static_cast<std::size_t>(number);
}

void ParameterReader::readName(const std::string& key, std::string* value) const {
  const bool may_be_empty = value->empty();
  read(key, value);
  if (!value->empty() || !may_be_empty) requireName(nameOf(key), *value);
}

void ParameterReader::readNames(const std::string& key, std::vector<std::string>* value) const {
  read(key, value);
  for (std::size_t i = 0; i < value->size(); ++i) requireName(text(nameOf(key), "[", i, "]"), (*value)[i]);
}

void ParameterReader::readPath(const std::string& key, std::string* value) const {
  read(key, value);
  const char* home = std::getenv("HOME");
  const bool is_below_home = *value == "~" || value->compare(0, 2, "~/") == 0;
  if (is_below_home && home != nullptr) *value = home + value->substr(1);
}

std::vector<std::string> missingVehicleSizes(const ParameterReader& reader) {
  std::vector<std::string> missing;
  for (const char* key : kVehicleSizes) {
    XmlRpcValue value;
    if (!reader.raw(key, &value)) missing.emplace_back(key);
  }
  return missing;
}

VehicleParams readVehicleParams(const ParameterReader& reader) {
  requireVehicleSizes(reader);
  VehicleParams vehicle;
  reader.read("wheelbase", &vehicle.wheelbase);
  reader.read("width", &vehicle.width);
  reader.read("front_overhang", &vehicle.front_overhang);
  reader.read("rear_overhang", &vehicle.rear_overhang);
  reader.read("min_turning_radius", &vehicle.min_turning_radius);
  reader.read("max_speed", &vehicle.max_speed);
  reader.read("max_reverse_speed", &vehicle.max_reverse_speed);
  reader.read("max_acceleration", &vehicle.max_acceleration);
  reader.read("max_deceleration", &vehicle.max_deceleration);
  reader.read("max_lateral_acceleration", &vehicle.max_lateral_acceleration);
  reader.read("max_steering_rate", &vehicle.max_steering_rate);
  reader.validate(vehicle);
  return vehicle;
}

MapParams readMapParams(const ParameterReader& reader) {
  MapParams params;
  reader.read("max_link_gap", &params.max_link_gap);
  reader.read("max_segment_length", &params.max_segment_length);
  reader.validate(params);
  return params;
}

RouterParams readRouterParams(const ParameterReader& reader) {
  RouterParams params;
  reader.read("min_lane_change_length", &params.min_lane_change_length);
  reader.readWithin("lane_change_price", 0.0, 1e6, &params.lane_change_price);
  reader.readWithin("tight_lane_change_price", 0.0, 1e6, &params.tight_lane_change_price);
  reader.read("stopping_error", &params.stopping_error);
  reader.validate(params);
  return params;
}

LaneWayParams readLaneWayParams(const ParameterReader& reader) {
  LaneWayParams params;
  reader.read("snap_distance", &params.snap_distance);
  reader.read("snap_heading", &params.snap_heading);
  reader.read("max_goal_distance", &params.max_goal_distance);
  reader.read("lane_keeping_error", &params.lane_keeping_error);
  reader.read("heading_error", &params.heading_error);
  reader.read("height_error", &params.height_error);
  reader.read("off_lane_price", &params.off_lane_price);
  reader.read("off_heading_price", &params.off_heading_price);
  reader.read("off_lane_distance", &params.off_lane_distance);
  reader.read("off_lane_heading", &params.off_lane_heading);
  reader.read("park_and_go_radius", &params.park_and_go_radius);
  reader.read("area_access_distance", &params.area_access_distance);
  reader.read("parking_lane_radius", &params.parking_lane_radius);
  reader.validate(params);
  return params;
}

ReferencePathParams readReferencePathParams(const ParameterReader& reader) {
  ReferencePathParams params;
  reader.read("path_spacing", &params.spacing);
  reader.read("lane_change_length", &params.lane_change_length);
  reader.read("default_speed_limit", &params.default_speed_limit);
  reader.read("refuse_undrivable", &params.refuse_undrivable);
  reader.validate(params);
  return params;
}

RequestLimits readRequestLimits(const ParameterReader& reader) {
  RequestLimits limits;
  reader.readSize("max_bytes", 1000, 1000000000, &limits.max_bytes);
  reader.readSize("max_message_bytes", 1000, 1000000000, &limits.max_message_bytes);
  reader.readSize("max_points", 1, 10000000, &limits.max_points);
  reader.readSize("max_text", 10, 1000000, &limits.max_text);
  reader.readSize("max_way_points", 1, 100000, &limits.max_way_points);
  reader.readSize("max_black_list", 1, 1000000, &limits.max_black_list);
  reader.readSize("max_polygons", 1, 100000, &limits.max_polygons);
  reader.readSize("max_polygon_points", 3, 1000000, &limits.max_polygon_points);
  return limits;
}

PathBounds readPathBounds(const ParameterReader& reader) {
  PathBounds bounds;
  reader.read("max_path_length", &bounds.max_length);
  reader.read("max_path_start_distance", &bounds.max_start_distance);
  reader.readSize("max_path_points", 2, 10000000, &bounds.max_points);
  reader.validate(bounds);
  return bounds;
}

DriveLimits readDriveLimits(const ParameterReader& reader) {
  DriveLimits limits;
  reader.read("max_goal_distance", &limits.max_goal_distance);
  reader.read("max_speed", &limits.max_speed);
  reader.validate(limits);
  XmlRpcValue fence;
  if (!reader.raw("geofence", &fence)) return limits;
  const std::string name = reader.nameOf("geofence");
  if (fence.getType() != XmlRpcValue::TypeArray) refuseType(name, "a list of points [x, y]", fence.getType());
  if (fence.size() == 0) return limits;
  std::vector<Point2d> points;
  for (int i = 0; i < fence.size(); ++i) points.push_back(toPoint(fence[i], text(name, "[", i, "]")));
  try {
    limits.geofence.emplace(points, name);
  } catch (const InvalidRequest& error) {
    throw InvalidParameter(text("parameter ", error.what()));
  }
  return limits;
}

MapOrigin readMapOrigin(const ParameterReader& reader) {
  const std::string key = "map_origin";
  MapOrigin origin;
  XmlRpcValue value;
  if (!reader.raw(key, &value)) return origin;
  if (value.getType() == XmlRpcValue::TypeString) {
    const auto word = static_cast<std::string>(value);
    if (word.empty() || word == "none") return origin;
    if (word == "auto") return {MapOrigin::Kind::kAuto, Point2d::Zero()};
    throw InvalidParameter(text("parameter ", reader.nameOf(key), " is '", word, "'; give none, auto, or [x, y]"));
  }
  if (value.getType() != XmlRpcValue::TypeArray || value.size() < 2 || value.size() > 3) {
    throw InvalidParameter(text("parameter ", reader.nameOf(key), " must be none, auto, or [x, y]"));
  }
  origin.kind = MapOrigin::Kind::kGiven;
  origin.point = {toDouble(value[0], reader.nameOf(key)), toDouble(value[1], reader.nameOf(key))};
  if (!origin.point.allFinite()) throw InvalidParameter(text("parameter ", reader.nameOf(key), " is not finite"));
  return origin;
}

}  // namespace external_command
