// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <set>
#include <string>
#include <vector>

namespace external_command {

/// A key that is set, and that nobody asks for.
struct StrayKey {
  std::string key;      ///< below the namespace, "vehicle/weelbase"
  std::string nearest;  ///< the known key that was probably meant; empty where none is near
};

/// The keys of `tree`, a namespace's parameters, that are not in `known`. A dictionary of which nothing is known counts
/// as one key.
std::vector<StrayKey> strayKeys(const XmlRpc::XmlRpcValue& tree, const std::set<std::string>& known);

/// Notes that this process knows the parameter of that full name, set or not. Thread-safe.
void noteKnownParameter(const std::string& name);

/// Warns of each parameter below `ns` that no ParameterReader of this process has asked for. To be called when all that
/// is read there has been read. Thread-safe.
void warnOfStrayParameters(const std::string& ns);

}  // namespace external_command
