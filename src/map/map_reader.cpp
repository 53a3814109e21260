// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/map_reader.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "core/digest.h"
#include "external_command/core/error.h"
#include "external_command/core/in_parallel.h"
#include "external_command/core/text.h"
#include "field_stream.h"
#include "map_file.h"
#include "proto_conversion.h"
#include "text_message_reader.h"
#include "wire_fields.h"

namespace external_command {

namespace {

constexpr std::size_t kNowhere = std::string::npos;
constexpr const char* kWhatNext = "; give Apollo's base_map or sim_map, binary or protobuf text";

/// A binary map cannot do without control characters (field tags and lengths), a text has none.
bool looksBinary(const MapFile& file) {
  constexpr std::size_t kEnough = 4096;
  const std::string head = file.head(kEnough);
  return std::any_of(head.begin(), head.end(), [](unsigned char c) { return c < 0x20 && !(c >= '\t' && c <= '\r'); });
}

MapData parseText(const MapFile& file) {
  const std::string bytes = file.head(file.size());
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != std::string::npos && bytes[start] == '<') {
    throw MapError(text(file.path(), " is XML (OpenDRIVE or Lanelet2?), which is not read here", kWhatNext));
  }
  ProtoConverter converter;
  proto::Map part;
  try {
    readTextMessage(bytes, &part, [&] {
      converter.add(part);
      part.Clear();
    });
  } catch (const TextMessageError& error) {
    throw MapError(text(file.path(), " is no map, or a damaged one: ", error.what(), kWhatNext));
  }
  MapData data = converter.take();
  data.file_digest = contentDigest(bytes);
  return data;
}

/// Parses what FieldStream hands out, on all processors.
class BinaryParser {
 public:
  explicit BinaryParser(const MapFile& file) : file_(file), stream_(file), digest_(file.size()) {}

  MapData parse() {
    inParallel(parallelParts(digest_.parts()), [this](std::size_t) { work(); });
    if (bad_at_ != kNowhere) {
      throw MapError(text(file_.path(), " is no map, or a damaged or truncated one: it makes no sense from byte ",
                          bad_at_, " of ", file_.size(), " on", kWhatNext));
    }
    MapData data = ProtoConverter::takeAll(std::move(converters_));
    data.file_digest = digest_.value();
    return data;
  }

 private:
  void work() {
    FieldStream::Batch batch;
    proto::Map field;
    while (bad_at_ == kNowhere && stream_.next(&batch)) {
      batch.addTo(&digest_);
      ProtoConverter converter;
      const std::size_t bad = convert(batch, &field, &converter);
      const std::lock_guard<std::mutex> lock(mutex_);
      if (bad != kNowhere) bad_at_ = std::min<std::size_t>(bad_at_, batch.position + bad);
      if (converters_.size() <= batch.index) converters_.resize(batch.index + 1);
      converters_[batch.index] = std::move(converter);
    }
  }

  /// A message cut between two of its fields is two messages, which merge into the one. So each lane is parsed into the
  /// memory of the one before: faster than all of them at once, and without a second copy of the map.
  /// @return  where a field makes no sense; kNowhere where all do.
  static std::size_t convert(const FieldStream::Batch& batch, proto::Map* field, ProtoConverter* converter) {
    if (batch.end == 0) return 0;
    const std::string_view bytes = batch.bytes;
    for (std::size_t begin = 0, size = 0; begin < batch.end; begin += size) {
      size = fieldSize(bytes.substr(begin)).value();
      if (!field->ParsePartialFromArray(bytes.data() + begin, static_cast<int>(size))) return begin;
      converter->add(*field);
    }
    return kNowhere;
  }

  const MapFile& file_;
  FieldStream stream_;
  ContentDigest digest_;
  std::atomic<std::size_t> bad_at_{kNowhere};
  std::mutex mutex_;
  std::vector<ProtoConverter> converters_;  ///< of each batch
};

MapData parse(const std::string& path) {
  const MapFile file(path);
  return looksBinary(file) ? BinaryParser(file).parse() : parseText(file);
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
