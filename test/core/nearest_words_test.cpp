// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/nearest_words.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

using Words = std::vector<std::string>;

TEST(NearestWords, OfferWhatAMistypedWordWasMeantToBe) {
  const Words known = {"n_out_4", "n_out_5", "s_out_5", "lane_26"};
  EXPECT_EQ(didYouMean("n_out5", known), "; did you mean 'n_out_5'?") << "a letter left out";
  EXPECT_EQ(didYouMean("n_outt_5", known), "; did you mean 'n_out_5'?") << "one too many";
  EXPECT_EQ(didYouMean("n_uot_5", known), "; did you mean 'n_out_5'?") << "two swapped";
  EXPECT_EQ(didYouMean("lame_26", known), "; did you mean 'lane_26'?") << "one replaced";
  EXPECT_EQ(didYouMean("LANE_26", known), "; did you mean 'lane_26'?") << "another case";
}

TEST(NearestWords, OfferAllThatAreEquallyNearButNotMoreThanThree) {
  const Words known = {"lane_1", "lane_2", "lane_3", "lane_4", "road_1"};
  EXPECT_EQ(didYouMean("lane_1x", Words{"lane_12", "lane_1"}), "; did you mean 'lane_12' or 'lane_1'?");
  EXPECT_EQ(didYouMean("road_2", Words{"road_1", "road_1"}), "; did you mean 'road_1'?") << "each once";
  EXPECT_EQ(didYouMean("lane_9", known), "; did you mean 'lane_1', 'lane_2' or 'lane_3'?");
}

TEST(NearestWords, OfferNothingThatIsNotLikeIt) {
  const Words known = {"main_street", "p3", ""};
  EXPECT_EQ(didYouMean("no_such_road", known), "");
  EXPECT_EQ(didYouMean("q7", known), "");
  EXPECT_EQ(didYouMean("", known), "");
  EXPECT_EQ(didYouMean("main_street", Words{}), "");
}

TEST(NearestWords, DoNotCompareEndlessWords) {
  const std::string endless(100000, 'a');
  EXPECT_EQ(didYouMean(endless, Words{endless, "a"}), "");
  EXPECT_EQ(didYouMean("a", Words{endless}), "");
}

}  // namespace
}  // namespace external_command
