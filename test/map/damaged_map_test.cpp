// SPDX-License-Identifier: Apache-2.0
// Files that are no map, or no longer one: each is refused with a text that says what to do, none crashes.
#include <gtest/gtest.h>

#include <random>

#include "external_command/core/error.h"
#include "external_command/map/map_reader.h"
#include "external_command/proto/base_map.pb.h"
#include "map/map_files.h"

namespace external_command {
namespace {

/// What readMap() says of a path that it must refuse.
std::string refusalOf(const std::string& path) {
  try {
    readMap(path, {});
  } catch (const MapError& error) {
    return error.what();
  }
  return "";
}

void expectText(const std::string& why, const std::string& what) {
  EXPECT_NE(why.find(what), std::string::npos) << "the answer was: \"" << why << "\"";
}

/// A map of a few hundred lanes, each with a dozen points.
std::string binaryMap() {
  proto::Map map;
  for (int i = 0; i < 300; ++i) {
    proto::Lane* lane = map.add_lane();
    lane->mutable_id()->set_id("lane_" + std::to_string(i));
    lane->add_successor_id()->set_id("lane_" + std::to_string(i + 1));
    lane->set_type(proto::Lane::CITY_DRIVING);
    auto* line = lane->mutable_central_curve()->add_segment()->mutable_line_segment();
    for (int k = 0; k < 12; ++k) {
      line->add_point()->set_x(i * 10.0 + k);
      line->mutable_point(k)->set_y(0.5 * k * k);
    }
    proto::ParkingSpace* space = map.add_parking_space();
    space->mutable_id()->set_id("space_" + std::to_string(i));
    for (int k = 0; k < 4; ++k) {
      space->mutable_polygon()->add_point()->set_x(i * 10.0 + (k == 1 || k == 2 ? 5 : 0));
      space->mutable_polygon()->mutable_point(k)->set_y(k >= 2 ? 3 : 0);
    }
  }
  return map.SerializeAsString();
}

std::vector<std::string> mapsToDamage() {
  std::vector<std::string> maps = {binaryMap()};
  for (const std::string& file : sharedMaps()) maps.push_back(bytesOf(file));
  return maps;
}

/// Either a map or a MapError; anything else ends the test.
bool loads(const TemporaryFile& file, const std::string& bytes) {
  file.write(bytes);
  return refusalOf(file.path()).empty();
}

TEST(DamagedMap, NamesAPathThatCannotBeRead) {
  expectText(refusalOf("/no/such/map.bin"), "/no/such/map.bin cannot be opened: No such file or directory");
  expectText(refusalOf(""), "no map file is named");
  expectText(refusalOf(::testing::TempDir()), "is a folder; name the map file in it");
  expectText(refusalOf("/dev/zero"), "is not a regular file");
}

TEST(DamagedMap, RefusesFilesThatAreNoMap) {
  expectText(refusal(""), "is empty");
  expectText(refusal("Hello, world"), "is no map, or a damaged one: line 1");
  expectText(refusal("<?xml version='1.0'?><OpenDRIVE/>"), "is XML");
  expectText(refusal(" \n# nothing but a comment\n"), "holds no lane");
  expectText(refusal("header { version: \"1\" }"), "holds no lane");
  expectText(refusal(std::string(1000, '\0')), "is no map");
  expectText(refusal(std::string("\x7f"
                                 "ELF\x02\x01\x01\0\0\0",
                                 10)),
             "it makes no sense from byte 0 of 10 on");
  expectText(refusal(std::string("\x0a\x00", 2)), "holds no lane");
  for (const std::string& bytes : {std::string("x\0y", 3), std::string("Hello")}) {
    expectText(refusal(bytes), "give Apollo's base_map or sim_map, binary or protobuf text");
  }
}

TEST(DamagedMap, RefusesRandomBytes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255), size(1, 3000);
  for (int round = 0; round < 200; ++round) {
    std::string bytes(static_cast<std::size_t>(size(random)), '\0');
    for (char& c : bytes) c = static_cast<char>(byte(random));
    EXPECT_FALSE(refusal(bytes).empty()) << "round " << round;
  }
}

TEST(DamagedMap, SaysWhereATruncatedFileBreaksOff) {
  const std::string whole = binaryMap();
  const std::string why = refusal(whole.substr(0, whole.size() - 5));
  expectText(why, "truncated");
  expectText(why, " of " + std::to_string(whole.size() - 5) + " on");
}

TEST(DamagedMap, SurvivesTruncationAnywhere) {
  const TemporaryFile file("");
  for (const std::string& whole : mapsToDamage()) {
    std::size_t refused = 0, tried = 0;
    for (std::size_t size = 0; size < whole.size(); size += std::max<std::size_t>(1000, whole.size() / 150)) {
      refused += !loads(file, whole.substr(0, size));
      ++tried;
    }
    EXPECT_GT(refused, tried * 9 / 10);
  }
}

TEST(DamagedMap, SurvivesTruncationOfATextAnywhere) {
  if (sharedMaps().empty()) GTEST_SKIP() << "no maps in " << EC_SHARED_DIR << "/data/maps";
  const std::string whole = bytesOf(std::string(EC_SHARED_DIR) + "/data/maps/town01/sim_map.txt");
  const TemporaryFile file("");
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 25) loads(file, whole.substr(0, size));
}

TEST(DamagedMap, SurvivesFlippedBytes) {
  const TemporaryFile file("");
  std::mt19937 random(1);
  for (const std::string& whole : mapsToDamage()) {
    std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
    std::uniform_int_distribution<int> byte(0, 255);
    for (int round = 0; round < 50; ++round) {
      std::string bytes = whole;
      for (int i = 0; i <= round % 10; ++i) bytes[place(random)] = static_cast<char>(byte(random));
      loads(file, bytes);
    }
  }
}

TEST(DamagedMap, SurvivesFlippedBytesInSmallMaps) {
  const std::string whole = binaryMap().substr(0, 2000);
  const TemporaryFile file("");
  std::mt19937 random(2);
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = whole;
    for (int i = 0; i <= round % 5; ++i) bytes[place(random)] = static_cast<char>(byte(random));
    loads(file, bytes);
  }
}

TEST(DamagedMap, PutsNothingOnStderr) {
  ::testing::internal::CaptureStderr();
  refusal("lane { length: x");
  refusal(binaryMap().substr(0, 4567));
  refusal(std::string("\x22\xff\xff\xff\xff\x0f\x01", 7));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace external_command
