// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/registry.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

namespace trident {
namespace {

using Factory = std::function<std::unique_ptr<int>()>;

Registry<Factory> filled() {
  Registry<Factory> registry("plugin");
  registry.add("libwind.so", [] { return std::make_unique<int>(2); });
  registry.add("libimu.so", [] { return std::make_unique<int>(1); });
  return registry;
}

template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Registry, FindsWhatWasAdded) {
  const auto registry = filled();
  ASSERT_NE(registry.find("libimu.so"), nullptr);
  EXPECT_EQ(*(*registry.find("libimu.so"))(), 1);
  EXPECT_EQ(*registry.get("libwind.so")(), 2);
}

TEST(Registry, UnknownNameIsNull) { EXPECT_EQ(filled().find("libgps.so"), nullptr); }

TEST(Registry, NamesAreSorted) {
  EXPECT_EQ(filled().names(), (std::vector<std::string>{"libimu.so", "libwind.so"}));
}

TEST(Registry, ASecondRegistrationIsAnErrorAndChangesNothing) {
  auto registry = filled();
  EXPECT_EQ(error_of([&] { registry.add("libimu.so", nullptr); }),
            "plugin 'libimu.so' is registered twice");
  EXPECT_EQ(*registry.get("libimu.so")(), 1);
}

TEST(Registry, AnEmptyNameIsAnError) {
  auto registry = filled();
  EXPECT_EQ(error_of([&] { registry.add("", nullptr); }),
            "cannot register a plugin without a name");
}

TEST(Registry, GetSuggestsTheNearestName) {
  const auto registry = filled();
  EXPECT_EQ(error_of([&] { registry.get("libinu.so"); }),
            "unknown plugin 'libinu.so'; did you mean 'libimu.so'? Known: libimu.so, libwind.so");
  EXPECT_EQ(error_of([&] { registry.get("camera"); }),
            "unknown plugin 'camera'; known: libimu.so, libwind.so");
  EXPECT_EQ(error_of([&] { Registry<Factory>("sensor").get("x"); }),
            "unknown sensor 'x'; known: none");
}

}  // namespace
}  // namespace trident
