// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/coverage_case.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../benchmark/made_fields.h"

namespace external_command {
namespace benchmark {
namespace {

const std::string kSquare = "[[[0, 0], [20, 0], [20, 10], [0, 10], [0, 0]], [[5, 5, 1], [6, 5, 1], [5, 6, 1]]]";
const std::string kPolygon = R"({"type": "Polygon", "coordinates": )" + kSquare + "}";

/// A folder with one file, while it lives.
class CoverageCaseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("coverage_case_test_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file() const { return (folder_ / "park.geojson").string(); }

  std::vector<CoverageCase> read(const std::string& content) {
    std::ofstream(file()) << content;
    return readCoverageCases(file(), &skipped_);
  }

  std::filesystem::path folder_;
  std::vector<std::string> skipped_;
};

TEST_F(CoverageCaseFile, MayBeAFeature) {
  const auto fields = read(R"({"type": "Feature", "properties": {"name": "a/b", "swath_width": 1.6, "start": [1, 2, 3],
    "vehicle": {"wheelbase": 1, "max_steer": 0.5}}, "geometry": )" +
                           kPolygon + "}");
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].name, "a_b");
  EXPECT_EQ(fields[0].swath_width, 1.6);
  EXPECT_EQ(fields[0].start->heading, 3.0);
  EXPECT_NEAR(fields[0].vehicle.min_turning_radius, 1.0 / std::tan(0.5), 1e-12);
  EXPECT_EQ(fields[0].vehicle.width, tractor().width);
  ASSERT_EQ(fields[0].rings.size(), 2U);
  EXPECT_EQ(fields[0].rings[0].size(), 4U);
  EXPECT_EQ(fields[0].rings[1].size(), 3U);
  EXPECT_EQ(fields[0].area().outer.area(), 200.0);
}

TEST_F(CoverageCaseFile, MayBeABareGeometry) {
  const auto fields = read(kPolygon);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].name, "park");
  EXPECT_EQ(fields[0].swath_width, kTractorSwath);
  EXPECT_FALSE(fields[0].start);
}

TEST_F(CoverageCaseFile, MayBeACollectionOfPolygonsAndOtherThings) {
  const auto fields = read(R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": null, "geometry": )" +
                           kPolygon + R"(},
    {"type": "Feature", "properties": {"start": null}, "geometry": {"type": "Point", "coordinates": [1, 2]}},
    {"type": "Feature", "properties": {"swath_width": null}, "geometry": {"type": "MultiPolygon", "coordinates": [)" +
                           kSquare + ", " + kSquare + R"(]}},
    {"type": "Feature", "properties": {}, "geometry": null}]})");
  EXPECT_EQ(fields.size(), 3U);
  ASSERT_EQ(skipped_.size(), 2U);
  EXPECT_NE(skipped_[0].find("features[1]: Point"), std::string::npos) << skipped_[0];
  EXPECT_NE(skipped_[1].find("features[3]"), std::string::npos) << skipped_[1];
}

TEST_F(CoverageCaseFile, IsRefusedWhereItIsWrong) {
  const auto feature = [](const std::string& properties, const std::string& coordinates) {
    return R"({"type": "Feature", "properties": )" + properties +
           R"(, "geometry": {"type": "Polygon", "coordinates": )" + coordinates + "}}";
  };
  EXPECT_NO_THROW(read(feature("{}", kSquare)));
  for (const std::string& content :
       {std::string(), std::string("<xml/>"), std::string(R"({"type": "FeatureCollection"})"),
        feature(R"({"swath_width": "wide"})", kSquare), feature(R"({"start": [1, 2]})", kSquare),
        feature(R"({"vehicle": {"width": "wide"}})", kSquare), feature("{}", "[]"), feature("{}", "[[[0, 0], [1]]]"),
        feature("{}", R"([[["a", 0], [1, 2]]])")}) {
    EXPECT_THROW(read(content), std::runtime_error) << content;
  }
  EXPECT_THROW(readCoverageCases("/no/such/file.geojson", &skipped_), std::runtime_error);
}

TEST_F(CoverageCaseFile, IsReadAsItWasWritten) {
  const CoverageCase made = makeFields(1, 0).front();
  writeCoverageCase(made, file());
  const auto fields = readCoverageCases(file(), &skipped_);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].name, made.name);
  EXPECT_EQ(fields[0].rings, made.rings);
  EXPECT_EQ(fields[0].swath_width, made.swath_width);
  EXPECT_EQ(fields[0].start->heading, made.start->heading);
  EXPECT_EQ(fields[0].vehicle.min_turning_radius, made.vehicle.min_turning_radius);
}

TEST(MadeFields, AreTheSameForTheSameSeed) {
  const auto some = makeFields(7, 6), same = makeFields(7, 6), others = makeFields(8, 6);
  ASSERT_EQ(some.size(), same.size());
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i].rings, same[i].rings) << some[i].name;
  EXPECT_NE(some.back().rings, others.back().rings);
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
