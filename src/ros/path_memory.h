// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "external_command/ros/process_context.h"
#include "external_command/routing/reference_paths.h"

namespace external_command {

/// What makes the reference paths of `context`, which has a map: the same one for all contexts of this process that
/// have that map, vehicle and parameters in common. Lives as long as one of them.
std::shared_ptr<const ReferencePaths> referencePathsOf(const ProcessContext& context);

/// To be called when `context` ends.
void forgetReferencePathsOf(const ProcessContext& context);

}  // namespace external_command
