// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "external_command/core/error.h"

namespace external_command {

/// The text of the InvalidRequest that a call ends with; empty where it ends with none.
template <class Call>
std::string refusalOf(const Call& call) {
  try {
    call();
  } catch (const InvalidRequest& refused) {
    return refused.what();
  }
  return "";
}

}  // namespace external_command
