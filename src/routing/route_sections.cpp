// SPDX-License-Identifier: Apache-2.0
#include "route_sections.h"

#include <algorithm>
#include <optional>

namespace external_command {

namespace {

constexpr double kClear = kSectionOverlap + 1.0;  // of starts, goals and lane changes [m]

/// A place of a row.
struct RowCut {
  std::size_t piece = 0;
  double s = 0.0;         // on its lane [m]
  double position = 0.0;  // along the row [m]
  bool is_main = false;   // of its lane
};

/// The places of a row between `low` and `high` [m] along it.
std::vector<RowCut> placesOf(const RouteRow& row, double low, double high, const LaneCutsOf& cuts_of) {
  std::vector<RowCut> places;
  double begin = 0.0;
  for (std::size_t i = 0; i < row.pieces.size(); ++i) {
    const LaneRange& piece = row.pieces[i];
    const double end = begin + piece.to_s - piece.from_s;
    if (end - begin >= 2.0 * kSectionOverlap && end > low && begin < high) {
      const auto cuts = cuts_of(piece.lane);
      for (std::size_t k = 0; k < cuts->places.size(); ++k) {
        const double s = cuts->places[k], position = begin + s - piece.from_s;
        const bool is_inside = s - piece.from_s >= kSectionOverlap && piece.to_s - s >= kSectionOverlap;
        if (is_inside && position >= low && position <= high) places.push_back({i, s, position, k == cuts->main});
      }
    }
    begin = end;
  }
  return places;
}

/// The first and the last, and the main ones in between.
std::vector<RowCut> chosenOf(const std::vector<RowCut>& places) {
  std::vector<RowCut> chosen;
  for (const RowCut& place : places) {
    if (place.is_main || &place == &places.front() || &place == &places.back()) chosen.push_back(place);
  }
  return chosen;
}

/// The part of a row from one cut to another; nullopt: from its beginning, or to its end.
RouteRow partOf(const RouteRow& row, const std::optional<RowCut>& from, const std::optional<RowCut>& to) {
  const auto first = row.pieces.begin() + static_cast<std::ptrdiff_t>(from ? from->piece : 0);
  const auto last = row.pieces.begin() + static_cast<std::ptrdiff_t>(to ? to->piece : row.pieces.size() - 1);
  RouteRow part;
  part.pieces.assign(first, last + 1);
  if (from) part.pieces.front().from_s = from->s;
  if (to) part.pieces.back().to_s = to->s;
  for (const LaneRange& piece : part.pieces) part.length += piece.to_s - piece.from_s;
  part.onto = from ? 0.0 : row.onto;
  part.leave = to ? part.length : part.length - (row.length - row.leave);
  part.change = to ? LaneChange::kNone : row.change;
  return part;
}

}  // namespace

std::vector<PathSection> sectionsOf(const std::vector<RouteRow>& rows, double merging, const LaneCutsOf& cuts_of) {
  std::vector<PathSection> sections(1);
  for (const RouteRow& row : rows) {
    const double low = kClear + (&row == &rows.front() ? merging : row.onto);
    const double high = (&row == &rows.back() ? row.length : row.leave) - kClear;
    std::optional<RowCut> from;
    for (const RowCut& cut : chosenOf(placesOf(row, low, high, cuts_of))) {
      sections.back().rows.push_back(partOf(row, from, cut));
      sections.back().goes_on = true;
      sections.emplace_back();
      sections.back().follows = true;
      from = cut;
    }
    sections.back().rows.push_back(from ? partOf(row, from, std::nullopt) : row);
  }
  return sections;
}

}  // namespace external_command
