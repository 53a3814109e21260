// SPDX-License-Identifier: Apache-2.0
#include "map/map_files.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "external_command/core/error.h"
#include "external_command/map/map_reader.h"

namespace external_command {

namespace {

/// Writes a description of everything, digit by digit, which is then compared.
class Description {
 public:
  std::string of(const MapData& data) {
    out_ << std::hexfloat << data.version << '|' << data.projection << '\n';
    for (const LaneData& lane : data.lanes) add(lane);
    for (const RoadData& road : data.roads) {
      out_ << "road " << road.id << ' ' << road.junction;
      for (const RoadSectionData& section : road.sections) add(section.id, section.lanes);
    }
    for (const JunctionData& junction : data.junctions) add("junction " + junction.id, junction.polygon);
    for (const ParkingSpaceData& space : data.parking_spaces) {
      add("parking space " + space.id, space.polygon);
      add(space.has_heading ? "heading" : "no heading", space.overlaps);
      out_ << space.heading;
    }
    for (const AreaData& area : data.areas) {
      add("area " + area.id + ' ' + area.name, area.polygon);
      add("overlaps", area.overlaps);
    }
    for (const OverlapData& overlap : data.overlaps) {
      out_ << "\noverlap " << overlap.id;
      for (const auto& o : overlap.objects) out_ << ' ' << o.id << o.is_lane << o.start_s << ' ' << o.end_s;
    }
    return out_.str();
  }

 private:
  void add(const std::string& what, const std::vector<Point2d>& points) {
    out_ << '\n' << what;
    for (const Point2d& point : points) out_ << ' ' << point.x() << ' ' << point.y();
  }

  void add(const std::string& what, const std::vector<std::string>& ids) {
    out_ << '\n' << what;
    for (const std::string& id : ids) out_ << ' ' << id;
  }

  void add(const LaneBoundary& boundary) {
    add(boundary.is_virtual ? "virtual" : "real", boundary.points);
    for (const auto& change : boundary.types) out_ << ' ' << change.s << ':' << static_cast<int>(change.type);
  }

  void add(const LaneData& lane) {
    out_ << "\nlane " << lane.id << ' ' << lane.length << ' ' << lane.speed_limit << ' ' << lane.junction << ' '
         << static_cast<int>(lane.type) << static_cast<int>(lane.turn) << static_cast<int>(lane.direction);
    add("center", lane.center);
    add(lane.left);
    add(lane.right);
    for (const auto* widths : {&lane.left_widths, &lane.right_widths}) {
      out_ << "\nwidths";
      for (const WidthSample& sample : *widths) out_ << ' ' << sample.s << ':' << sample.width;
    }
    for (const auto* ids : {&lane.predecessors, &lane.successors, &lane.left_forward, &lane.right_forward,
                            &lane.left_reverse, &lane.right_reverse, &lane.overlaps}) {
      add("lanes", *ids);
    }
  }

  std::ostringstream out_;
};

}  // namespace

TemporaryFile::TemporaryFile(const std::string& bytes) : path_(::testing::TempDir() + "map_test_XXXXXX") {
  const int descriptor = ::mkstemp(&path_[0]);
  if (descriptor < 0) throw std::runtime_error("cannot make a file in " + ::testing::TempDir());
  ::close(descriptor);
  write(bytes);
}

TemporaryFile::~TemporaryFile() { ::unlink(path_.c_str()); }

void TemporaryFile::write(const std::string& bytes) const {
  std::ofstream out(path_, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string bytesOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

MapData dataOf(const std::string& bytes) { return readMapData(TemporaryFile(bytes).path()); }

std::vector<std::string> sharedMaps() {
  std::vector<std::string> found;
  for (const char* name : {"autonomoustuff/base_map.bin", "town01/base_map.bin", "town10hd/base_map.bin"}) {
    const std::string file = std::string(EC_SHARED_DIR) + "/data/maps/" + name;
    if (std::ifstream(file)) found.push_back(file);
  }
  return found;
}

std::string refusal(const std::string& bytes) {
  const TemporaryFile file(bytes);
  try {
    readMapData(file.path());
  } catch (const MapError& error) {
    return error.what();
  }
  return "";
}

::testing::AssertionResult sameData(const MapData& a, const MapData& b) {
  std::istringstream first(Description().of(a)), second(Description().of(b));
  std::string line, other;
  while (std::getline(first, line)) {
    if (!std::getline(second, other) || line != other) {
      return ::testing::AssertionFailure() << "\"" << line << "\" is not \"" << other << "\"";
    }
  }
  return std::getline(second, other) ? ::testing::AssertionFailure() << "only the second has \"" << other << "\""
                                     : ::testing::AssertionSuccess();
}

::testing::AssertionResult warnsOf(const std::vector<MapWarning>& warnings, std::size_t count,
                                   const std::string& what) {
  std::ostringstream all;
  for (const MapWarning& warning : warnings) {
    const bool begins_with_count = warning.what.rfind(std::to_string(count) + ' ', 0) == 0;
    if (warning.count == count && begins_with_count && warning.what.find(what) != std::string::npos) {
      return ::testing::AssertionSuccess() << warning.what;
    }
    all << "\n  " << warning.what;
  }
  return ::testing::AssertionFailure() << "no warning of " << count << " \"" << what << "\" among:" << all.str();
}

}  // namespace external_command
