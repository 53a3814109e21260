// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

// Of our own: what catkin_add_gtest links against has a main() on some systems only.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
