// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/span.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace trident {
namespace {

template <class From, class To>
constexpr bool converts = std::is_convertible_v<From, To>;

struct Base {
  int value = 0;
};
struct Derived : Base {
  int more = 0;
};

// Const may be added, never removed; values are viewed, never converted.
static_assert(converts<Span<double>, Span<const double>>);
static_assert(!converts<Span<const double>, Span<double>>);
static_assert(converts<std::vector<double>&, Span<double>>);
static_assert(converts<const std::vector<double>&, Span<const double>>);
static_assert(!converts<const std::vector<double>&, Span<double>>);
static_assert(converts<const std::array<double, 2>&, Span<const double>>);
static_assert(!converts<const std::array<double, 2>&, Span<double>>);
static_assert(!converts<std::array<const double, 2>&, Span<double>>);
static_assert(!converts<std::vector<float>&, Span<const double>>);
static_assert(!converts<std::vector<Derived>&, Span<Base>>);
static_assert(!converts<int&, Span<int>>);

// A temporary may be viewed for the time of a call, but writing to one would be lost.
static_assert(converts<std::vector<double>, Span<const double>>);
static_assert(!converts<std::vector<double>, Span<double>>);

static_assert(std::is_trivially_copyable_v<Span<double>>);

// Usable in constant expressions.
constexpr std::array<int, 3> kDigits = {3, 1, 4};
static_assert(Span<const int>(kDigits).subspan(1)[1] == 4);

double sum(Span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void fill(Span<double> values, double value) {
  for (double& v : values) v = value;
}

TEST(Span, DefaultIsEmpty) {
  const Span<int> span;
  EXPECT_TRUE(span.empty());
  EXPECT_EQ(span.size(), 0U);
  EXPECT_EQ(span.data(), nullptr);
  EXPECT_EQ(span.begin(), span.end());
}

TEST(Span, ViewsEveryKindOfConsecutiveValues) {
  std::vector<double> vector = {1, 2, 3};
  const std::array<double, 2> array = {4, 5};
  double c_array[] = {6, 7, 8, 9};
  EXPECT_EQ(sum(vector), 6);
  EXPECT_EQ(sum(array), 9);
  EXPECT_EQ(sum(c_array), 30);
  EXPECT_EQ(sum(Span<double>(vector)), 6);
  EXPECT_EQ(sum({vector.data() + 1, 2}), 5);
  EXPECT_EQ(sum(std::vector<double>{10, 20}), 30);
  EXPECT_EQ(Span<const char>(std::string_view("abc")).back(), 'c');
}

TEST(Span, SharesTheValuesOfItsOwner) {
  std::vector<double> owner = {1, 2, 3};
  const Span<double> span = owner;
  const Span<double> copy = span;
  copy[1] = 20;
  EXPECT_EQ(owner[1], 20);
  fill(owner, 7);
  EXPECT_EQ(owner, (std::vector<double>{7, 7, 7}));
  EXPECT_EQ(span.data(), owner.data());
}

TEST(Span, FirstSubspanFrontAndBack) {
  std::vector<int> owner = {0, 1, 2, 3, 4};
  const Span<int> span = owner;
  EXPECT_EQ(span.front(), 0);
  EXPECT_EQ(span.back(), 4);

  EXPECT_EQ(span.first(2).size(), 2U);
  EXPECT_EQ(span.first(2).back(), 1);
  EXPECT_EQ(span.subspan(3).size(), 2U);
  EXPECT_EQ(span.subspan(3).front(), 3);
  EXPECT_EQ(span.subspan(1, 3).size(), 3U);
  EXPECT_EQ(span.subspan(1, 3).front(), 1);
  EXPECT_EQ(span.subspan(1, 3).back(), 3);

  span.subspan(4)[0] = 40;
  EXPECT_EQ(owner[4], 40);
}

TEST(Span, WholeAndEmptyPartsAreLegal) {
  std::vector<int> owner = {1, 2};
  const Span<int> span = owner;
  EXPECT_EQ(span.first(2).size(), 2U);
  EXPECT_TRUE(span.first(0).empty());
  EXPECT_EQ(span.subspan(0).size(), 2U);
  EXPECT_TRUE(span.subspan(2).empty());
  EXPECT_TRUE(span.subspan(1, 0).empty());
  EXPECT_TRUE(Span<int>().subspan(0).empty());
}

TEST(Span, DeducesTheElementType) {
  std::vector<double> writable(2);
  const std::vector<double> fixed(2);
  static_assert(std::is_same_v<decltype(Span(writable)), Span<double>>);
  static_assert(std::is_same_v<decltype(Span(fixed)), Span<const double>>);
  static_assert(std::is_same_v<decltype(Span(writable.data(), 2)), Span<double>>);
  EXPECT_EQ(Span(writable).size(), Span(fixed).size());
}

}  // namespace
}  // namespace trident
