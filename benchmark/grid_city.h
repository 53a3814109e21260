// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/map/map_data.h"

namespace external_command {

/// A made-up city for measurements: square blocks of 150 m, between them streets with two lanes each way, and at every
/// crossing ways straight on, to the right from the right lane and to the left from the left lane. Some 24 lanes per
/// crossing.
MapData gridCity(int crossings_per_side);

}  // namespace external_command
