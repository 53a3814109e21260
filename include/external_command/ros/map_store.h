// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "external_command/map/map_reader.h"
#include "external_command/routing/router.h"

namespace external_command {

/// The router over the map of `file`, read once per process however many ask: the first caller loads it, others wait.
/// Forgotten when nobody holds it any more. Logs the map's warnings. Thread-safe.
/// @throws MapError  the file cannot be used.
std::shared_ptr<const Router> sharedRouter(const std::string& file, const MapOrigin& origin,
                                           const MapParams& map_params, const RouterParams& params);

}  // namespace external_command
