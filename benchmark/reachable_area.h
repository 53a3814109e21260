// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage_case.h"

namespace external_command {
namespace benchmark {

/// What a tool can sweep that gets everywhere where its carrier fits: the free area shrunk by half the larger of
/// vehicle and swath width, of it the part that holds `start` or is nearest to it, grown by half the swath. A little of
/// that may lie outside the free area. It knows neither the vehicle's length nor its turning radius.
/// @return a border and holes; empty where nothing can be reached.
std::vector<Ring> reachableArea(const CoverageCase& field, const Point2d& start);

}  // namespace benchmark
}  // namespace external_command
