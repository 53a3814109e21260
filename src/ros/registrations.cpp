// SPDX-License-Identifier: Apache-2.0
#include "registrations.h"

#include <ros/connection_manager.h>
#include <ros/network.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>

#include "external_command/core/text.h"

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;
using Topics = std::map<std::string, std::string>;

const std::string& ownUri() { return ros::XMLRPCManager::instance()->getServerURI(); }

/// This node's own server, whatever others have to call this machine.
XmlRpcPeer ownServer() {
  return XmlRpcPeer(text("http://127.0.0.1:", ros::XMLRPCManager::instance()->getServerPort(), "/"));
}

std::string serviceUri() {
  return text("rosrpc://", ros::network::getHost(), ":", ros::ConnectionManager::instance()->getTCPPort());
}

bool isAdvertised(const std::string& service) {
  return ros::ServiceManager::instance()->lookupServicePublication(service) != nullptr;
}

/// [[topic, type], ...] as this node's own server tells it.
Topics ownTopics(const std::string& method) {
  Topics topics;
  const XmlRpcPeer::Answer answer = ownServer().call(method);
  forEachItem(answer.value, [&](const XmlRpcValue& item) {
    if (item.getType() == XmlRpcValue::TypeArray && item.size() == 2) topics[textOf(item[0])] = textOf(item[1]);
  });
  return topics;
}

/// The names in [[name, [node, ...]], ...] that `node` stands beside.
std::set<std::string> namesOf(const XmlRpcValue& table, const std::string& node) {
  std::set<std::string> names;
  forEachItem(table, [&](const XmlRpcValue& row) {
    if (row.getType() != XmlRpcValue::TypeArray || row.size() != 2) return;
    forEachItem(row[1], [&](const XmlRpcValue& name) {
      if (textOf(name) == node) names.insert(textOf(row[0]));
    });
  });
  return names;
}

Topics withoutTypes(const std::set<std::string>& names) {
  Topics topics;
  for (const std::string& name : names) topics[name];
  return topics;
}

/// Publishers that this process is connected to: a new master may not know them, and yet they are there.
std::map<std::string, std::set<std::string>> connectedPublishers() {
  std::map<std::string, std::set<std::string>> publishers;
  const XmlRpcPeer::Answer answer = ownServer().call("getBusInfo");
  // [id, uri, "i" or "o", transport, topic, is connected, ...]
  forEachItem(answer.value, [&](const XmlRpcValue& link) {
    if (link.getType() != XmlRpcValue::TypeArray || link.size() < 6 || textOf(link[2]) != "i") return;
    if (!truthOf(link[5], true)) return;
    publishers[textOf(link[4])].insert(textOf(link[1]));
  });
  return publishers;
}

/// As the master does when a publisher comes.
void connect(const std::string& topic, std::set<std::string> uris, const XmlRpcValue& registered) {
  forEachItem(registered, [&](const XmlRpcValue& uri) { uris.insert(textOf(uri)); });
  XmlRpcValue list;
  list.setSize(0);
  int count = 0;
  for (const std::string& uri : uris) list[count++] = uri;
  ownServer().call("publisherUpdate", {topic, list});
}

template <class Container, class Keep>
void keepWhere(const Keep& keep, Container* container) {
  for (auto item = container->begin(); item != container->end();) {
    item = keep(*item) ? ++item : container->erase(item);
  }
}

template <class Keep>
Registrations filtered(Registrations all, const Registrations& other, const Keep& keep) {
  keepWhere([&](const auto& topic) { return keep(other.publications.count(topic.first)); }, &all.publications);
  keepWhere([&](const auto& topic) { return keep(other.subscriptions.count(topic.first)); }, &all.subscriptions);
  keepWhere([&](const auto& service) { return keep(other.services.count(service)); }, &all.services);
  return all;
}

}  // namespace

std::optional<Registrations> registeredBy(const std::string& name, const XmlRpcPeer& master) {
  const XmlRpcPeer::Answer answer = master.call("getSystemState");
  const XmlRpcValue& state = answer.value;  // [publishers, subscribers, services]
  if (!answer.isSuccess() || state.getType() != XmlRpcValue::TypeArray || state.size() != 3) return std::nullopt;
  return Registrations{withoutTypes(namesOf(state[0], name)), withoutTypes(namesOf(state[1], name)),
                       namesOf(state[2], name)};
}

Registrations presentOf(const std::set<std::string>& services) {
  Registrations present{ownTopics("getPublications"), ownTopics("getSubscriptions"), services};
  keepWhere(isAdvertised, &present.services);
  return present;
}

Registrations missing(const Registrations& present, const Registrations& registered) {
  return filtered(present, registered, [](std::size_t count) { return count == 0; });
}

Registrations common(const Registrations& a, const Registrations& b) {
  return filtered(a, b, [](std::size_t count) { return count != 0; });
}

bool registerAgain(const Registrations& lost, const XmlRpcPeer& master) {
  bool is_complete = true;
  for (const auto& [topic, type] : lost.publications) {
    is_complete &= master.call("registerPublisher", {topic, type, ownUri()}).isSuccess();
  }
  const auto connected = connectedPublishers();
  for (const auto& [topic, type] : lost.subscriptions) {
    const XmlRpcPeer::Answer answer = master.call("registerSubscriber", {topic, type, ownUri()});
    is_complete &= answer.isSuccess();
    const auto links = connected.find(topic);
    if (answer.isSuccess()) {
      connect(topic, links == connected.end() ? std::set<std::string>() : links->second, answer.value);
    }
  }
  for (const std::string& service : lost.services) {
    if (!isAdvertised(service)) continue;  // it has gone meanwhile
    is_complete &= master.call("registerService", {service, serviceUri(), ownUri()}).isSuccess();
  }
  return is_complete;
}

}  // namespace external_command
