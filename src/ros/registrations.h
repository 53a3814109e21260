// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "xml_rpc_peer.h"

namespace external_command {

/// What a node has at the master.
struct Registrations {
  std::map<std::string, std::string> publications;   ///< topic -> type; the master's own lists have no types
  std::map<std::string, std::string> subscriptions;  ///< the same
  std::set<std::string> services;

  bool areNone() const { return publications.empty() && subscriptions.empty() && services.empty(); }
  std::size_t count() const { return publications.size() + subscriptions.size() + services.size(); }
};

/// What the master knows of the node `name`; nullopt where it does not answer.
std::optional<Registrations> registeredBy(const std::string& name, const XmlRpcPeer& master);

/// The topics of this process, with their types, and those of `services` that it advertises.
Registrations presentOf(const std::set<std::string>& services);

/// What of `present` is not in `registered`.
Registrations missing(const Registrations& present, const Registrations& registered);

/// What is in both.
Registrations common(const Registrations& a, const Registrations& b);

/// Registers all of `lost`, and connects its subscribers to the publishers that the master knows. Connections there
/// are stay. @return false where the master did not take something.
bool registerAgain(const Registrations& lost, const XmlRpcPeer& master);

}  // namespace external_command
