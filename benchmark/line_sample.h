// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/pose.h"

namespace external_command {
namespace benchmark {

/// Which parts of each of many parallel lines a shape covers; that gives its area. Shapes may overlap: they count twice
/// until they are merged.
struct LineSample {
  struct Part {
    int line;
    double from, to;  ///< along the line [m]
  };
  std::vector<Part> parts;

  double length() const;  ///< of all parts [m]

  void merge();                                       ///< sorts, and joins parts that overlap
  LineSample common(const LineSample& other) const;   ///< both merged before
  LineSample without(const LineSample& other) const;  ///< both merged before
};

/// Parallel lines across an area, askew so that hardly any border runs along one of them.
class Lines {
 public:
  /// @param origin   somewhere in the area, since far from it digits are lost.
  /// @param spacing  between the lines [m].
  Lines(const Point2d& origin, double spacing);

  /// Adds what lies inside an odd number of the rings.
  template <class Rings>
  void add(const Rings& rings, LineSample* sample) const {
    std::vector<Crossing> crossings;
    for (const auto& ring : rings) addCrossings(ring, &crossings);
    addParts(&crossings, sample);
  }

  double area(const LineSample& sample) const { return spacing_ * sample.length(); }

 private:
  struct Crossing {
    int line;
    double at;
  };

  template <class Ring>
  void addCrossings(const Ring& ring, std::vector<Crossing>* crossings) const {
    for (std::size_t i = 0; i < ring.size(); ++i) cross(ring[i], ring[(i + 1) % ring.size()], crossings);
  }
  void cross(const Point2d& a, const Point2d& b, std::vector<Crossing>* crossings) const;
  static void addParts(std::vector<Crossing>* crossings, LineSample* sample);

  double spacing_;
  Point2d origin_;
  Point2d ahead_;
  Point2d aside_;
};

}  // namespace benchmark
}  // namespace external_command
