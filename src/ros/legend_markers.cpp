// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/ros/map_markers.h"
#include "marker_shapes.h"

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kLettersPerExtent = 45.0;  // the width of the part over the height of a letter
constexpr double kRowHeight = 1.7;          // this and the following in heights of a letter
constexpr double kSampleLength = 3.0;
constexpr double kLetterWidth = 0.5;  // of a letter, about
constexpr double kColumnWidth = 22.0;
constexpr std::size_t kRowsPerColumn = 6;

struct Row {
  const char* words;
  std_msgs::ColorRGBA color;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"lane to drive on", paint::kLane},
      {"other lane", paint::kOtherLane},
      {"centre line", paint::kCenterLine},
      {"junction", paint::kJunction},
      {"parking space", paint::kParkingSpace},
      {"area", paint::kArea},
      {"vehicle", paint::kVehicle},
      {"route", paint::kRoute},
      {"path, start", paint::kForward},
      {"path in reverse", paint::kReverse},
      {"goal, conflict", paint::kConflict},
      {"way point", paint::kWayPoint},
  };
  return all;
}

/// The largest of 1, 2, 5, 10, 20, ... that is not above `most`.
double roundLength(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= most) return digit * power;
  }
  return power;
}

}  // namespace

MarkerArray legendMarkers(const MapPart& part, const std::string& frame) {
  const Point2d size = part.box.max - part.box.min;
  const double letter = std::max(size.maxCoeff(), 20.0) / kLettersPerExtent;
  const Point2d corner(part.box.min.x(), part.box.min.y() - 3.0 * letter);
  Marker samples = marker(frame, "legend", Marker::LINE_LIST, 0.6 * letter, paint::kText);
  MarkerArray texts;
  int number = 1;
  const auto write = [&](const std::string& words, const Point2d& left) {
    const Point2d middle = left + Point2d(words.size() * kLetterWidth * letter / 2.0, 0.0);
    texts.markers.push_back(textMarker(frame, "legend", words, middle, letter, paint::kText));
    texts.markers.back().id = number++;
  };
  const auto draw = [&](const Point2d& left, double length, const std_msgs::ColorRGBA& color) {
    addLine({left, left + Point2d(length, 0.0)}, kLineHeight, &samples);
    samples.colors.resize(samples.points.size(), color);
  };

  std::size_t index = 0;
  for (const Row& row : rows()) {
    const double column = index / kRowsPerColumn, line = index % kRowsPerColumn;
    const Point2d left = corner + letter * Point2d(column * kColumnWidth, -line * kRowHeight);
    draw(left, kSampleLength * letter, row.color);
    write(row.words, left + Point2d((kSampleLength + 1.0) * letter, 0.0));
    ++index;
  }
  const double length = roundLength(size.maxCoeff() / 5.0);
  const Point2d left = corner - Point2d(0.0, (kRowsPerColumn + 0.5) * kRowHeight * letter);
  draw(left, length, paint::kText);
  write(text(length, " m"), left + Point2d(length + letter, 0.0));

  texts.markers.push_back(std::move(samples));
  return texts;
}

}  // namespace external_command
