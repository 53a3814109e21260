// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "external_command/map/map_data.h"
#include "external_command/map/map_fault.h"

namespace external_command {

/// A file that exists as long as this object does.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& bytes);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& bytes) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string bytesOf(const std::string& file);

/// What a file of these bytes says.
MapData dataOf(const std::string& bytes);

/// The three maps beside the checkout; empty where they are not there.
std::vector<std::string> sharedMaps();

/// The text that readMapData() refuses a file with these bytes with; empty where it takes them.
std::string refusal(const std::string& bytes);

/// Every field of both, exactly.
::testing::AssertionResult sameData(const MapData& a, const MapData& b);

/// True where one of `warnings` begins with `count` and a blank and holds `what`.
::testing::AssertionResult warnsOf(const std::vector<MapWarning>& warnings, std::size_t count, const std::string& what);

}  // namespace external_command
