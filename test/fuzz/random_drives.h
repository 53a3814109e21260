// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <random>

#include "external_command/map/hd_map.h"

namespace external_command {

/// Looks for the lanes near random places of a map, plans a few routes between them, and makes their reference paths.
/// Refusals are fine. The random numbers depend on `random` only.
/// @return  how many paths were made.
/// @throws InternalError  no request may end so, and no other exception is expected.
std::size_t driveAbout(const std::shared_ptr<const HdMap>& map, std::mt19937* random);

}  // namespace external_command
