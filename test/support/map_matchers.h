// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "external_command/map/hd_map.h"

namespace external_command {

/// Every field of both, exactly, and what is found by ids, roads and places all over them.
testing::AssertionResult sameMap(const HdMap& a, const HdMap& b);

}  // namespace external_command
