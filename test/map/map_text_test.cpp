// SPDX-License-Identifier: Apache-2.0
// The text form of a map: what is read, passed over, and refused.
#include <gtest/gtest.h>

#include <cmath>

#include "external_command/map/map_reader.h"
#include "map/map_files.h"

namespace external_command {
namespace {

/// A text with one lane, of which `fields` are some.
std::string lane(const std::string& fields) { return "lane { id { id: \"a\" } " + fields + " }\n"; }

TEST(MapText, ReadsNumbersInEveryNotation) {
  const auto lengthOf = [](const std::string& number) { return dataOf(lane("length: " + number)).lanes[0].length; };
  EXPECT_EQ(lengthOf("1"), 1.0);
  EXPECT_EQ(lengthOf("-1.5"), -1.5);
  EXPECT_EQ(lengthOf("- 2"), -2.0);
  EXPECT_EQ(lengthOf("1e3"), 1000.0);
  EXPECT_EQ(lengthOf("2.5E-2"), 0.025);
  EXPECT_EQ(lengthOf("1.5f"), 1.5);
  EXPECT_EQ(lengthOf("18446744073709551616"), 18446744073709551616.0);
  EXPECT_EQ(lengthOf("-inf"), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(lengthOf("nan")));
}

TEST(MapText, ReadsStringsInEveryNotation) {
  const auto idOf = [](const std::string& id) { return dataOf("lane { id { id: " + id + " } }").lanes[0].id; };
  EXPECT_EQ(idOf("'a'"), "a");
  EXPECT_EQ(idOf("\"a\" 'b'\n\"c\""), "abc");
  EXPECT_EQ(idOf("\"\\303\\244\\n\\\"\""), "\xc3\xa4\n\"");
  EXPECT_EQ(idOf("\"\xc3\xa4\""), "\xc3\xa4");
}

TEST(MapText, ReadsEverySpellingOfAField) {
  for (const char* text :
       {"lane { id { id: \"a\" } type: SIDEWALK }", "lane: { id: { id: \"a\" }, type: SIDEWALK; };",
        "lane < id < id: \"a\" > type: 4 >", "lane: [{ id { id: \"a\" } type: SIDEWALK }]",
        "# a comment\nlane {# another\n id { id: 'a' } type:SIDEWALK}", "lane{id{id:\"a\"}type:SIDEWALK}\r\n"}) {
    const MapData data = dataOf(text);
    EXPECT_EQ(data.lanes.at(0).id, "a") << text;
    EXPECT_EQ(data.lanes.at(0).type, LaneType::kSidewalk) << text;
  }
  EXPECT_TRUE(dataOf(lane("left_boundary { virtual: true }")).lanes[0].left.is_virtual);
  EXPECT_FALSE(dataOf(lane("left_boundary { virtual: false }")).lanes[0].left.is_virtual);
  const MapData data = dataOf(lane("left_boundary { boundary_type { types: [CURB, SOLID_WHITE] } }"));
  EXPECT_EQ(data.lanes[0].left.types[0].type, BoundaryType::kCurb);
}

TEST(MapText, PassesOverFieldsItDoesNotKnow) {
  for (const char* unknown :
       {"foo: 1", "foo: -1.5e3", "foo: BAR", "foo: \"a\" \"b\"", "foo: true", "foo { bar: 1 baz < qux: 'x' > }",
        "foo: { }", "foo: [1, 2, 3]", "foo: [{ bar: 1 }, { bar: 2 }]", "foo: []", "[some.extension]: 5",
        "[some.extension] { bar: 1 }", "[type.googleapis.com/some.Type] { bar: 1 }", "foo: -inf,", "foo: 1;",
        "speed_limits: 3"}) {
    const MapData data = dataOf(lane(std::string(unknown) + " speed_limit: 3"));
    EXPECT_EQ(data.lanes.at(0).speed_limit, 3.0) << unknown;
    EXPECT_EQ(dataOf(std::string(unknown) + "\n" + lane("")).lanes.size(), 1u) << unknown;
  }
}

TEST(MapText, DoesNotDriveOnALaneOfAnUnknownType) {
  for (const char* type : {"type: HOVERCRAFT", "type: 99", "type: -1", "type: 1e30"}) {
    const MapData data = dataOf(lane(type));
    EXPECT_EQ(data.lanes[0].type, LaneType::kNone) << type;
    EXPECT_EQ(data.lanes[0].type_statement, TypeStatement::kUnknown) << type;
  }
}

TEST(MapText, NamesThePlaceOfAMistake) {
  const auto expectRefusal = [](const std::string& text, const std::string& what) {
    const std::string why = refusal(text);
    EXPECT_NE(why.find(what), std::string::npos) << text << " was answered: " << why;
  };
  expectRefusal("lane {\n  id { id: \"a\" }\n", "line 3, column 1: expected the name of a field, found the end of");
  expectRefusal("lane { length: }", "line 1, column 16: expected a number, found \"}\"");
  expectRefusal("lane { length: \"x\" }", "expected a number");
  expectRefusal("lane { length 5 }", "expected \":\"");
  expectRefusal("lane { id { id: 5 } }", "expected a text in quotes");
  expectRefusal("lane 5", "expected \"{\", found \"5\"");
  expectRefusal("lane { left_boundary { virtual: 7 } }", "expected true or false");
  expectRefusal("lane { id { id: \"open } }", "line 1, column");
  expectRefusal("lane { } }", "expected the name of a field, found \"}\"");
  expectRefusal("lane [ ", "expected");
  expectRefusal("foo: [1 2]", "expected \",\" or \"]\"");
  expectRefusal("[foo", "expected \"]\"");
  expectRefusal("Just a letter, not a map.", "expected");
}

TEST(MapText, RefusesBottomlessNesting) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "foo { ";
  EXPECT_NE(refusal(text).find("at most 100 nested messages"), std::string::npos);
}

}  // namespace
}  // namespace external_command
