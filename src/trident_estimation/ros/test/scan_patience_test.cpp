// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "trident_estimation_ros/scan_input.h"

namespace trident::estimation {
namespace {

TEST(ScanPatience, NamesWhatIsMissingAndGivesUpAfterTenSeconds) {
  EXPECT_EQ(scan_patience(0.1, 0.1), ScanPatience::kWaits);
  EXPECT_EQ(scan_patience(1.0, 1.0), ScanPatience::kIsNamed);
  EXPECT_EQ(scan_patience(9.9, 9.9), ScanPatience::kIsNamed);
  EXPECT_EQ(scan_patience(10.1, 10.1), ScanPatience::kIsOver);
}

// A process that is stopped for 15 s, from which the transform is to come, must not cost a scan.
TEST(ScanPatience, AWorldThatStandsLosesNoScan) {
  EXPECT_EQ(scan_patience(15.0, 0.0), ScanPatience::kIsNamed);
  EXPECT_EQ(scan_patience(3600.0, 0.0), ScanPatience::kIsNamed);
}

// Faster than real time a scan is not given up before it could be named.
TEST(ScanPatience, ACompressedTimeStillWaitsForTransformsInTransit) {
  EXPECT_EQ(scan_patience(0.1, 50.0), ScanPatience::kWaits);
}

}  // namespace
}  // namespace trident::estimation
