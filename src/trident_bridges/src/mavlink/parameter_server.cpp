// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/parameter_server.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "mavlink/parameter_messages.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::mavlink {
namespace {

template <class Number>
float bytes_as_float(double value) {
  const double lowest = std::numeric_limits<Number>::lowest();
  const double highest = std::numeric_limits<Number>::max();
  const auto number = static_cast<Number>(std::clamp(std::round(value), lowest, highest));
  float field = 0.0F;
  std::memcpy(&field, &number, sizeof number);
  return field;
}

template <class Number>
double bytes_of_float(float field) {
  Number number;
  std::memcpy(&number, &field, sizeof number);
  return number;
}

bool is_whole(ParameterType type) { return type != ParameterType::kReal32; }

}  // namespace

float encode_parameter(double value, ParameterType type, ParameterEncoding encoding) {
  if (encoding == ParameterEncoding::kCast) return static_cast<float>(value);
  switch (type) {
    case ParameterType::kUint8:
      return bytes_as_float<std::uint8_t>(value);
    case ParameterType::kInt8:
      return bytes_as_float<std::int8_t>(value);
    case ParameterType::kUint16:
      return bytes_as_float<std::uint16_t>(value);
    case ParameterType::kInt16:
      return bytes_as_float<std::int16_t>(value);
    case ParameterType::kUint32:
      return bytes_as_float<std::uint32_t>(value);
    case ParameterType::kInt32:
      return bytes_as_float<std::int32_t>(value);
    case ParameterType::kReal32:
      break;
  }
  return static_cast<float>(value);
}

double decode_parameter(float field, ParameterType type, ParameterEncoding encoding) {
  const bool is_cast = encoding == ParameterEncoding::kCast;
  switch (type) {
    case ParameterType::kUint8:
      return is_cast ? field : bytes_of_float<std::uint8_t>(field);
    case ParameterType::kInt8:
      return is_cast ? field : bytes_of_float<std::int8_t>(field);
    case ParameterType::kUint16:
      return is_cast ? field : bytes_of_float<std::uint16_t>(field);
    case ParameterType::kInt16:
      return is_cast ? field : bytes_of_float<std::int16_t>(field);
    case ParameterType::kUint32:
      return is_cast ? field : bytes_of_float<std::uint32_t>(field);
    case ParameterType::kInt32:
      return is_cast ? field : bytes_of_float<std::int32_t>(field);
    case ParameterType::kReal32:
      return field;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ParameterServer::ParameterServer(Address self, MessageSink send, ParameterEncoding encoding,
                                 std::vector<Parameter> parameters, ParameterServerEvents events)
    : self_(self),
      send_(std::move(send)),
      encoding_(encoding),
      parameters_(std::move(parameters)),
      events_(std::move(events)),
      next_(parameters_.size()) {
  std::set<std::string> names;
  for (const Parameter& parameter : parameters_) {
    if (parameter.name.empty() || parameter.name.size() > kMaxParameterName) {
      throw Error("parameter '" + parameter.name + "': a name of " +
                  std::to_string(parameter.name.size()) + " characters, legal: 1 to 16");
    }
    if (!names.insert(parameter.name).second) {
      throw Error("parameter '" + parameter.name + "' is listed twice");
    }
  }
}

const Parameter* ParameterServer::find(const std::string& name) const {
  const auto it = std::find_if(parameters_.begin(), parameters_.end(),
                               [&](const Parameter& one) { return one.name == name; });
  return it == parameters_.end() ? nullptr : &*it;
}

void ParameterServer::set(const std::string& name, double value) {
  const Parameter* known = find(name);
  if (known == nullptr) throw Error("there is no parameter '" + name + "'");
  if (!(value >= known->min && value <= known->max)) {
    throw Error("parameter " + name + " = " + number_text(value) +
                ", legal: " + number_text(known->min) + " to " + number_text(known->max));
  }
  const auto index = static_cast<std::size_t>(known - parameters_.data());
  parameters_[index].value = is_whole(known->type) ? std::round(value) : value;
  send_value(index);
}

bool ParameterServer::handle(const Message& message, SimTime now) {
  if (unpack_if_for<mavlink_param_request_list_t>(message, self_)) {
    next_ = 0;
    next_due_ = now;
    return true;
  }
  if (const auto payload = unpack_if_for<mavlink_param_request_read_t>(message, self_)) {
    on_read(parameter_name(payload->param_id), payload->param_index);
    return true;
  }
  if (const auto payload = unpack_if_for<mavlink_param_set_t>(message, self_)) {
    on_set(parameter_name(payload->param_id), payload->param_value, payload->param_type);
    return true;
  }
  return false;
}

void ParameterServer::update(SimTime now) {
  for (; next_ < parameters_.size() && next_due_ <= now; ++next_) {
    send_value(next_);
    next_due_ = next_due_ + SimTime::from_seconds(1.0 / kListRate_hz);
  }
}

/// An unknown name or index is not answered: the partner asks for what other firmware has.
void ParameterServer::on_read(const std::string& name, int index) {
  if (index >= 0) {
    if (static_cast<std::size_t>(index) < parameters_.size()) {
      send_value(static_cast<std::size_t>(index));
    }
    return;
  }
  if (const Parameter* known = find(name)) {
    send_value(static_cast<std::size_t>(known - parameters_.data()));
  }
}

void ParameterServer::on_set(const std::string& name, float field, std::uint8_t type) {
  const Parameter* known = find(name);
  if (known == nullptr) return refuse("parameter '" + name + "' is not known");
  // With their own encodings partners may name another type: ArduPilot's ignore it.
  const ParameterType as =
      encoding_ == ParameterEncoding::kCast ? known->type : static_cast<ParameterType>(type);
  const double value = decode_parameter(field, as, encoding_);
  const auto index = static_cast<std::size_t>(known - parameters_.data());
  try {
    set(name, value);
    if (events_.changed) events_.changed(parameters_[index]);
  } catch (const Error& error) {
    send_value(index);  // The partner sees that the old value stays.
    refuse(error.what());
  }
}

void ParameterServer::send_value(std::size_t index) {
  const Parameter& parameter = parameters_[index];
  mavlink_param_value_t payload{};
  put_parameter_name(parameter.name, payload.param_id);
  payload.param_type = static_cast<std::uint8_t>(parameter.type);
  payload.param_value = encode_parameter(parameter.value, parameter.type, encoding_);
  payload.param_count = static_cast<std::uint16_t>(parameters_.size());
  payload.param_index = static_cast<std::uint16_t>(index);
  send_(pack(payload, self_));
}

void ParameterServer::refuse(const std::string& reason) {
  if (events_.refused) events_.refused(reason);
}

}  // namespace trident::bridges::mavlink
