// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "chordal_start.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace trident::slam {
namespace {

// The rotation nearest to M, by Newton's iteration for the polar decomposition (Higham 1986).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  Eigen::Matrix3d R = M / std::cbrt(std::abs(M.determinant()));
  for (int k = 0; k < 20 && R.determinant() > 0.1; ++k) {
    const Eigen::Matrix3d next = 0.5 * (R + R.inverse().transpose());
    const double change = (next - R).cwiseAbs().maxCoeff();
    R = next;
    if (change < 1e-12) return R;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) sign.z() = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

// How the rotation of a pose is written in unknown vectors, each as long as the space has
// dimensions: a vertex's vector k is `vector(R, k)`, and an edge says that
// vector(R_to, k) = turn(R_from_to) * vector(R_from, k).
template <class Group>
struct RotationVectors;

template <>
struct RotationVectors<SE2> {  // the first column; the second follows
  static constexpr int kCount = 1;
  static Eigen::Vector2d vector(const Eigen::Matrix2d& R, int) { return R.col(0); }
  static Eigen::Matrix2d turn(const Eigen::Matrix2d& R) { return R; }
  static Eigen::Matrix2d rotation(const Eigen::Vector2d* vectors) {
    const Eigen::Vector2d x = vectors[0].normalized();
    Eigen::Matrix2d R;
    R << x.x(), -x.y(), x.y(), x.x();
    return R;
  }
};

template <>
struct RotationVectors<SE3> {  // the rows
  static constexpr int kCount = 3;
  static Eigen::Vector3d vector(const Eigen::Matrix3d& R, int k) { return R.row(k).transpose(); }
  static Eigen::Matrix3d turn(const Eigen::Matrix3d& R) { return R.transpose(); }
  static Eigen::Matrix3d rotation(const Eigen::Vector3d* vectors) {
    Eigen::Matrix3d M;
    M << vectors[0].transpose(), vectors[1].transpose(), vectors[2].transpose();
    return nearest_rotation(M);
  }
};

template <class Group>
class ChordalStart {
 public:
  using System = PoseSystem<Group>;
  using Model = typename System::Model;
  using Vectors = RotationVectors<Group>;
  static constexpr int kSpace = Model::kSpace;
  using Block = Eigen::Matrix<double, kSpace, kSpace>;
  using Vector = Eigen::Matrix<double, kSpace, 1>;

  explicit ChordalStart(const System& system)
      : system_(system), cholesky_(system.symbolic()), poses_(system.poses) {}

  typename System::Poses run() {
    if (!average_rotations() || !place_origins()) return {};
    for (const auto& pose : poses_) {
      if (!pose.R.allFinite() || !pose.p.allFinite()) return {};
    }
    return poses_;
  }

 private:
  // The terms of weight * |x_to - turn * x_from|^2, W symmetric.
  void add_terms(const typename System::Edge& edge, const Block& turn, const Block& W) {
    const int from = system_.unknown(edge.from);
    const int to = system_.unknown(edge.to);
    if (to != -1) matrix_.diagonal[to] += W;
    if (from == -1) return;
    const Block across = turn.transpose() * W;
    matrix_.diagonal[from] += across * turn;
    if (to == -1) return;
    if (edge.is_pair_reversed) {
      matrix_.pairs[edge.pair] -= across.transpose();
    } else {
      matrix_.pairs[edge.pair] -= across;
    }
  }

  bool average_rotations() {
    matrix_.set_zero(system_.unknowns(), system_.pairs().size());
    for (const auto& edge : system_.edges()) {
      add_terms(edge, Vectors::turn(edge.measured.R), rotation_weight(edge) * Block::Identity());
    }
    if (!cholesky_.factorize(matrix_)) return false;
    std::vector<Eigen::VectorXd> solutions;
    for (int k = 0; k < Vectors::kCount; ++k) {
      solutions.push_back(rotation_terms(k));
      cholesky_.solve(solutions.back());
    }
    for (int unknown = 0; unknown < system_.unknowns(); ++unknown) {
      Vector vectors[Vectors::kCount];
      for (int k = 0; k < Vectors::kCount; ++k) {
        vectors[k] = solutions[k].template segment<kSpace>(kSpace * unknown);
      }
      poses_[system_.vertex(unknown)].R = Vectors::rotation(vectors);
    }
    return true;
  }

