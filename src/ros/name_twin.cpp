// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/name_twin.h"

#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>

#include "external_command/core/text.h"
#include "registrations.h"

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;

bool publishesAnyOf(const Registrations& registered, const XmlRpcValue& publications) {
  bool any = false;
  forEachItem(publications, [&](const XmlRpcValue& item) {
    if (item.getType() == XmlRpcValue::TypeArray && item.size() > 0) {
      any |= registered.publications.count(textOf(item[0])) != 0;
    }
  });
  return any;
}

/// Does the node that answers publish what the master says that our name publishes? Every node has /rosout.
bool isWhoTheMasterMeans(const XmlRpcPeer& node, const XmlRpcPeer& master) {
  auto registered = registeredBy(ros::this_node::getName(), master);
  if (!registered) return true;
  registered->publications.erase("/rosout");
  return registered->publications.empty() || publishesAnyOf(*registered, node.call("getPublications").value);
}

}  // namespace

std::string describeNameTwin() {
  const XmlRpcPeer master = rosMaster();
  const std::string uri = textOf(master.call("lookupNode", {ros::this_node::getName()}).value);
  if (uri.empty() || uri == ros::XMLRPCManager::instance()->getServerURI()) return "";
  const XmlRpcPeer node(uri, 3.0);
  const XmlRpcPeer::Answer pid = node.call("getPid");
  if (pid.outcome == XmlRpcPeer::Outcome::kUnreachable) return "";
  if (pid.outcome == XmlRpcPeer::Outcome::kSilent) return text("at ", uri, ", which does not answer; is it suspended?");
  if (!isWhoTheMasterMeans(node, master)) return "";
  return text("process ", numberOf(pid.value, 0), " on ", node.host());
}

}  // namespace external_command
