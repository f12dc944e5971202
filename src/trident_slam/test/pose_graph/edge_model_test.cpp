// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_graph/edge_model.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pose_graph/random_graphs.h"

namespace trident::slam {
namespace {

template <class Group>
class EdgeModelTest : public testing::Test {};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(EdgeModelTest, Groups);

// A transform that turns by exactly this angle, about any axis.
template <class Group>
Group turning_by(Dice& dice, double angle) {
  using Tangent = typename Group::Tangent;
  Tangent t = dice.vector<Tangent>(1.0);
  constexpr int kTurns = Tangent::RowsAtCompileTime == 3 ? 1 : 3;
  t.template tail<kTurns>() *= angle / t.template tail<kTurns>().norm();
  t.template head<2>() *= 5.0;
  return Group::exp(t);
}

// From far below the series' limit to almost half a turn.
constexpr double kAngles[] = {0.0, 1e-9, 1e-4, 0.1, 0.2999, 0.3001, 1.0, 2.0, 3.0, 3.1};

TYPED_TEST(EdgeModelTest, LogIsThatOfTheGroup) {
  using Model = EdgeModel<TypeParam>;
  Dice dice(1);
  for (const double angle : kAngles) {
    const TypeParam T = turning_by<TypeParam>(dice, angle);
    EXPECT_LT((Model::log(Model::from_group(T)) - T.log()).norm(), 1e-9) << angle;
  }
}

TYPED_TEST(EdgeModelTest, JacobiansAgreeWithDifferences) {
  using Model = EdgeModel<TypeParam>;
  using Tangent = typename Model::Tangent;
  constexpr double kStep = 1e-5;
  Dice dice(2);
  for (int k = 0; k < 300; ++k) {
    const double angle = kAngles[k % std::size(kAngles)];
    const TypeParam T_a = turning_by<TypeParam>(dice, 3.0 * dice.roll());
    const TypeParam Z = turning_by<TypeParam>(dice, 3.0 * dice.roll());
    const TypeParam T_b = T_a * Z * turning_by<TypeParam>(dice, angle);
    const auto a = Model::from_group(T_a);
    const auto b = Model::from_group(T_b);
    const auto inverse_z = Model::from_group(Z).inverse();
    typename Model::Matrix J;
    const Tangent error = Model::log(inverse_z * (a.inverse() * b), J);
    const typename Model::Matrix J_a = -J * Model::inverse_adjoint(a.inverse() * b);
    EXPECT_LT((error - Model::log(inverse_z * (a.inverse() * b))).norm(), 1e-12);
    const auto error_after = [&](const Tangent& of_a, const Tangent& of_b) -> Tangent {
      return Model::log(inverse_z * (Model::moved(a, of_a).inverse() * Model::moved(b, of_b)));
    };
    for (int axis = 0; axis < Tangent::RowsAtCompileTime; ++axis) {
      const Tangent step = kStep * Tangent::Unit(axis);
      const Tangent none = Tangent::Zero();
      const Tangent by_a = (error_after(step, none) - error_after(-step, none)) / (2.0 * kStep);
      const Tangent by_b = (error_after(none, step) - error_after(none, -step)) / (2.0 * kStep);
      const double scale = 1.0 + J_a.norm() + J.norm();
      EXPECT_LT((by_a - J_a.col(axis)).norm(), 1e-6 * scale) << "angle " << angle;
      EXPECT_LT((by_b - J.col(axis)).norm(), 1e-6 * scale) << "angle " << angle;
    }
  }
}

TYPED_TEST(EdgeModelTest, ManyStepsKeepRotationsOrthogonal) {
  using Model = EdgeModel<TypeParam>;
  Dice dice(3);
  auto T = Model::from_group(TypeParam::identity());
  for (int k = 0; k < 1000; ++k) {
    T = Model::moved(T, dice.vector<typename Model::Tangent>(1.0));
  }
  EXPECT_LT((T.R.transpose() * T.R - decltype(T.R)::Identity()).norm(), 1e-14);
}

TYPED_TEST(EdgeModelTest, GroupAndBack) {
  using Model = EdgeModel<TypeParam>;
  Dice dice(4);
  for (const double angle : kAngles) {
    const TypeParam T = turning_by<TypeParam>(dice, angle);
    const TypeParam back = Model::to_group(Model::from_group(T));
    EXPECT_LT((T.inverse() * back).log().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace trident::slam
