// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/service_callback_helper.h>
#include <ros/service_traits.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <string>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/ros/request_limits.h"

namespace external_command {

/// How a service answers. Both are called on its callback queue.
template <class Service>
struct BoundedServiceCallbacks {
  using Request = typename Service::Request;
  using Response = typename Service::Response;

  /// @param header  of the connection.
  std::function<Response(const Request& request, const MessageSize& size, const ros::M_string& header)> answer;

  /// Nothing can be built from what came: called while the exception that tells why is being handled.
  std::function<Response(const ros::SerializedMessage& request, const ros::M_string& header)> refuse;
};

inline std::size_t lengthOf(const ros::SerializedMessage& request) {
  return request.num_bytes - static_cast<std::size_t>(request.message_start - request.buf.get());
}

/// Looks at the bytes of a request, its texts apart, before anything is built from them. roscpp believes what they say.
template <class Service>
class BoundedServiceHelper : public ros::ServiceCallbackHelper {
 public:
  using Callbacks = BoundedServiceCallbacks<Service>;
  using Response = typename Service::Response;

  BoundedServiceHelper(Callbacks callbacks, const RequestLimits& limits)
      : callbacks_(std::move(callbacks)), limits_(limits) {}

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    const Response response = answer(params.request, *params.connection_header);
    params.response = ros::serialization::serializeServiceResponse(true, response);
    return true;
  }

 private:
  Response answer(const ros::SerializedMessage& bytes, const ros::M_string& header) const {
    using Request = typename Service::Request;
    Request request;
    MessageSize size;
    try {
      size = sizeOfMessage<Request>(bytes.message_start, lengthOf(bytes));
      limits_.requireRequest(size, ros::message_traits::definition<Request>());
      ros::serialization::deserializeMessage(bytes, request);
    } catch (...) {
      return callbacks_.refuse(bytes, header);
    }
    return callbacks_.answer(request, size, header);
  }

  const Callbacks callbacks_;
  const RequestLimits limits_;
};

/// A service whose requests are bounded. The callback queue is left to be set.
template <class Service>
ros::AdvertiseServiceOptions boundedService(const std::string& name, BoundedServiceCallbacks<Service> callbacks,
                                            const RequestLimits& limits) {
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = ros::service_traits::md5sum<Service>();
  options.datatype = ros::service_traits::datatype<Service>();
  options.req_datatype = ros::message_traits::datatype<typename Service::Request>();
  options.res_datatype = ros::message_traits::datatype<typename Service::Response>();
  options.helper = boost::make_shared<BoundedServiceHelper<Service>>(std::move(callbacks), limits);
  return options;
}

}  // namespace external_command
