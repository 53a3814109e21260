// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field.h"
#include "routes.h"
#include "work.h"

namespace external_command {

/// One piece of work in the order in which it is done, and which of its ways is taken.
struct Step {
  std::size_t work = 0;
  std::size_t way = 0;
};

/// A short tour through all of `works`, from the field's start if it has one: the laps along the border before or after
/// the swaths, rings around holes where they cost least.
std::vector<Step> orderOf(const Field& field, const std::vector<Work>& works, Routes* routes);

}  // namespace external_command
