// SPDX-License-Identifier: Apache-2.0
#include "map_archive.h"

#include <algorithm>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

BOOST_IS_BITWISE_SERIALIZABLE(external_command::BoundaryTypeChange)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::BrokenLink)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::HeightSample)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::LaneOverlap)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::LanePiece)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::WidthSample)

namespace external_command {

namespace {

constexpr std::size_t kLanesPerBlock = 1000;
constexpr std::size_t kLeastLaneSize = 200;  // as transferLane() writes it, with two points [bytes]

void transferLine(ArchiveWriter* archive, const Polyline& line) { archive->values(line.points()); }

void transferLine(ArchiveReader* archive, Polyline& line) {
  std::vector<Point2d> points;
  archive->values(points);
  line = Polyline(std::move(points));
}

template <class Archive, class Boundary>
void transferBoundary(Archive* archive, Boundary& boundary) {
  archive->values(boundary.points);
  archive->values(boundary.types);
  archive->value(boundary.is_virtual);
}

/// Every field of a lane, both ways.
template <class Archive, class AnyLane>
void transferLane(Archive* archive, AnyLane& lane) {
  archive->values(lane.id);
  transferLine(archive, lane.center);
  transferBoundary(archive, lane.left);
  transferBoundary(archive, lane.right);
  archive->values(lane.left_widths);
  archive->values(lane.right_widths);
  archive->value(lane.speed_limit);
  archive->value(lane.type);
  archive->value(lane.turn);
  archive->value(lane.direction);
  archive->values(lane.predecessors);
  archive->values(lane.successors);
  archive->values(lane.left_forward);
  archive->values(lane.right_forward);
  archive->values(lane.left_reverse);
  archive->values(lane.right_reverse);
  archive->values(lane.road_id);
  archive->values(lane.junction_id);
  archive->values(lane.heights);
  archive->values(lane.entries);
  archive->value(lane.reverse);
  archive->value(lane.is_reversed);
}

std::string textFrom(ArchiveReader* archive) {
  std::string text;
  archive->values(text);
  return text;
}

template <class T>
std::vector<T> valuesFrom(ArchiveReader* archive) {
  std::vector<T> items;
  archive->values(items);
  return items;
}

template <class T>
T valueFrom(ArchiveReader* archive) {
  T value{};
  archive->value(value);
  return value;
}

Polygon polygonFrom(ArchiveReader* archive, const char* kind, const std::string& id) {
  return Polygon(valuesFrom<Point2d>(archive), text(kind, " ", id));
}

/// @param write  writes one of the items.
template <class Items, class Write>
void writeEach(ArchiveWriter* archive, const Items& items, const Write& write) {
  archive->value(std::uint64_t{items.size()});
  for (const auto& item : items) write(item);
}

/// @param read  reads one item, and keeps it.
template <class Read>
void readEach(ArchiveReader* archive, const Read& read) {
  for (std::size_t left = archive->count(sizeof(std::uint64_t)); left > 0; --left) read();
}

void writeObjects(const MapContent& map, ArchiveWriter* archive) {
  writeEach(archive, map.junctions, [&](const Junction& junction) {
    archive->values(junction.id);
    archive->values(junction.polygon.points());
  });
  writeEach(archive, map.parking_spaces, [&](const ParkingSpace& space) {
    archive->values(space.id);
    archive->values(space.polygon.points());
    archive->value(space.heading);
    archive->values(space.lanes);
  });
  writeEach(archive, map.areas, [&](const Area& area) {
    archive->values(area.id);
    archive->values(area.name);
    archive->values(area.polygon.points());
    archive->values(area.lanes);
  });
}

void readObjects(ArchiveReader* in, MapContent* map) {
  // Of several values in braces the first is read first.
  readEach(in, [&] {
    const std::string id = textFrom(in);
    map->junctions.push_back({id, polygonFrom(in, "junction", id)});
  });
  readEach(in, [&] {
    const std::string id = textFrom(in);
    map->parking_spaces.push_back(
        {id, polygonFrom(in, "parking space", id), valueFrom<double>(in), valuesFrom<LaneOverlap>(in)});
  });
  readEach(in, [&] {
    const std::string id = textFrom(in);
    map->areas.push_back({id, textFrom(in), polygonFrom(in, "area", id), valuesFrom<LaneOverlap>(in)});
  });
}

void writeRest(const MapContent& map, ArchiveWriter* archive) {
  archive->values(map.version);
  archive->values(map.projection);
  archive->value(map.origin);
  archive->value(map.box);
  archive->value(map.file_digest);
  archive->values(map.broken_links);
  writeEach(archive, map.warnings, [&](const MapWarning& warning) {
    archive->values(warning.what);
    archive->value(std::uint64_t{warning.count});
  });
  writeEach(archive, map.unusable_parking_spaces, [&](const auto& space) {
    archive->values(space.first);
    archive->values(space.second);
  });
  writeEach(archive, map.lanes_of_road, [&](const auto& road) {
    archive->values(road.first);
    archive->values(road.second);
  });
}

void readRest(ArchiveReader* in, MapContent* map) {
  in->values(map->version);
  in->values(map->projection);
  in->value(map->origin);
  in->value(map->box);
  in->value(map->file_digest);
  in->values(map->broken_links);
  readEach(in, [&] {
    MapWarning warning{textFrom(in)};
    warning.count = static_cast<std::size_t>(valueFrom<std::uint64_t>(in));
    map->warnings.push_back(std::move(warning));
  });
  readEach(in, [&] {
    std::string id = textFrom(in);
    map->unusable_parking_spaces[std::move(id)] = textFrom(in);
  });
  readEach(in, [&] {
    std::string id = textFrom(in);
    map->lanes_of_road[std::move(id)] = valuesFrom<LaneIndex>(in);
  });
}

template <class Objects, class Table>
void fillTable(const Objects& objects, Table* table) {
  table->reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    table->emplace(objects[i].id, static_cast<typename Table::mapped_type>(i));
  }
}

}  // namespace

