// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_callback_helper.h>
#include <ros/service_traits.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/shown_text.h"

namespace trident::slam {

/// A failed answer as TCPROS has it: a zero, the length of a text, the text. roscpp itself sends an
/// empty text, so that callers would not learn why a request was refused.
inline ros::SerializedMessage failed_answer(const std::string& text) {
  const auto length = static_cast<std::uint32_t>(text.size());
  ros::SerializedMessage message;
  message.num_bytes = 1 + sizeof(length) + text.size();
  message.buf.reset(new std::uint8_t[message.num_bytes]);
  ros::serialization::OStream stream(message.buf.get(),
                                     static_cast<std::uint32_t>(message.num_bytes));
  stream.next(std::uint8_t{0});
  stream.next(text);
  return message;
}

/// Answers a service; an Error's text reaches the caller.
template <class Service>
class ErrorReportingService : public ros::ServiceCallbackHelper {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Answer = std::function<void(Request&, Response&)>;

  /// `failed` is called for each request that fails.
  ErrorReportingService(Answer answer, std::function<void(const std::string&)> failed)
      : answer_(std::move(answer)), failed_(std::move(failed)) {}

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    Request request;
    Response response;
    try {
      ros::serialization::deserializeMessage(params.request, request);
      answer_(request, response);
      params.response = ros::serialization::serializeServiceResponse(true, response);
    } catch (const Error& error) {
      const std::string text = with_short_words(error.what());
      failed_(text);
      params.response = failed_answer(text);
    }
    // True: the response is sent as it stands.
    return true;
  }

 private:
  Answer answer_;
  std::function<void(const std::string&)> failed_;
};

/// What advertises such a service.
template <class Service>
ros::AdvertiseServiceOptions error_reporting_service(
    const std::string& name, typename ErrorReportingService<Service>::Answer answer,
    std::function<void(const std::string&)> failed) {
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = ros::service_traits::MD5Sum<Service>::value();
  options.datatype = ros::service_traits::DataType<Service>::value();
  options.req_datatype = ros::message_traits::DataType<typename Service::Request>::value();
  options.res_datatype = ros::message_traits::DataType<typename Service::Response>::value();
  options.helper =
      boost::make_shared<ErrorReportingService<Service>>(std::move(answer), std::move(failed));
  return options;
}

}  // namespace trident::slam
