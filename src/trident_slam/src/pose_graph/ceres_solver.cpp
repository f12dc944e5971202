// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0

// The only source that includes Ceres, which takes long to compile.
#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>

#include "chordal_start.h"
#include "pose_system.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph_ceres.h"

namespace trident::slam {
namespace {

// A pose as Ceres keeps it: rotation matrix and origin, one after the other, changed by steps of
// the tangent. Jacobians are with respect to the step; Ceres multiplies them by PlusJacobian, so
// that it is enough when their product is right: [J 0] * [I 0]'.
template <class Group>
class PoseManifold : public ceres::Manifold {
 public:
  using Model = EdgeModel<Group>;
  using Pose = typename Model::Pose;
  static constexpr int kSpace = Model::kSpace;
  static constexpr int kTangent = PoseGraph<Group>::kDimension;
  static constexpr int kAmbient = kSpace * (kSpace + 1);
  using Rotation = Eigen::Matrix<double, kSpace, kSpace>;
  using Origin = Eigen::Matrix<double, kSpace, 1>;

  static Pose read(const double* x) {
    return {Eigen::Map<const Rotation>(x), Eigen::Map<const Origin>(x + kSpace * kSpace)};
  }
  static void write(const Pose& T, double* x) {
    Eigen::Map<Rotation>(x, kSpace, kSpace) = T.R;
    Eigen::Map<Origin>(x + kSpace * kSpace) = T.p;
  }

  int AmbientSize() const override { return kAmbient; }
  int TangentSize() const override { return kTangent; }
  bool Plus(const double* x, const double* delta, double* result) const override {
    write(Model::moved(read(x), Eigen::Map<const typename Model::Tangent>(delta)), result);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    using Matrix = Eigen::Matrix<double, kAmbient, kTangent, Eigen::RowMajor>;
    Eigen::Map<Matrix>(jacobian, kAmbient, kTangent).setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* result) const override {
    Eigen::Map<typename Model::Tangent>(result, kTangent) = Model::log(read(x).inverse() * read(y));
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    using Matrix = Eigen::Matrix<double, kTangent, kAmbient, Eigen::RowMajor>;
    Eigen::Map<Matrix>(jacobian, kTangent, kAmbient).setIdentity();
    return true;
  }
};

template <class Group>
class EdgeCost
    : public ceres::SizedCostFunction<PoseManifold<Group>::kTangent, PoseManifold<Group>::kAmbient,
                                      PoseManifold<Group>::kAmbient> {
 public:
  using Manifold = PoseManifold<Group>;
  using Model = EdgeModel<Group>;
  using Matrix = typename Model::Matrix;

  EdgeCost(const typename Model::Pose& inverse_measured, const Matrix& information)
      : inverse_measured_(inverse_measured) {
    // A square root that may have lost its rank.
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(information);
    root_ = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
            solver.eigenvectors().transpose();
  }

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const auto T = Manifold::read(poses[0]).inverse() * Manifold::read(poses[1]);
    Matrix J;
    const typename Model::Tangent error = Model::log(inverse_measured_ * T, J);
    Eigen::Map<typename Model::Tangent>(residuals, Manifold::kTangent) = root_ * error;
    if (jacobians == nullptr) return true;
    const Matrix of_to = root_ * J;
    if (jacobians[0] != nullptr) fill(-of_to * Model::inverse_adjoint(T), jacobians[0]);
    if (jacobians[1] != nullptr) fill(of_to, jacobians[1]);
    return true;
  }

 private:
  static void fill(const Matrix& of_step, double* jacobian) {
    using Full = Eigen::Matrix<double, Manifold::kTangent, Manifold::kAmbient, Eigen::RowMajor>;
    Eigen::Map<Full> full(jacobian, Manifold::kTangent, Manifold::kAmbient);
    full.setZero();
    full.template leftCols<Manifold::kTangent>() = of_step;
  }

  typename Model::Pose inverse_measured_;
  Matrix root_;
};

// Our kernels; without a second derivative Ceres weights edges as we do.
class KernelLoss : public ceres::LossFunction {
 public:
  KernelLoss(RobustKernel kernel, double scale) : kernel_(kernel), scale_(scale) {}
  void Evaluate(double squared_error, double rho[3]) const override {
    const RobustValue value = evaluate_robust_kernel(kernel_, scale_, squared_error);
    rho[0] = value.cost;
    rho[1] = value.weight;
    rho[2] = 0.0;
  }

