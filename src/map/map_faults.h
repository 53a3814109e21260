// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/map/map_fault.h"

namespace external_command {

/// Where a fault lies, and how large it is where it has a size.
struct FaultPlace {
  std::optional<Point2d> point = {};
  double size = 0.0;
};

/// Counts the faults of a map by kind, with the largest of each, or the first, as the example. All of them are kept
/// only where that is asked for: a damaged map has as many faults as objects.
class MapFaults {
 public:
  explicit MapFaults(bool keeps_all) : keeps_all_(keeps_all), counts_(mapFaultKinds().size()) {}

  /// @param example  which and how much, as text() puts it together; that is done for what is kept only.
  template <class... Args>
  void add(MapFault fault, std::initializer_list<std::string_view> ids, const FaultPlace& place,
           const Args&... example) {
    addOne(fault, ids, place, example...);
  }

  template <class... Args>
  void add(MapFault fault, const std::vector<std::string>& ids, const FaultPlace& place, const Args&... example) {
    addOne(fault, ids, place, example...);
  }

  bool keepsAll() const { return keeps_all_; }

  /// Those of `later`, which were found in what comes behind, behind these.
  void append(MapFaults later);

  /// One for each kind that there is, in the order of MapFault.
  std::vector<MapWarning> warnings() const;

  /// Empty unless all are kept.
  std::vector<MapFinding> takeFindings() { return std::move(findings_); }

 private:
  struct Count {
    std::size_t count = 0;
    double worst = 0.0;
    std::string example;
  };

  template <class Ids, class... Args>
  void addOne(MapFault fault, const Ids& ids, const FaultPlace& place, const Args&... example) {
    Count& count = counts_[static_cast<std::size_t>(fault)];
    const bool is_example = count.count++ == 0 || place.size > count.worst;
    if (!is_example && !keeps_all_) return;
    std::string what = text(example...);
    if (is_example) {
      count.example = what;
      count.worst = place.size;
    }
    if (!keeps_all_) return;
    const FaultSeverity severity = kindOf(fault).severity;
    findings_.push_back({fault, severity, {ids.begin(), ids.end()}, place.point, place.size, std::move(what)});
  }

  bool keeps_all_;
  std::vector<Count> counts_;
  std::vector<MapFinding> findings_;
};

}  // namespace external_command
