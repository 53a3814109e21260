// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// @param key  the parameter's name, "vehicle/width".
/// @throws InvalidParameter  `value` does not lie in [low, high], or is not a number.
void requireParameter(const std::string& key, double value, double low, double high);

}  // namespace external_command
