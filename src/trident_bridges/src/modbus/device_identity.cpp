// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/device_identity.h"

#include <utility>

#include "trident_base/error.h"
#include "trident_bridges/modbus/response.h"

namespace trident::bridges::modbus {
namespace {

constexpr std::size_t kLongestText = 240;
constexpr int kLastBasicObject = 2;
constexpr std::uint8_t kOneObject = 4;             // read device id code
constexpr std::uint8_t kBasicWithAccess = 0x81;    // conformity: stream and individual access
constexpr std::uint8_t kRegularWithAccess = 0x82;  // the same with objects 3 to 6
constexpr std::uint8_t kMoreFollows = 0xFF;

using Objects = std::map<int, std::string>;

Objects objects_of(const DeviceIdentity& identity) {
  Objects objects{{0, identity.vendor}, {1, identity.product_code}, {2, identity.revision}};
  const std::pair<int, const std::string&> regular[] = {
      {3, identity.url}, {4, identity.product}, {5, identity.model}, {6, identity.application}};
  for (const auto& [number, text] : regular) {
    if (!text.empty()) objects[number] = text;
  }
  return objects;
}

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The object that a response begins with; the end: it alone is asked for and does not exist.
Objects::const_iterator first_object(const Objects& objects, const Request& request, int last) {
  const auto asked = objects.find(request.object_id);
  if (asked != objects.end() && asked->first <= last) return asked;
  return request.device_id_code == kOneObject ? objects.end() : objects.begin();
}

/// Objects up to the last, as far as there is space, behind three bytes: whether more follows, the
/// next object, the number of objects.
void append_objects(const Objects& objects, Objects::const_iterator object, int last, Pdu& pdu) {
  const std::size_t more = pdu.size();
  pdu.append_zeros(3);
  for (; object != objects.end() && object->first <= last; ++object) {
    if (pdu.space() < object->second.size() + 2) {
      pdu[more] = kMoreFollows;
      pdu[more + 1] = static_cast<std::uint8_t>(object->first);
      return;
    }
    pdu.byte(static_cast<std::uint8_t>(object->first));
    pdu.byte(static_cast<std::uint8_t>(object->second.size()));
    pdu.append(bytes_of(object->second));
    ++pdu[more + 2];
  }
}

}  // namespace

void DeviceIdentity::validate() const {
  for (const std::string* text :
       {&vendor, &product_code, &revision, &url, &product, &model, &application}) {
    if (text->size() > kLongestText) {
      throw Error("a text of " + std::to_string(text->size()) + " bytes, legal: up to 240");
    }
  }
}

Pdu device_id_response(const DeviceIdentity& identity, const Request& request) {
  const Objects objects = objects_of(identity);
  const bool is_regular = objects.rbegin()->first > kLastBasicObject;
  const std::uint8_t code = request.device_id_code;
  const int last = code == 1 ? kLastBasicObject : objects.rbegin()->first;
  const auto object = first_object(objects, request, last);
  if (object == objects.end()) {
    return exception_response(request.function, ExceptionCode::kIllegalAddress);
  }
  Pdu pdu(request.function);
  for (const std::uint8_t byte :
       {kDeviceIdType, code, is_regular ? kRegularWithAccess : kBasicWithAccess}) {
    pdu.byte(byte);
  }
  append_objects(objects, object, code == kOneObject ? object->first : last, pdu);
  return pdu;
}

DeviceIdObjects decode_device_id(Bytes values) {
  constexpr std::size_t kHeader = 5;  // code, conformity, more follows, next object, number
  const auto fail = [](std::size_t at) -> Error {
    return Error("device identification ends within an object, at byte " + std::to_string(at));
  };
  if (values.size() < kHeader) throw fail(values.size());
  DeviceIdObjects result;
  result.more_follows = values[2] == kMoreFollows;
  result.next = values[3];
  std::size_t at = kHeader;
  for (int i = 0; i < values[4]; ++i) {
    if (at + 2 > values.size() || at + 2 + values[at + 1] > values.size()) throw fail(at);
    const Bytes text = values.subspan(at + 2, values[at + 1]);
    result.objects[values[at]].assign(text.begin(), text.end());
    at += 2 + text.size();
  }
  return result;
}

}  // namespace trident::bridges::modbus
