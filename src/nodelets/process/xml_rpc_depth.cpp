// SPDX-License-Identifier: Apache-2.0
// ROS' XML-RPC server, which every node has, calls itself for each value within a value: who sends a call of a hundred
// thousand nested ones ends the process, and one of twenty thousand keeps the server busy for a quarter of a minute.
// What a program defines comes before what its libraries do, so this serves in the programs that it is linked into.
#include <dlfcn.h>
#include <xmlrpcpp/XmlRpcServerConnection.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "external_command/core/text.h"

namespace {

constexpr std::size_t kMost = 100;  ///< nested values; ROS' own calls have a handful, parameters as many as their keys

std::size_t depthOf(const std::string& call) {
  const std::string opening = "<value>", closing = "</value>";
  std::size_t depth = 0, most = 0;
  for (std::size_t at = call.find('<'); at != std::string::npos; at = call.find('<', at + 1)) {
    if (call.compare(at, opening.size(), opening) == 0) most = std::max(most, ++depth);
    if (depth > 0 && call.compare(at, closing.size(), closing) == 0) --depth;
  }
  return most;
}

}  // namespace

void XmlRpc::XmlRpcServerConnection::executeRequest() {
  using Execute = void (*)(XmlRpcServerConnection*);
  static const auto execute =
      reinterpret_cast<Execute>(::dlsym(RTLD_NEXT, "_ZN6XmlRpc22XmlRpcServerConnection14executeRequestEv"));
  const std::size_t depth = depthOf(_request);
  if (depth > kMost) {
    generateFaultResponse(external_command::text("the call nests ", depth, " values; the limit is ", kMost));
  } else if (execute != nullptr) {
    execute(this);
  } else {
    generateFaultResponse("calls cannot be carried out: the function that does so was not found");
  }
}
