#include "tests/engine/rigidity/push_dimension.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "tests/engine/rigidity/linear_programme.hpp"

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::SparseMatrix;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// What pushes along unit rows add up to on particle A of every contact, six entries each, (F, T/R).
SparseMatrix<double> wrenches(std::span<const Contact> contacts, std::span<const ContactPatch> patches,
                              const RigidityMatrix& corners) {
  const SparseMatrix<double, Eigen::RowMajor> rows = corners.rows;
  std::vector<Eigen::Triplet<double>> entries;
  Index row = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (std::size_t k = 0; k < patches[c].corners.size(); ++k, ++row) {
      for (int i = 0; i < 6; ++i)
        entries.emplace_back(6 * static_cast<int>(c) + i, static_cast<int>(row),
                             rows.coeff(row, 6 * contacts[c].pair.a + i));
    }
  }
  SparseMatrix<double> sums(6 * static_cast<Index>(contacts.size()), row);
  sums.setFromTriplets(entries.begin(), entries.end());
  return sums;
}

VectorXd beside(const MatrixXd& seen, VectorXd x) {
  for (int twice = 0; twice < 2; ++twice) x -= seen * (seen.transpose() * x);
  return x;
}

/// States of self-stress that pushes along `columns` make, and how these pushes add up at contacts.
class Cone {
 public:
  Cone(SparseMatrix<double> columns, SparseMatrix<double> sums)
      : columns_(std::move(columns)), sums_(std::move(sums)) {}

  /// Pushes balance to `tolerance` of their sum.
  PushedStates looked_at(double tolerance, RandomStream& random) const {
    PushedStates states;
    MatrixXd seen(sums_.rows(), 0);
    LinearProgramme programme(columns_, tolerance);
    VectorXd along(sums_.rows());
    for (int in_vain = 0; in_vain < enough && seen.cols() < sums_.cols();) {
      if (states.programmes % 2 == 0) {
        for (double& x : along) x = random.normal();
        along = beside(seen, along);
      } else {
        along = -along;
      }
      ++states.programmes;
      const Optimum optimum = programme.greatest(sums_.transpose() * along);
      if (optimum.end == Optimum::End::unknown) return {};
      if (optimum.end == Optimum::End::infeasible) return {.dimension = 0};
      in_vain = add(optimum.f, seen, states) ? 0 : in_vain + 1;
    }
    states.dimension = static_cast<int>(seen.cols());
    return states;
  }

 private:
  /// Objectives in vain.
  static constexpr int enough = 6;
  /// Times what pushes are below 0 or do not balance: how much beside all others that may make of a state that is not
  /// new. The softest combination of constraints that is opposed is so much softer than a single one, and more.
  static constexpr double slack = 1e4;

  /// Whether the state is new.
  bool add(const VectorXd& pushes, MatrixXd& seen, PushedStates& states) const {
    const double below = -std::min(pushes.minCoeff(), 0.0), unbalanced = (columns_ * pushes).cwiseAbs().maxCoeff();
    const VectorXd state = sums_ * pushes;
    const double size = state.norm();
    const VectorXd rest = beside(seen, state / size);
    const double part = rest.norm();
    states.most_below = std::max(states.most_below, below);
    states.most_unbalanced = std::max(states.most_unbalanced, unbalanced);
    if (part < slack * std::max({below, unbalanced, eps}) / size) {
      states.largest_old = std::max(states.largest_old, part);
      return false;
    }
    states.least_new = seen.cols() == 0 ? part : std::min(states.least_new, part);
    seen.conservativeResize(Eigen::NoChange, seen.cols() + 1);
    seen.rightCols(1) = rest / part;
    return true;
  }

  SparseMatrix<double> columns_, sums_;
};

}  // namespace

PushedStates pushed_states(std::span<const Contact> contacts, std::span<const ContactPatch> patches,
                           const RigidityMatrix& normals, const RigidityMatrix& corners, RandomStream& random) {
  constexpr double tight = 1e-12;
  const Cone cone(corners.rows.transpose(), wrenches(contacts, patches, corners));
  const PushedStates states = cone.looked_at(tight, random);
  if (states.dimension.value_or(0) > 0) return states;
  const double unbalanced = (normals.rows.transpose() * normals.forces).cwiseAbs().maxCoeff() / normals.forces.sum();
  return cone.looked_at(std::max(tight, 10 * unbalanced), random);
}

}  // namespace isojam
