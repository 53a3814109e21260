// SPDX-License-Identifier: Apache-2.0
#include "zone_text.h"

#include <boost/crc.hpp>
#include <iomanip>
#include <locale>
#include <sstream>

#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr const char* kFormat = "external_command_zone";
constexpr int kVersion = 3;
constexpr std::size_t kChecksumLine = 18;  // bytes: "checksum 01234567\n"

using Crc = boost::crc_32_type;

std::ostringstream stream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());  // a program's own must not change how numbers are written
  out << std::setprecision(17);
  return out;
}

std::string lineOf(const Crc& crc) {
  std::ostringstream out = stream();
  out << "checksum " << std::hex << std::setw(8) << std::setfill('0') << crc.checksum() << '\n';
  return out.str();
}

std::string hex(std::uint64_t key) {
  std::ostringstream out = stream();
  out << std::hex << std::setw(16) << std::setfill('0') << key;
  return out.str();
}

/// Reads a text that has its checksum: what is wrong in it is a bug, or another version's.
class Reader {
 public:
  explicit Reader(const std::string& text) : in_(text), left_(text.size()) { in_.imbue(std::locale::classic()); }

  void expect(const std::string& word) {
    std::string found;
    in_ >> found;
    if (found != word) throw InvalidRequest(text("there is ", quoted(found), " where '", word, "' should be"));
  }

  template <class Number>
  Number number() {
    Number value{};
    in_ >> value;
    if (!in_) throw InvalidRequest("a number is missing");
    return value;
  }

  /// Of things that take two bytes each in the text, at the least.
  std::size_t count() {
    const auto value = number<std::size_t>();
    if (value > left_ / 2) throw InvalidRequest(text(value, " numbers are said to follow, more than there can be"));
    return value;
  }

  SwathLine line() {
    expect("line");
    SwathLine line;
    line.lap = number<int>();
    line.start.x = number<double>();
    line.start.y = number<double>();
    line.start.heading = number<double>();
    line.arcs.resize(count());
    left_ -= 2 * line.arcs.size();
    for (ArcSegment& arc : line.arcs) {
      arc.length = number<double>();
      arc.kappa = number<double>();
    }
    return line;
  }

 private:
  std::istringstream in_;
  std::size_t left_;  ///< bytes of the text that no count has laid claim to
};

void requireChecksum(const std::string& content, std::size_t length) {
  Crc crc;
  crc.process_bytes(content.data(), length);
  if (content.compare(length, std::string::npos, lineOf(crc)) == 0) return;
  throw InvalidRequest("its checksum is wrong");
}

}  // namespace

std::string zoneHead(std::uint64_t key, const CoverageProgress& progress) {
  std::ostringstream out = stream();
  out << kFormat << ' ' << kVersion << "\nzone " << hex(key) << "\ncounts " << progress.lines.size() << ' '
      << progress.swept.size() << ' ' << progress.skipped.size() << "\nswept";
  for (const double swept : progress.swept) out << ' ' << swept;
  out << "\nskipped";
  for (const std::size_t index : progress.skipped) out << ' ' << index;
  out << '\n';
  return out.str();
}

std::string zoneLines(const std::vector<SwathLine>& lines) {
  std::ostringstream out = stream();
  for (const SwathLine& line : lines) {
    out << "line " << line.lap << ' ' << line.start.x << ' ' << line.start.y << ' ' << line.start.heading << ' '
        << line.arcs.size();
    for (const ArcSegment& arc : line.arcs) out << ' ' << arc.length << ' ' << arc.kappa;
    out << '\n';
  }
  return out.str();
}

std::string zoneChecksum(const std::string& head, const std::string& lines) {
  Crc crc;
  crc.process_bytes(head.data(), head.size());
  crc.process_bytes(lines.data(), lines.size());
  return lineOf(crc);
}

CoverageProgress parseZone(const std::string& content, std::uint64_t key) {
  if (content.size() > kMostZoneText) throw InvalidRequest(text("it is longer than ", kMostZoneText, " bytes"));
  if (content.size() < kChecksumLine) throw InvalidRequest("it is cut off");
  requireChecksum(content, content.size() - kChecksumLine);
  Reader reader(content);
  reader.expect(kFormat);
  const int version = reader.number<int>();
  if (version != kVersion) {
    throw InvalidRequest(text("it is of version ", version, ", and this program reads version ", kVersion));
  }
  reader.expect("zone");
  reader.expect(hex(key));
  reader.expect("counts");
  const std::size_t lines = reader.count(), swept = reader.count(), skipped = reader.count();
  CoverageProgress progress;
  reader.expect("swept");
  for (std::size_t i = 0; i < swept; ++i) progress.swept.push_back(reader.number<double>());
  reader.expect("skipped");
  for (std::size_t i = 0; i < skipped; ++i) progress.skipped.push_back(reader.number<std::size_t>());
  for (std::size_t i = 0; i < lines; ++i) progress.lines.push_back(reader.line());
  reader.expect("checksum");
  if (progress.lines.empty()) throw InvalidRequest("it has no swaths");
  return progress;
}

}  // namespace external_command
