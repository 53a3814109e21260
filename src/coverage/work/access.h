// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coverage/field/field.h"
#include "coverage/path/curve.h"

namespace external_command {

/// The part of a line that the vehicle gets to and away from without reversing: there is room for half a circle to one
/// side, before it and after it. The whole of it for a vehicle that may reverse, or where there is no such part.
Curve accessiblePart(const Field& field, const Curve& line);

}  // namespace external_command
