// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "external_command/routing/router.h"
#include "external_command/routing/router_cache.h"

namespace external_command {

/// The router over a map file, made once per process however many ask: the first caller loads it, others wait. A large
/// one comes from the cache where that fits; else it is kept there by a thread of low priority, which ends with the
/// router. Forgotten when nobody holds it any more. Logs the map's warnings, and why the cache was not used.
/// Thread-safe.
/// @param cache_folder  empty: nothing is kept.
/// @throws MapError  the file cannot be used.
std::shared_ptr<const Router> sharedRouter(const RouterSource& source, const std::string& cache_folder);

}  // namespace external_command
