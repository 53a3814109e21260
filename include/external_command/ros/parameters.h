// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "external_command/core/drive_limits.h"
#include "external_command/core/error.h"
#include "external_command/core/path_bounds.h"
#include "external_command/core/text.h"
#include "external_command/core/vehicle.h"
#include "external_command/map/map_reader.h"
#include "external_command/ros/request_limits.h"
#include "external_command/routing/lane_way_tool.h"
#include "external_command/routing/reference_path.h"

namespace external_command {

/// Reads parameters of one namespace. A missing one leaves the default; one of the wrong type stops the start, and so
/// does a ROS master that is gone: what it no longer tells is not what nobody set.
class ParameterReader {
 public:
  explicit ParameterReader(const ros::NodeHandle& nh) : nh_(nh) {}

  /// @throws InvalidParameter  the value has another type; the text names the parameter and what was found.
  void read(const std::string& key, bool* value) const;
  void read(const std::string& key, int* value) const;
  void read(const std::string& key, double* value) const;  ///< takes whole numbers too
  void read(const std::string& key, std::string* value) const;
  void read(const std::string& key, std::vector<std::string>* value) const;

  /// The same, and `*value` must lie in [low, high].
  /// @throws InvalidParameter  also where it does not; the text names the range.
  void readWithin(const std::string& key, double low, double high, double* value) const;
  void readWithin(const std::string& key, int low, int high, int* value) const;
  void readSize(const std::string& key, int low, int high, std::size_t* value) const;

  /// Names of topics and services, relative ones as they are. An empty one means none, and is taken only where
  /// `*value` is empty before.
  /// @throws InvalidParameter  also for what is no name of ROS.
  void readName(const std::string& key, std::string* value) const;
  void readNames(const std::string& key, std::vector<std::string>* value) const;

  /// The name of a file or folder, `~` at its beginning taken for the home folder.
  void readPath(const std::string& key, std::string* value) const;

  bool has(const std::string& key) const { return nh_.hasParam(key); }
  ParameterReader within(const std::string& name) const { return ParameterReader(ros::NodeHandle(nh_, name)); }
  std::string nameOf(const std::string& key) const { return nh_.resolveName(key); }
  const std::string& name() const { return nh_.getNamespace(); }

  /// The raw value; false where there is none.
  /// @throws InternalError  the ROS master does not answer.
  bool raw(const std::string& key, XmlRpc::XmlRpcValue* value) const;

  /// Calls `params.validate()`.
  /// @throws InvalidParameter  what that throws, with the namespace in the text.
  template <class Params>
  void validate(const Params& params) const {
    try {
      params.validate();
    } catch (const InvalidParameter& error) {
      throw InvalidParameter(text("parameters in ", nh_.getNamespace(), ": ", error.what()));
    }
  }

 private:
  ros::NodeHandle nh_;
};

/// The keys of a vehicle's size that are not set. They have no default: who plans for another vehicle hits something.
std::vector<std::string> missingVehicleSizes(const ParameterReader& reader);

/// Readers of the plain structs; each validates what it read. That of the vehicle wants every size to be set.
VehicleParams readVehicleParams(const ParameterReader& reader);
MapParams readMapParams(const ParameterReader& reader);
RouterParams readRouterParams(const ParameterReader& reader);
LaneWayParams readLaneWayParams(const ParameterReader& reader);
ReferencePathParams readReferencePathParams(const ParameterReader& reader);
RequestLimits readRequestLimits(const ParameterReader& reader);
PathBounds readPathBounds(const ParameterReader& reader);

DriveLimits readDriveLimits(const ParameterReader& reader);

/// `map_origin`: "none" (default), "auto", or [x, y] in the map's coordinates [m].
MapOrigin readMapOrigin(const ParameterReader& reader);

}  // namespace external_command