void writeMapContent(const MapContent& map, BlockWriter* out) {
  out->block([&](ArchiveWriter& archive) { archive.value(std::uint64_t{map.lanes.size()}); });
  for (std::size_t begin = 0; begin < map.lanes.size(); begin += kLanesPerBlock) {
    const std::size_t end = std::min(begin + kLanesPerBlock, map.lanes.size());
    out->block([&](ArchiveWriter& archive) {
      for (std::size_t i = begin; i < end; ++i) transferLane(&archive, map.lanes[i]);
    });
  }
  out->block([&](ArchiveWriter& archive) { writeObjects(map, &archive); });
  out->block([&](ArchiveWriter& archive) { writeRest(map, &archive); });
  map.tree.forEachArray([&](const auto& array) { out->array(array); });
}

void readMapContentLater(BlockReader* in, MapContent* map) {
  std::size_t count = 0;
  in->block([&](ArchiveReader& archive) { count = static_cast<std::size_t>(valueFrom<std::uint64_t>(&archive)); });
  if (count > in->bytesLeft() / kLeastLaneSize) {
    throw InternalError(text("a kept map says that it has ", count, " lanes, more than it has room for"));
  }
  map->lanes.resize(count);
  for (std::size_t begin = 0; begin < count; begin += kLanesPerBlock) {
    const std::size_t end = std::min(begin + kLanesPerBlock, count);
    in->blockLater([=](ArchiveReader& archive) {
      for (std::size_t i = begin; i < end; ++i) transferLane(&archive, map->lanes[i]);
    });
  }
  in->blockLater([=](ArchiveReader& archive) { readObjects(&archive, map); });
  in->blockLater([=](ArchiveReader& archive) { readRest(&archive, map); });
  map->tree.forEachArray([&](auto& array) { in->arrayLater(&array); });
}

void fillTables(MapContent* map) {
  fillTable(map->lanes, &map->lane_by_id);  // the reversed ones come behind, and have an id that is there already
  fillTable(map->parking_spaces, &map->parking_space_by_id);
  fillTable(map->areas, &map->area_by_id);
}

std::string mapArchiveLayout() {
  return text(sizeof(BoundaryTypeChange), " ", sizeof(BrokenLink), " ", sizeof(HeightSample), " ", sizeof(LaneOverlap),
              " ", sizeof(LanePiece), " ", sizeof(WidthSample));
}

}  // namespace external_command
