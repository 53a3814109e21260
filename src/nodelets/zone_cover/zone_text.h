// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "external_command/coverage/coverage_progress.h"

namespace external_command {

/// The plan for a zone and its progress as text, numbers with all their digits:
///
///   external_command_zone 3                                     what it is, version of the format
///   zone KEY                                                    which zone: zoneKey(), hexadecimal
///   counts LINES SWEPT SKIPPED                                  how many numbers and lines follow
///   swept METRES METRES ...                                     of each line, from its start
///   skipped INDEX INDEX ...                                     of the lines
///   line LAP X Y HEADING ARCS LENGTH KAPPA LENGTH KAPPA ...     one each: CoverageProgress::lines
///   checksum CRC                                                CRC-32 of all bytes above, 8 hexadecimal digits
///
/// The head, which changes as the vehicle goes on, and the lines, which do not and are long, are made apart.
std::string zoneHead(std::uint64_t key, const CoverageProgress& progress);
std::string zoneLines(const std::vector<SwathLine>& lines);
std::string zoneChecksum(const std::string& head, const std::string& lines);

/// Bytes of the longest text that is taken.
constexpr std::size_t kMostZoneText = 64 << 20;

/// O(length of the text), in time and memory.
/// @throws InvalidRequest  it is damaged, of another zone or of another version; the text says how.
CoverageProgress parseZone(const std::string& text, std::uint64_t key);

}  // namespace external_command
