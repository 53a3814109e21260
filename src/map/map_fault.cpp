// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/map_fault.h"

namespace external_command {

namespace {

constexpr FaultSeverity kWarning = FaultSeverity::kWarning;
constexpr FaultSeverity kError = FaultSeverity::kError;

}  // namespace

const std::vector<MapFaultKind>& mapFaultKinds() {
  static const std::vector<MapFaultKind> kinds = {
      {MapFault::kLaneUnusable, kError, "lane_unusable", "lanes dropped that cannot be used",
       "give the lane an id and a centre line of two points or more"},
      {MapFault::kLaneIdRepeated, kError, "lane_id_repeated", "lanes dropped whose id an earlier lane has",
       "give one of them another id"},
      {MapFault::kLaneTypeUnknown, kWarning, "lane_type_unknown",
       "lanes of a type that is not known; nothing drives on them", "make it CITY_DRIVING if vehicles drive there"},
      {MapFault::kLaneTypeMissing, kWarning, "lane_type_missing", "lanes without a type, taken as driving lanes",
       "state the type"},
      {MapFault::kLaneWithoutLength, kWarning, "lane_without_length", "lanes of no length, which keep their links",
       "link the lanes before and behind it with each other"},
      {MapFault::kLaneLengthWrong, kWarning, "lane_length_wrong",
       "lanes whose length is missing or wrong; that of the centre line is used",
       "state the length of the centre line; overlaps may be stated by the wrong one"},
      {MapFault::kBoundaryUnusable, kError, "boundary_unusable",
       "lane boundaries dropped that have a coordinate out of range", "put the coordinate right"},
      {MapFault::kWidthSampleUnusable, kWarning, "width_sample_unusable",
       "width samples dropped that are negative or not finite", "put the sample right"},
      {MapFault::kSpeedLimitUnusable, kWarning, "speed_limit_unusable",
       "speed limits dropped that are negative or not finite", "state the limit in m/s"},
      {MapFault::kReferenceDangling, kError, "reference_dangling", "references to lanes that do not exist",
       "put the id right, or leave the reference out"},
      {MapFault::kLinkBackwardsOnly, kWarning, "link_backwards_only",
       "lanes linked backwards only; what leads on was taken from the predecessors", "state the successors too"},
      {MapFault::kLaneOfTwoRoads, kWarning, "lane_of_two_roads",
       "lanes named by more than one road, of which the first counts", "leave the lane to one road"},
      {MapFault::kNeighbourWrongSide, kWarning, "neighbour_wrong_side",
       "neighbours on the other side than the map states; they count where they lie", "swap left and right"},
      {MapFault::kNeighbourOncoming, kError, "neighbour_oncoming",
       "forward neighbours that run the other way; no lane changes to them", "make it a reverse neighbour"},
      {MapFault::kNeighbourFar, kError, "neighbour_far", "forward neighbours too far off for a lane change",
       "put the id right, or leave the neighbour out"},
      {MapFault::kNeighboursMissing, kWarning, "neighbours_missing",
       "driving lanes with another beside them, but no lane of the map has a neighbour: no lane changes",
       "state the forward neighbours"},
      {MapFault::kLinkBroken, kError, "link_broken",
       "links that are not driven, as their ends lie too far apart (map/max_link_gap)",
       "move the ends together, or leave the link out"},
      {MapFault::kLinkGap, kWarning, "link_gap", "links whose ends do not meet", "move the ends together"},
      {MapFault::kLinkOverlap, kWarning, "link_overlap", "linked lanes that overlap",
       "let the one begin where the other ends"},
      {MapFault::kLinkKink, kWarning, "link_kink", "links at which the heading jumps",
       "draw the turn, or leave the link out"},
      {MapFault::kFold, kWarning, "fold", "places at which a centre line folds back on itself",
       "leave out the points that go back"},
      {MapFault::kPolygonUnusable, kError, "polygon_unusable", "map objects dropped whose polygon cannot be used",
       "draw a simple polygon of three corners or more"},
      {MapFault::kCornersCrossed, kWarning, "corners_crossed",
       "parking spaces whose corners are in crossed order, which was put right", "state the corners in order"},
      {MapFault::kObjectIdRepeated, kError, "object_id_repeated",
       "parking spaces and areas dropped whose id is empty or an earlier one's", "give it an id of its own"},
      {MapFault::kOverlapDangling, kWarning, "overlap_dangling",
       "references to overlaps, or of overlaps to lanes, that do not exist",
       "put the id right, or leave the reference out"},
      {MapFault::kOverlapRangeUnusable, kWarning, "overlap_range_unusable",
       "overlaps without a usable range on their lane, all of which is taken", "state start_s and end_s"},
      {MapFault::kSpaceWithoutOverlap, kWarning, "space_without_overlap",
       "parking spaces that no lane overlaps; the lanes to park from are found by distance",
       "state an overlap with each lane to park from"},
      {MapFault::kSpaceHeadingMissing, kWarning, "space_heading_missing",
       "parking spaces without a heading, which was derived from their shape",
       "state the heading of who parks nose in"},
      {MapFault::kSpaceHeadingInDegrees, kWarning, "space_heading_in_degrees",
       "parking spaces whose heading is in degrees, and was taken as such", "state the heading in radians"},
      {MapFault::kSpaceHeadingAcross, kWarning, "space_heading_across",
       "parking spaces whose stated heading lies across them; it was derived from their shape",
       "state the heading of who parks nose in"},
  };
  return kinds;
}

const MapFaultKind& kindOf(MapFault fault) { return mapFaultKinds()[static_cast<std::size_t>(fault)]; }

}  // namespace external_command
