// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/map_reader.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/digest.h"
#include "external_command/core/error.h"
#include "external_command/core/in_parallel.h"
#include "external_command/core/text.h"
#include "file_bytes.h"
#include "proto_conversion.h"
#include "text_message_reader.h"
#include "wire_fields.h"

namespace external_command {

namespace {

constexpr std::size_t kPartSize = 1 << 20;  // of files that are parsed in parts [bytes]
constexpr const char* kWhatNext = "; give Apollo's base_map or sim_map, binary or protobuf text";

/// A binary map cannot do without control characters (field tags and lengths), a text has none.
bool looksBinary(const std::string& bytes) {
  constexpr std::size_t kEnough = 4096;
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kEnough));
  return std::any_of(bytes.begin(), end, [](unsigned char c) { return c < 0x20 && !(c >= '\t' && c <= '\r'); });
}

void parseText(const std::string& file, const std::string& bytes, ProtoConverter* converter) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != std::string::npos && bytes[start] == '<') {
    throw MapError(text(file, " is XML (OpenDRIVE or Lanelet2?), which is not read here", kWhatNext));
  }
  proto::Map part;
  try {
    readTextMessage(bytes, &part, [&] {
      converter->add(part);
      part.Clear();
    });
  } catch (const TextMessageError& error) {
    throw MapError(text(file, " is no map, or a damaged one: ", error.what(), kWhatNext));
  }
}

[[noreturn]] void failAt(const std::string& file, const std::string& bytes, std::size_t position) {
  throw MapError(text(file, " is no map, or a damaged or truncated one: it makes no sense from byte ", position, " of ",
                      bytes.size(), " on", kWhatNext));
}

/// Where the fields of a message may be cut into parts of about the same size: the beginnings of the parts, and the end
/// of the last field.
std::vector<std::size_t> cutBetweenFields(const std::string& bytes, std::size_t parts) {
  std::vector<std::size_t> cuts = {0};
  std::size_t position = 0;
  while (position < bytes.size()) {
    const std::size_t end = fieldEnd(bytes, position);
    if (end == kNoField) break;
    position = end;
    if (position / cuts.size() >= bytes.size() / parts && cuts.size() < parts) cuts.push_back(position);
  }
  cuts.push_back(position);
  return cuts;
}

/// A message cut between two of its fields is two messages, which merge into the one. So each lane is parsed into the
/// memory of the one before: faster than all of them at once, and without a second copy of the map. And a large file is
/// parsed in parts at the same time.
void parseBinary(const std::string& file, const std::string& bytes, ProtoConverter* converter) {
  const std::vector<std::size_t> cuts = cutBetweenFields(bytes, parallelParts(bytes.size() / kPartSize));
  std::vector<ProtoConverter> parts(cuts.size() - 1);
  inParallel(parts.size(), [&](std::size_t i) {
    proto::Map field;
    for (std::size_t begin = cuts[i], end = begin; begin < cuts[i + 1]; begin = end) {
      end = fieldEnd(bytes, begin);
      const bool is_read = field.ParsePartialFromArray(bytes.data() + begin, static_cast<int>(end - begin));
      if (!is_read) failAt(file, bytes, begin);
      parts[i].add(field);
    }
  });
  if (cuts.back() < bytes.size()) failAt(file, bytes, cuts.back());
  for (ProtoConverter& part : parts) converter->add(std::move(part));
}

MapData parse(const std::string& file) {
  const std::string bytes = fileBytes(file);
  ProtoConverter converter;
  looksBinary(bytes) ? parseBinary(file, bytes, &converter) : parseText(file, bytes, &converter);
  MapData data = converter.take();
  data.file_digest = contentDigest(bytes);
  return data;
}

/// Middle of the box around the centre lines, to the metre.
Point2d middleOf(const MapData& data) {
  Point2d low = Point2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const LaneData& lane : data.lanes) {
    for (const Point2d& point : lane.center) {
      if (!isPlausible(point)) continue;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  const Point2d middle = (low + high) / 2.0;
  return middle.allFinite() ? Point2d(middle.array().round()) : Point2d(Point2d::Zero());
}

}  // namespace

MapData readMapData(const std::string& file) {
  MapData data = parse(file);
  if (data.lanes.empty()) throw MapError(text(file, " holds no lane", kWhatNext));
  return data;
}

std::shared_ptr<const HdMap> readMap(const std::string& file, const MapOrigin& origin, const MapParams& params) {
  MapData data = readMapData(file);
  Point2d shift = Point2d::Zero();
  if (origin.kind == MapOrigin::Kind::kAuto) shift = middleOf(data);
  if (origin.kind == MapOrigin::Kind::kGiven) shift = origin.point;
  try {
    return std::make_shared<const HdMap>(std::move(data), shift, params);
  } catch (const MapError& error) {
    throw MapError(text(file, ": ", error.what()));
  }
}

}  // namespace external_command