 private:
  RobustKernel kernel_;
  double scale_;
};

// The names that slam_toolbox knows, and what they mean.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

const Names<ceres::LinearSolverType> kLinearSolvers{
    {"SPARSE_NORMAL_CHOLESKY", ceres::SPARSE_NORMAL_CHOLESKY},
    {"SPARSE_SCHUR", ceres::SPARSE_SCHUR},
    {"ITERATIVE_SCHUR", ceres::ITERATIVE_SCHUR},
    {"CGNR", ceres::CGNR}};
const Names<ceres::PreconditionerType> kPreconditioners{{"JACOBI", ceres::JACOBI},
                                                        {"IDENTITY", ceres::IDENTITY},
                                                        {"SCHUR_JACOBI", ceres::SCHUR_JACOBI}};
const Names<ceres::TrustRegionStrategyType> kTrustStrategies{
    {"LEVENBERG_MARQUARDT", ceres::LEVENBERG_MARQUARDT}, {"DOGLEG", ceres::DOGLEG}};
const Names<ceres::DoglegType> kDoglegTypes{{"TRADITIONAL_DOGLEG", ceres::TRADITIONAL_DOGLEG},
                                            {"SUBSPACE_DOGLEG", ceres::SUBSPACE_DOGLEG}};
const Names<std::pair<RobustKernel, double>> kLosses{{"None", {RobustKernel::kNone, 1.0}},
                                                     {"HuberLoss", {RobustKernel::kHuber, 0.7}},
                                                     {"CauchyLoss", {RobustKernel::kCauchy, 0.2}}};

template <class Value>
Value value_of(const std::string& field, const std::string& name, const Names<Value>& names) {
  std::vector<std::string> known;
  for (const auto& [text, value] : names) {
    if (text == name) return value;
    known.push_back(text);
  }
  throw Error("unknown " + field + " " + unknown_name_text(name, known));
}

ceres::Solver::Options solver_options(const CeresOptions& options) {
  ceres::Solver::Options result;
  result.linear_solver_type =
      value_of("ceres_linear_solver", options.linear_solver, kLinearSolvers);
  result.preconditioner_type =
      value_of("ceres_preconditioner", options.preconditioner, kPreconditioners);
  // Without a Schur complement only Jacobi's is possible; slam_toolbox chooses it, too.
  if (result.linear_solver_type == ceres::CGNR &&
      result.preconditioner_type == ceres::SCHUR_JACOBI) {
    result.preconditioner_type = ceres::JACOBI;
  }
  result.trust_region_strategy_type =
      value_of("ceres_trust_strategy", options.trust_strategy, kTrustStrategies);
  result.dogleg_type = value_of("ceres_dogleg_type", options.dogleg_type, kDoglegTypes);
  result.max_num_iterations = options.max_iterations;
  result.function_tolerance = options.relative_tolerance;
  result.num_threads = 1;
  result.logging_type = ceres::SILENT;
  return result;
}

template <class Group>
class CeresSolver : public PoseGraphSolver<Group> {
 public:
  using Manifold = PoseManifold<Group>;
  using System = PoseSystem<Group>;

  explicit CeresSolver(const CeresOptions& options) : options_(options) { options_.validate(); }

  PoseGraphReport optimize(PoseGraph<Group>& graph) override {
    system_.load(graph);
    const auto [kernel, scale] = value_of("ceres_loss_function", options_.loss_function, kLosses);
    for (auto& edge : system_.edges()) {
      if (edge.kernel != RobustKernel::kNone) continue;
      edge.kernel = kernel;
      edge.kernel_scale = scale;
    }
    PoseGraphReport report;
    begin_report(system_, report);
    apply_start(system_, options_.start, report);
    solve(report);
    end_report(system_, report);
    system_.store(graph);
    return report;
  }

 private:
  /// Ceres' problem becomes its owner.
  template <class Edge>
  static ceres::LossFunction* make_loss(const Edge& edge) {
    if (edge.kernel == RobustKernel::kNone) return nullptr;
    return new KernelLoss(edge.kernel, edge.kernel_scale);
  }

  void solve(PoseGraphReport& report) {
    std::vector<std::array<double, Manifold::kAmbient>> values(system_.poses.size());
    ceres::Problem problem;
    for (std::size_t k = 0; k < values.size(); ++k) {
      Manifold::write(system_.poses[k], values[k].data());
      problem.AddParameterBlock(values[k].data(), Manifold::kAmbient, new Manifold);
      if (system_.unknown(k) == -1) problem.SetParameterBlockConstant(values[k].data());
    }
    for (const auto& edge : system_.edges()) {
      problem.AddResidualBlock(new EdgeCost<Group>(edge.inverse_measured, edge.information),
                               make_loss(edge), values[edge.from].data(), values[edge.to].data());
    }
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(options_), &problem, &summary);
    report.has_converged = summary.termination_type == ceres::CONVERGENCE;
    report.iterations = static_cast<int>(summary.iterations.size()) - 1;
    if (!summary.IsSolutionUsable()) return;
    for (std::size_t k = 0; k < values.size(); ++k) {
      system_.poses[k] = Manifold::read(values[k].data());
    }
  }

  CeresOptions options_;
  System system_;
};

}  // namespace

void CeresOptions::validate() const {
  solver_options(*this);
  value_of("ceres_loss_function", loss_function, kLosses);
  PoseGraphOptions common;
  common.max_iterations = max_iterations;
  common.relative_tolerance = relative_tolerance;
  common.validate();
}

template <class Group>
std::unique_ptr<PoseGraphSolver<Group>> make_ceres_solver(const CeresOptions& options) {
  return std::make_unique<CeresSolver<Group>>(options);
}

template std::unique_ptr<PoseGraphSolver<SE2>> make_ceres_solver(const CeresOptions&);
template std::unique_ptr<PoseGraphSolver<SE3>> make_ceres_solver(const CeresOptions&);

}  // namespace trident::slam
