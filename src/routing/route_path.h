// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "section_memory.h"

namespace external_command {

/// See referencePath(), which it is but for the memory.
/// @param memory  nullptr: everything is computed.
ReferencePath routePath(const PathMaking& making, const Route& route, const ReferencePathQuery& query,
                        SectionMemory* memory);

}  // namespace external_command
