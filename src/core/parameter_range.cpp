// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/parameter_range.h"

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

void requireParameter(const std::string& key, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  const std::string upper = high == M_PI ? "pi" : text(high);
  throw InvalidParameter(text(key, " is ", value, "; it must lie in [", low, ", ", upper, "]"));
}

}  // namespace external_command
