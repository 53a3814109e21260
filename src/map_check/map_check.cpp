// SPDX-License-Identifier: Apache-2.0
#include "map_check.h"

#include <algorithm>
#include <iterator>

#include "checks.h"

namespace external_command {

namespace {

/// True where lanes are named, and nothing drives on any of them.
bool concernsNoDriving(const HdMap& map, const MapFinding& finding) {
  bool names_lane = false;
  for (const std::string& id : finding.ids) {
    const auto lane = map.findLane(id);
    if (lane && map.lane(*lane).isDrivable()) return false;
    names_lane = names_lane || lane;
  }
  return names_lane;
}

bool comesFirst(const MapFinding& a, const MapFinding& b) {
  if (a.severity != b.severity) return a.severity == FaultSeverity::kError;
  return a.fault < b.fault;
}

}  // namespace

MapReport checkMap(const MapData& data, const MapCheckParams& params) {
  MapReport report;
  MapParams map_params;
  map_params.max_link_gap = params.max_link_gap;
  map_params.keep_findings = true;
  report.map = std::make_shared<const HdMap>(data, Point2d::Zero(), map_params);
  MapFaults faults(true);
  const MapUnderCheck check{*report.map, data, params.vehicle, &faults, &report.notes};
  checkLaneShapes(check);
  checkReferences(check);
  checkJoints(check);
  checkReach(check);
  checkOverlaps(check);
  checkSpaces(check);
  report.findings = report.map->findings();
  std::vector<MapFinding> found = faults.takeFindings();
  report.findings.insert(report.findings.end(), std::make_move_iterator(found.begin()),
                         std::make_move_iterator(found.end()));
  for (MapFinding& finding : report.findings) {
    if (concernsNoDriving(*report.map, finding)) finding.severity = FaultSeverity::kWarning;
  }
  std::stable_sort(report.findings.begin(), report.findings.end(), comesFirst);
  return report;
}

}  // namespace external_command
