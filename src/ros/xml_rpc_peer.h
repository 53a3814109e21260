// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <initializer_list>
#include <string>

namespace external_command {

/// An XML-RPC server of ROS: the master, or a node. Each call has a time limit; roscpp's own calls wait for ever for
/// one that hangs. Thread-safe.
class XmlRpcPeer {
 public:
  enum class Outcome {
    kSuccess,      ///< `value` is the payload
    kRefused,      ///< it answered that it cannot
    kSilent,       ///< it took the connection, but did not answer in time, or not in XML-RPC
    kUnreachable,  ///< nobody listens there
  };
  struct Answer {
    Outcome outcome = Outcome::kUnreachable;
    XmlRpc::XmlRpcValue value;
    bool isSuccess() const { return outcome == Outcome::kSuccess; }
  };

  /// @param uri      "http://host:port/"
  /// @param timeout  of each call [s].
  explicit XmlRpcPeer(const std::string& uri, double timeout = 2.0);

  /// The name of this node goes first, as in all calls of ROS.
  Answer call(const std::string& method, std::initializer_list<XmlRpc::XmlRpcValue> arguments = {}) const;

  const std::string& host() const { return host_; }

 private:
  std::string host_;
  std::uint32_t port_ = 0;
  const double timeout_;
};

/// The master of this process.
XmlRpcPeer rosMaster();

/// The texts of an XML-RPC list; what is no text is left out.
template <class Visit>
void forEachItem(const XmlRpc::XmlRpcValue& list, const Visit& visit) {
  if (list.getType() != XmlRpc::XmlRpcValue::TypeArray) return;
  for (int i = 0; i < list.size(); ++i) visit(list[i]);
}

/// The text, or "" where it is none.
std::string textOf(const XmlRpc::XmlRpcValue& value);

/// The number or truth value, or `otherwise` where it is none.
int numberOf(const XmlRpc::XmlRpcValue& value, int otherwise);
bool truthOf(const XmlRpc::XmlRpcValue& value, bool otherwise);

}  // namespace external_command
