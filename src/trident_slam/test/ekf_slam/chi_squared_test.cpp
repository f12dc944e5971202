// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ekf_slam/chi_squared.h"

#include <gtest/gtest.h>

#include <limits>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

TEST(ChiSquaredQuantile, IsThatOfTheTables) {
  struct Row {
    double probability;
    int degrees;
    double quantile;
  };
  // scipy.stats.chi2.ppf
  constexpr Row kRows[] = {
      {1e-06, 5, 0.012896160206497087},    {0.5, 1, 0.454936423119572},
      {0.05, 3, 0.35184631774927144},      {0.999, 2, 13.815510557964274},
      {0.999999, 2, 27.631021115871036},   {0.999, 4, 18.46682695290317},
      {0.9, 7, 12.017036623780532},        {0.999, 20, 45.31474661812586},
      {0.01, 128, 93.74081278877594},      {0.999, 128, 183.18643733447217},
      {0.999999, 1000, 1227.152421187278},
  };
  for (const Row& row : kRows) {
    EXPECT_NEAR(chi_squared_quantile(row.probability, row.degrees) / row.quantile, 1.0, 2e-14)
        << row.probability << " of " << row.degrees << " degrees";
  }
}

TEST(ChiSquaredQuantile, GrowsWithProbabilityAndDegrees) {
  for (int degrees = 1; degrees < 130; ++degrees) {
    double last = 0.0;
    for (const double probability : {1e-9, 0.001, 0.2, 0.5, 0.8, 0.999, 1.0 - 1e-9}) {
      const double quantile = chi_squared_quantile(probability, degrees);
      EXPECT_GT(quantile, last) << probability << " of " << degrees;
      EXPECT_LT(quantile, chi_squared_quantile(probability, degrees + 1));
      last = quantile;
    }
  }
}

TEST(ChiSquaredQuantile, RefusesWhatIsNone) {
  for (const double probability : {0.0, 1.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(chi_squared_quantile(probability, 2), Error) << probability;
  }
  EXPECT_THROW(chi_squared_quantile(0.5, 0), Error);
}

}  // namespace
}  // namespace trident::slam
