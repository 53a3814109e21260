// SPDX-License-Identifier: Apache-2.0
#include "report_json.h"

#include <iomanip>

#include "external_command/core/printable.h"

namespace external_command {

namespace {

constexpr std::size_t kLongest = 100000;  // text [bytes]

/// Of a text without control characters, as printable() leaves them.
std::string quotedJson(const std::string& words) {
  std::string json = "\"";
  for (const char c : printable(words, kLongest)) {
    if (c == '"' || c == '\\') json += '\\';
    json += c;
  }
  return json + "\"";
}

const char* nameOf(FaultSeverity severity) { return severity == FaultSeverity::kError ? "error" : "warning"; }

template <class Texts>
void writeTexts(const Texts& texts, std::ostream& out) {
  const char* separator = "";
  out << "[";
  for (const std::string& words : texts) {
    out << separator << quotedJson(words);
    separator = ", ";
  }
  out << "]";
}

void writeFinding(const MapFinding& finding, std::ostream& out) {
  const MapFaultKind& kind = kindOf(finding.fault);
  out << "{\"severity\": \"" << nameOf(finding.severity) << "\", \"kind\": \"" << kind.name << "\", \"ids\": ";
  writeTexts(finding.ids, out);
  if (finding.place) {
    out << ", \"x\": " << finding.place->x() << ", \"y\": " << finding.place->y();
  } else {
    out << ", \"x\": null, \"y\": null";
  }
  out << ", \"size\": " << finding.size << ", \"what\": " << quotedJson(finding.what)
      << ", \"advice\": " << quotedJson(kind.advice) << "}";
}

/// Metres to the millimetre.
double drivenLength(const HdMap& map) {
  double length = 0.0;
  for (const Lane& lane : map.lanes()) {
    if (lane.isDrivable() && !lane.is_reversed) length += lane.length();
  }
  return length;
}

}  // namespace

void writeReport(const MapReport& report, const std::string& file, std::ostream& out) {
  const HdMap& map = *report.map;
  std::size_t lanes = 0, driven = 0, errors = 0;
  for (const Lane& lane : map.lanes()) {
    lanes += !lane.is_reversed;
    driven += !lane.is_reversed && lane.isDrivable();
  }
  for (const MapFinding& finding : report.findings) errors += finding.severity == FaultSeverity::kError;
  out << std::fixed << std::setprecision(3);
  out << "{\"map\": " << quotedJson(file) << ", \"version\": " << quotedJson(map.version()) << ",\n\"lanes\": " << lanes
      << ", \"driving_lanes\": " << driven << ", \"driving_length\": " << drivenLength(map)
      << ", \"parking_spaces\": " << map.parkingSpaces().size() << ", \"areas\": " << map.areas().size()
      << ", \"junctions\": " << map.junctions().size() << ",\n\"errors\": " << errors
      << ", \"warnings\": " << report.findings.size() - errors << ",\n\"notes\": ";
  writeTexts(report.notes, out);
  out << ",\n\"findings\": [";
  const char* separator = "\n";
  for (const MapFinding& finding : report.findings) {
    out << separator;
    writeFinding(finding, out);
    separator = ",\n";
  }
  out << "]}\n";
}

void writeKinds(std::ostream& out) {
  const char* separator = "[";
  for (const MapFaultKind& kind : mapFaultKinds()) {
    out << separator << "{\"kind\": \"" << kind.name << "\", \"severity\": \"" << nameOf(kind.severity)
        << "\", \"what\": " << quotedJson(kind.what) << ", \"advice\": " << quotedJson(kind.advice) << "}";
    separator = ",\n";
  }
  out << "]\n";
}

}  // namespace external_command