  // What the held vertices contribute to the right-hand side of vector k.
  Eigen::VectorXd rotation_terms(int k) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(kSpace * system_.unknowns());
    for (const auto& edge : system_.edges()) {
      const int from = system_.unknown(edge.from);
      const int to = system_.unknown(edge.to);
      const Block turn = rotation_weight(edge) * Vectors::turn(edge.measured.R);
      if (from == -1 && to != -1) {
        b.template segment<kSpace>(kSpace * to) +=
            turn * Vectors::vector(system_.poses[edge.from].R, k);
      } else if (to == -1 && from != -1) {
        b.template segment<kSpace>(kSpace * from) +=
            turn.transpose() * Vectors::vector(system_.poses[edge.to].R, k);
      }
    }
    return b;
  }

  // Minimises |p_to - p_from - R_from * t|^2 with the edges' information on positions.
  bool place_origins() {
    matrix_.set_zero(system_.unknowns(), system_.pairs().size());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(kSpace * system_.unknowns());
    for (const auto& edge : system_.edges()) {
      const Block& R = poses_[edge.from].R;
      const Block W = R * edge.information.template topLeftCorner<kSpace, kSpace>() * R.transpose();
      add_terms(edge, Block::Identity(), W);
      const int from = system_.unknown(edge.from);
      const int to = system_.unknown(edge.to);
      Vector offset = R * edge.measured.p;
      if (from == -1) offset += poses_[edge.from].p;
      if (to == -1) offset -= poses_[edge.to].p;
      if (to != -1) x.template segment<kSpace>(kSpace * to) += W * offset;
      if (from != -1) x.template segment<kSpace>(kSpace * from) -= W * offset;
    }
    if (!cholesky_.factorize(matrix_)) return false;
    cholesky_.solve(x);
    for (int unknown = 0; unknown < system_.unknowns(); ++unknown) {
      poses_[system_.vertex(unknown)].p = x.template segment<kSpace>(kSpace * unknown);
    }
    return true;
  }

  static double rotation_weight(const typename System::Edge& edge) {
    constexpr int kTurns = System::kDimension - kSpace;
    return edge.information.template bottomRightCorner<kTurns, kTurns>().trace() / kTurns;
  }

  const System& system_;
  BlockMatrix<kSpace> matrix_;
  BlockCholesky<kSpace> cholesky_;
  typename System::Poses poses_;
};

}  // namespace

template <class Group>
typename PoseSystem<Group>::Poses chordal_start(const PoseSystem<Group>& system) {
  return ChordalStart<Group>(system).run();
}

template <class Group>
void apply_start(PoseSystem<Group>& system, PoseGraphStart start, PoseGraphReport& report) {
  if (start == PoseGraphStart::kGraph) return;
  typename PoseSystem<Group>::Poses chordal = chordal_start(system);
  if (chordal.empty()) return;
  const auto cost = system.cost(chordal);
  const bool is_better = cost.robust < system.cost(system.poses).robust;
  if (start == PoseGraphStart::kAuto && !is_better) return;
  system.poses = std::move(chordal);
  report.is_start_chordal = true;
  report.chi2_start = cost.chi2;
}

template void apply_start(PoseSystem<SE2>&, PoseGraphStart, PoseGraphReport&);
template void apply_start(PoseSystem<SE3>&, PoseGraphStart, PoseGraphReport&);
template PoseSystem<SE2>::Poses chordal_start(const PoseSystem<SE2>&);
template PoseSystem<SE3>::Poses chordal_start(const PoseSystem<SE3>&);

}  // namespace trident::slam
