// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/parameter_check.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

using XmlRpc::XmlRpcValue;

const std::set<std::string> kKnown = {"map_file",   "vehicle/wheelbase", "vehicle/width", "routing/snap_distance",
                                      "processors", "scenarios/stop"};

std::string nearestTo(const std::string& key, XmlRpcValue tree) {
  for (const StrayKey& stray : strayKeys(tree, kKnown)) {
    if (stray.key == key) return stray.nearest;
  }
  return "it is not stray";
}

TEST(StrayKeys, AreNoneWhereEveryKeyIsKnown) {
  XmlRpcValue tree;
  tree["map_file"] = "a";
  tree["vehicle"]["wheelbase"] = 2.8;
  tree["scenarios"]["stop"][0] = "EMERGENCY_STOP";
  EXPECT_TRUE(strayKeys(tree, kKnown).empty());
  EXPECT_TRUE(strayKeys(XmlRpcValue(), kKnown).empty());
  EXPECT_TRUE(strayKeys(XmlRpcValue(3.0), kKnown).empty());
}

TEST(StrayKeys, NameTheKeyThatWasMeant) {
  XmlRpcValue tree;
  tree["map_fiel"] = "a";
  tree["vehicle"]["weelbase"] = 2.8;
  tree["vehicle"]["colour"] = "red";
  EXPECT_EQ(nearestTo("map_fiel", tree), "map_file");
  EXPECT_EQ(nearestTo("vehicle/weelbase", tree), "vehicle/wheelbase");
  EXPECT_EQ(nearestTo("vehicle/colour", tree), "");
}

TEST(StrayKeys, NameTheDictionaryThatAKeyBelongsTo) {
  XmlRpcValue tree;
  tree["snap_distnace"] = 1.0;
  EXPECT_EQ(nearestTo("snap_distnace", tree), "routing/snap_distance");
}

TEST(StrayKeys, CountAMisspeltDictionaryOnce) {
  XmlRpcValue tree;
  tree["vehicel"]["wheelbase"] = 2.8;
  tree["vehicel"]["width"] = 2.0;
  const auto stray = strayKeys(tree, kKnown);
  ASSERT_EQ(stray.size(), 1U);
  EXPECT_EQ(stray[0].key, "vehicel");
  EXPECT_EQ(stray[0].nearest, "vehicle");
}

}  // namespace
}  // namespace external_command
