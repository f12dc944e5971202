// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/response.h"

#include <gtest/gtest.h>

#include "bytes_of_text.h"
#include "trident_base/error.h"
#include "trident_bridges/modbus/device_identity.h"

namespace trident::bridges::modbus {
namespace {

using Kind = Response::Kind;

Kind kind_of(const std::string& request_hex, const std::string& response_hex) {
  const auto request = bytes_of(request_hex), response = bytes_of(response_hex);
  return decode_response(decode_request(request).request, response).kind;
}

TEST(Response, TheProtocolsExamplesAnswerTheirRequests) {
  const char* const pairs[][2] = {
      {"01 00 13 00 13", "01 03 CD 6B 05"},
      {"02 00 C4 00 16", "02 03 AC DB 35"},
      {"03 00 6B 00 03", "03 06 02 2B 00 00 00 64"},
      {"04 00 08 00 01", "04 02 00 0A"},
      {"05 00 AC FF 00", "05 00 AC FF 00"},
      {"06 00 01 00 03", "06 00 01 00 03"},
      {"0F 00 13 00 0A 02 CD 01", "0F 00 13 00 0A"},
      {"10 00 01 00 02 04 00 0A 01 02", "10 00 01 00 02"},
      {"16 00 04 00 F2 00 25", "16 00 04 00 F2 00 25"},
      {"17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
       "17 0C 00 FE 0A CD 00 01 00 03 00 0D 00 FF"},
      {"2B 0E 01 00", "2B 0E 01 01 00 00 01 00 02 41 42"},
  };
  for (const auto& [request, response] : pairs) {
    EXPECT_EQ(kind_of(request, response), Kind::kDone) << request;
  }
}

TEST(Response, TheValuesOfAReadAreThoseOnTheWire) {
  const auto request = bytes_of("03 00 6B 00 03"), pdu = bytes_of("03 06 02 2B 00 00 00 64");
  EXPECT_EQ(hex_of(decode_response(decode_request(request).request, pdu).values),
            "02 2B 00 00 00 64");
}

TEST(Response, AnExceptionCarriesItsCode) {
  const auto request = bytes_of("03 00 6B 00 03"), pdu = bytes_of("83 02");
  const Response response = decode_response(decode_request(request).request, pdu);
  EXPECT_EQ(response.kind, Kind::kException);
  EXPECT_EQ(response.exception, ExceptionCode::kIllegalAddress);
  EXPECT_EQ(
      hex_of(exception_response(Function::kReadHoldingRegisters, ExceptionCode::kIllegalAddress)
                 .bytes()),
      "83 02");
}

TEST(Response, WhatAnswersAnotherRequestIsMalformed) {
  const char* const pairs[][2] = {
      {"03 00 6B 00 03", ""},
      {"03 00 6B 00 03", "03"},
      {"03 00 6B 00 03", "04 06 02 2B 00 00 00 64"},
      {"03 00 6B 00 03", "03 04 02 2B 00 00"},
      {"03 00 6B 00 03", "03 06 02 2B 00 00 00"},
      {"03 00 6B 00 03", "83"},
      {"03 00 6B 00 03", "83 02 00"},
      {"06 00 01 00 03", "06 00 02 00 03"},
      {"06 00 01 00 03", "06 00 01 00 04"},
      {"10 00 01 00 02 04 00 0A 01 02", "10 00 01 00 01"},
      {"2B 0E 01 00", "2B 0E 01"},
  };
  for (const auto& [request, response] : pairs) {
    EXPECT_EQ(kind_of(request, response), Kind::kMalformed) << request << " / " << response;
  }
}

Request id_request(std::uint8_t code, std::uint8_t object) {
  Request request;
  request.function = Function::kReadDeviceIdentification;
  request.device_id_code = code;
  request.object_id = object;
  return request;
}

/// The objects that a client collects that asks until nothing follows.
std::map<int, std::string> collected(const DeviceIdentity& identity, std::uint8_t code) {
  std::map<int, std::string> result;
  std::uint8_t next = 0;
  for (int round = 0; round < 10; ++round) {
    const Request request = id_request(code, next);
    const Pdu pdu = device_id_response(identity, request);
    const DeviceIdObjects part = decode_device_id(decode_response(request, pdu.bytes()).values);
    result.insert(part.objects.begin(), part.objects.end());
    if (!part.more_follows) return result;
    next = part.next;
  }
  ADD_FAILURE() << "more follows without end";
  return result;
}

TEST(DeviceIdentification, ABasicStreamHasTheFirstThreeObjects) {
  DeviceIdentity identity;
  identity.model = "Otter";
  const std::map<int, std::string> basic{
      {0, identity.vendor}, {1, identity.product_code}, {2, identity.revision}};
  EXPECT_EQ(collected(identity, 1), basic);
  EXPECT_EQ(collected(identity, 3).at(5), "Otter");
}

TEST(DeviceIdentification, WhatDoesNotFitOneResponseFollowsInTheNext) {
  DeviceIdentity identity;
  identity.vendor = std::string(200, 'v');
  identity.url = std::string(240, 'u');
  identity.application = std::string(100, 'a');
  identity.validate();
  const auto objects = collected(identity, 2);
  EXPECT_EQ(objects.at(0), identity.vendor);
  EXPECT_EQ(objects.at(3), identity.url);
  EXPECT_EQ(objects.at(6), identity.application);
}

TEST(DeviceIdentification, OneObjectIsReadByItsNumberOrDoesNotExist) {
  const DeviceIdentity identity;
  const Request request = id_request(4, 1);
  const Pdu pdu = device_id_response(identity, request);
  EXPECT_EQ(decode_device_id(decode_response(request, pdu.bytes()).values).objects,
            (std::map<int, std::string>{{1, identity.product_code}}));
  EXPECT_EQ(hex_of(device_id_response(identity, id_request(4, 9)).bytes()), "AB 02");
}

TEST(DeviceIdentification, AStreamFromAnUnknownObjectBeginsAtTheFirst) {
  const Request request = id_request(1, 77);
  const Pdu pdu = device_id_response(DeviceIdentity(), request);
  EXPECT_EQ(decode_device_id(decode_response(request, pdu.bytes()).values).objects.count(0), 1U);
}

TEST(DeviceIdentification, TextsThatEndTooEarlyAreAnError) {
  for (const char* const hex : {"01 01 00 00", "01 01 00 00 01", "01 01 00 00 01 00 05 41"}) {
    const auto bytes = bytes_of(hex);
    EXPECT_THROW(decode_device_id(bytes), Error) << hex;
  }
}

TEST(DeviceIdentification, ATextLongerThanAResponseIsRefused) {
  DeviceIdentity identity;
  identity.vendor = std::string(241, 'v');
  EXPECT_THROW(identity.validate(), Error);
}

}  // namespace
}  // namespace trident::bridges::modbus
