// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/pdu.h"

#include <gtest/gtest.h>

#include "bytes_of_text.h"

namespace trident::bridges::modbus {
namespace {

// The examples of the Modbus Application Protocol V1.1b3, sections 6.1 to 6.21.
const char* const kRequests[] = {
    "01 00 13 00 13",
    "02 00 C4 00 16",
    "03 00 6B 00 03",
    "04 00 08 00 01",
    "05 00 AC FF 00",
    "06 00 01 00 03",
    "0F 00 13 00 0A 02 CD 01",
    "10 00 01 00 02 04 00 0A 01 02",
    "16 00 04 00 F2 00 25",
    "17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
    "2B 0E 01 00",
};

DecodedRequest decoded(const std::string& hex, std::vector<std::uint8_t>& bytes) {
  bytes = bytes_of(hex);
  return decode_request(bytes);
}

TEST(Pdu, WhatTheProtocolsExamplesAskForIsReadAndWrittenToTheByte) {
  for (const char* const hex : kRequests) {
    std::vector<std::uint8_t> bytes;
    const DecodedRequest request = decoded(hex, bytes);
    ASSERT_TRUE(request.is_legal) << hex << ": " << request.problem;
    EXPECT_EQ(hex_of(encode_request(request.request).bytes()), hex);
  }
}

TEST(Pdu, AReadNamesItsTableAddressAndQuantity) {
  std::vector<std::uint8_t> bytes;
  const Request request = decoded("03 00 6B 00 03", bytes).request;
  EXPECT_EQ(request.function, Function::kReadHoldingRegisters);
  EXPECT_EQ(request.read_address, 107);
  EXPECT_EQ(request.read_count, 3);
  EXPECT_FALSE(request.writes());
}

TEST(Pdu, AReadAndWriteHasBothPartsAndItsValues) {
  std::vector<std::uint8_t> bytes;
  const Request request = decoded(kRequests[9], bytes).request;
  EXPECT_EQ(request.read_address, 3);
  EXPECT_EQ(request.read_count, 6);
  EXPECT_EQ(request.write_address, 14);
  EXPECT_EQ(request.write_count, 3);
  EXPECT_EQ(hex_of(request.values), "00 FF 00 FF 00 FF");
}

TEST(Pdu, ASingleCoilIsABitInTheFormOfManyCoils) {
  std::vector<std::uint8_t> bytes;
  EXPECT_EQ(decoded("05 00 AC FF 00", bytes).request.values[0] & 1, 1);
  EXPECT_EQ(decoded("05 00 AC 00 00", bytes).request.values[0] & 1, 0);
}

TEST(Pdu, AFunctionThatIsNotSpokenIsRefusedAsSuch) {
  std::vector<std::uint8_t> bytes;
  for (const char* const hex : {"", "00", "07", "08 00 00 00 00", "63", "83 02", "2B 0D 01 00"}) {
    const DecodedRequest request = decoded(hex, bytes);
    EXPECT_FALSE(request.is_legal) << hex;
    EXPECT_EQ(request.refusal, ExceptionCode::kIllegalFunction) << hex;
  }
}

TEST(Pdu, AQuantityOutOfRangeIsRefusedWithItsRange) {
  std::vector<std::uint8_t> bytes;
  for (const char* const hex :
       {"01 00 00 00 00", "01 00 00 07 D1", "03 00 00 00 7E", "04 00 00 FF FF", "0F 00 00 00 00 00",
        "10 00 00 00 7C F8", "17 00 00 00 7E 00 00 00 01 02 00 00",
        "17 00 00 00 01 00 00 00 00 00"}) {
    const DecodedRequest request = decoded(hex, bytes);
    EXPECT_FALSE(request.is_legal) << hex;
    EXPECT_EQ(request.refusal, ExceptionCode::kIllegalValue) << hex;
    EXPECT_NE(request.problem.find("quantity"), std::string::npos) << request.problem;
    EXPECT_NE(request.problem.find("legal: 1 to "), std::string::npos) << request.problem;
  }
}

TEST(Pdu, ALengthThatDoesNotFitIsAnIllegalValue) {
  std::vector<std::uint8_t> bytes;
  for (const char* const hex :
       {"03 00 6B 00", "03 00 6B 00 03 00", "05 00 AC 12 34", "06 00 01", "0F 00 13 00 0A",
        "0F 00 13 00 0A 03 CD 01 00", "0F 00 13 00 0A 02 CD", "10 00 01 00 02 04 00 0A 01",
        "16 00 04 00 F2", "17 00 03 00 06 00 0E 00 03", "2B 0E 01", "2B 0E 05 00", "2B"}) {
    const DecodedRequest request = decoded(hex, bytes);
    EXPECT_FALSE(request.is_legal) << hex;
    EXPECT_EQ(request.refusal, ExceptionCode::kIllegalValue) << hex << ": " << request.problem;
  }
}

TEST(Pdu, AddressesBeyondTheTableAreIllegal) {
  std::vector<std::uint8_t> bytes;
  for (const char* const hex :
       {"03 FF FF 00 02", "01 F8 31 07 D0", "10 FF FF 00 02 04 00 00 00 00",
        "17 00 00 00 01 FF FF 00 02 04 00 00 00 00", "17 FF FF 00 02 00 00 00 01 02 00 00"}) {
    const DecodedRequest request = decoded(hex, bytes);
    EXPECT_FALSE(request.is_legal) << hex;
    EXPECT_EQ(request.refusal, ExceptionCode::kIllegalAddress) << hex << ": " << request.problem;
  }
  EXPECT_TRUE(decoded("03 FF FF 00 01", bytes).is_legal);
}

TEST(Pdu, FunctionsAndExceptionsHaveNames) {
  EXPECT_EQ(function_text(Function::kReadInputRegisters), "read input registers (4)");
  EXPECT_EQ(function_text(static_cast<Function>(99)), "function 99");
  EXPECT_EQ(exception_text(ExceptionCode::kBusy), "busy (exception 6)");
  EXPECT_EQ(exception_text(static_cast<ExceptionCode>(77)), "exception 77");
}

}  // namespace
}  // namespace trident::bridges::modbus
