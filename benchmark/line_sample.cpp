// SPDX-License-Identifier: Apache-2.0
#include "line_sample.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace external_command {
namespace benchmark {

namespace {

constexpr double kHeading = 0.3217;  ///< of the lines: of no use to a planner [rad]

}  // namespace

double LineSample::length() const {
  double sum = 0.0;
  for (const Part& part : parts) sum += part.to - part.from;
  return sum;
}

void LineSample::merge() {
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return std::tie(a.line, a.from) < std::tie(b.line, b.from); });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].line == parts[kept].line && parts[i].from <= parts[kept].to) {
      parts[kept].to = std::max(parts[kept].to, parts[i].to);
    } else {
      parts[++kept] = parts[i];
    }
  }
  if (!parts.empty()) parts.resize(kept + 1);
}

LineSample LineSample::common(const LineSample& other) const {
  LineSample result;
  auto a = parts.begin(), b = other.parts.begin();
  while (a != parts.end() && b != other.parts.end()) {
    if (a->line == b->line && std::max(a->from, b->from) < std::min(a->to, b->to)) {
      result.parts.push_back({a->line, std::max(a->from, b->from), std::min(a->to, b->to)});
    }
    if (std::tie(a->line, a->to) < std::tie(b->line, b->to)) {
      ++a;
    } else {
      ++b;
    }
  }
  return result;
}

LineSample LineSample::without(const LineSample& other) const {
  LineSample result;
  auto b = other.parts.begin();
  for (Part rest : parts) {
    while (b != other.parts.end() && std::tie(b->line, b->to) <= std::tie(rest.line, rest.from)) ++b;
    for (auto cut = b; cut != other.parts.end() && cut->line == rest.line && cut->from < rest.to; ++cut) {
      if (cut->from > rest.from) result.parts.push_back({rest.line, rest.from, cut->from});
      rest.from = std::max(rest.from, cut->to);
    }
    if (rest.from < rest.to) result.parts.push_back(rest);
  }
  return result;
}

Lines::Lines(const Point2d& origin, double spacing)
    : spacing_(spacing), origin_(origin), ahead_(unitVector(kHeading)), aside_(-ahead_.y(), ahead_.x()) {}

void Lines::cross(const Point2d& a, const Point2d& b, std::vector<Crossing>* crossings) const {
  const double from = aside_.dot(a - origin_) / spacing_, to = aside_.dot(b - origin_) / spacing_;
  const double at_a = ahead_.dot(a - origin_), slope = (ahead_.dot(b - origin_) - at_a) / (to - from);
  // Half open, so that a line through a corner crosses one of the two edges there.
  const int first = static_cast<int>(std::ceil(std::min(from, to))),
            end = static_cast<int>(std::ceil(std::max(from, to)));
  for (int line = first; line < end; ++line) crossings->push_back({line, at_a + slope * (line - from)});
}

void Lines::addParts(std::vector<Crossing>* crossings, LineSample* sample) {
  std::sort(crossings->begin(), crossings->end(),
            [](const Crossing& a, const Crossing& b) { return std::tie(a.line, a.at) < std::tie(b.line, b.at); });
  for (std::size_t i = 0; i + 1 < crossings->size(); i += 2) {
    sample->parts.push_back({(*crossings)[i].line, (*crossings)[i].at, (*crossings)[i + 1].at});
  }
}

}  // namespace benchmark
}  // namespace external_command
