// SPDX-License-Identifier: Apache-2.0
#include "distance_limits.h"

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kFarthest = 1e6;  // [m]

std::string warningKey(const std::string& name) { return name + "_distance_warning"; }
std::string refusalKey(const std::string& name) { return "max_" + name + "_distance"; }

}  // namespace

void DistanceLimits::read(const ParameterReader& reader, const std::string& name) {
  reader.readWithin(warningKey(name), 0.0, kFarthest, &warning);
  reader.readWithin(refusalKey(name), 0.0, kFarthest, &refusal);
}

void DistanceLimits::check(const std::string& what, const std::string& name, const Point2d& place,
                           const Point2d& vehicle, std::vector<std::string>* warnings) const {
  const double distance = (place - vehicle).norm();
  const std::string where =
      text(what, " ", at(place), ", ", metres(distance), " from the vehicle at ", at(vehicle), "; ");
  if (refusal > 0.0 && distance > refusal) {
    throw InvalidRequest(text(where, "the limit is ", metres(refusal), " (~", refusalKey(name), ")"));
  }
  if (distance <= warning) return;
  warnings->push_back(text(where, "is that meant? (more than ", metres(warning), ", ~", warningKey(name), "; ~",
                           refusalKey(name), " refuses it)"));
}

}  // namespace external_command
