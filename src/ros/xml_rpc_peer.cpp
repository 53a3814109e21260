// SPDX-License-Identifier: Apache-2.0
#include "xml_rpc_peer.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcException.h>

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;

class Client : public XmlRpc::XmlRpcClient {
 public:
  using XmlRpcClient::XmlRpcClient;

  XmlRpcPeer::Outcome run(const std::string& method, const XmlRpcValue& request, double timeout,
                          XmlRpcValue* response) {
    using Outcome = XmlRpcPeer::Outcome;
    if (!executeNonBlock(method.c_str(), request)) return Outcome::kUnreachable;
    _disp.work(timeout);
    if (_connectionState == NO_CONNECTION || _connectionState == CONNECTING) return Outcome::kUnreachable;
    if (_connectionState == WRITE_REQUEST) return _bytesWritten > 0 ? Outcome::kSilent : Outcome::kUnreachable;
    if (!executeCheckDone(*response) || isFault()) return Outcome::kSilent;
    return Outcome::kSuccess;
  }
};

/// A copy of it, since in roscpp of Ubuntu 20.04 its conversions are not const.
template <class T>
T valueOr(XmlRpcValue value, XmlRpcValue::Type type, const T& otherwise) {
  return value.getType() == type ? static_cast<T&>(value) : otherwise;
}

}  // namespace

XmlRpcPeer::XmlRpcPeer(const std::string& uri, double timeout) : timeout_(timeout) {
  if (!ros::network::splitURI(uri, host_, port_)) host_.clear();
}

XmlRpcPeer::Answer XmlRpcPeer::call(const std::string& method, std::initializer_list<XmlRpcValue> arguments) const {
  Answer answer;
  if (host_.empty()) return answer;
  XmlRpcValue request;
  int count = 0;
  request[count++] = ros::this_node::getName();
  for (const XmlRpcValue& argument : arguments) request[count++] = argument;
  try {
    Client client(host_.c_str(), static_cast<int>(port_), "/");
    XmlRpcValue response;
    answer.outcome = client.run(method, request, timeout_, &response);
    client.close();
    if (!answer.isSuccess()) return answer;
    // [1, "a message", payload]; another code tells of a failure
    if (response.getType() != XmlRpcValue::TypeArray || response.size() != 3 ||
        response[0].getType() != XmlRpcValue::TypeInt) {
      answer.outcome = Outcome::kSilent;
      return answer;
    }
    if (static_cast<int>(response[0]) != 1) answer.outcome = Outcome::kRefused;
    answer.value = response[2];
  } catch (const XmlRpc::XmlRpcException&) {
    answer.outcome = Outcome::kSilent;
  }
  return answer;
}

XmlRpcPeer rosMaster() { return XmlRpcPeer(ros::master::getURI()); }

std::string textOf(const XmlRpcValue& value) { return valueOr(value, XmlRpcValue::TypeString, std::string()); }

int numberOf(const XmlRpcValue& value, int otherwise) { return valueOr(value, XmlRpcValue::TypeInt, otherwise); }

bool truthOf(const XmlRpcValue& value, bool otherwise) { return valueOr(value, XmlRpcValue::TypeBoolean, otherwise); }

}  // namespace external_command
