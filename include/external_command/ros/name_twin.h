// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// Another process that runs under this node's name at the master, described for a person; empty where there is none.
/// A node that died without a word, and whose name is still at the master, is none, even where its port is another
/// node's by now. To be asked before this process registers anything: the master ends the older of two of one name, and
/// where something starts that one again, the two end each other for ever. Takes some seconds at most.
std::string describeNameTwin();

}  // namespace external_command
