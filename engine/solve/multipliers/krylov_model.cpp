#include "engine/solve/multipliers/krylov_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/solve/factor/dense.hpp"
#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// The space is examined after every `vectors_at_once` vectors. It is complete if these raised the decrease by less
/// than the fraction `complete`.
constexpr int vectors_at_once = 4;
constexpr double complete = 0.03;

/// A vector of which only this fraction remains when its components along the basis are subtracted is rounding error.
constexpr double dependent = 1e-10;

/// λ_P is multiplied by `fall` from model to model, and by `growth` after a failed factorisation. `margin` is its ratio
/// to the magnitude of a negative eigenvalue.
constexpr double fall = 0.6, growth = 4, margin = 3;

}  // namespace

KrylovModel::KrylovModel(const BlockMatrix& matrix, const Preconditioner& preconditioner,
                         const Eigen::VectorXd& gradient, double shift)
    : basis_(gradient.size(), std::min<Eigen::Index>(most_vectors, gradient.size())),
      projected_(basis_.cols(), basis_.cols()) {
  const auto most = static_cast<int>(basis_.cols());
  Eigen::VectorXd x = preconditioner(gradient);
  double before = 0;
  int count = 0;
  while (count < most) {
    const double length = x.norm();
    if (!(length > 0 && std::isfinite(length))) break;
    // Two passes make the basis orthogonal to rounding errors.
    for (int pass = 0; pass < 2 && count > 0; ++pass) {
      const Eigen::VectorXd along = basis_.leftCols(count).transpose() * x;
      x.noalias() -= basis_.leftCols(count) * along;
    }
    const double rest = x.norm();
    if (!(rest > dependent * length)) break;
    basis_.col(count) = x / rest;
    const Eigen::VectorXd image = matrix * Eigen::VectorXd(basis_.col(count));
    ++count;
    projected_.col(count - 1).head(count) = basis_.leftCols(count).transpose() * image;
    projected_.row(count - 1).head(count) = projected_.col(count - 1).head(count).transpose();
    if (count % vectors_at_once == 0 || count == most) {
      project(gradient, count);
      const double now = gain(shift);
      if (now - before < complete * now) break;
      before = now;
      incomplete_ = count == most_vectors;
    }
    if (count < most) x = preconditioner(image);
  }
  if (vectors() != count) project(gradient, count);
}

void KrylovModel::project(const Eigen::VectorXd& gradient, int vectors) {
  auto eigen = symmetric_eigen(projected_.topLeftCorner(vectors, vectors));
  assert(eigen.values.size() == vectors);
  eigenvalues_ = std::move(eigen.values);
  eigenvectors_ = std::move(eigen.vectors);
  slopes_ = eigenvectors_.transpose() * (basis_.leftCols(vectors).transpose() * gradient);
}

/// −g·s, twice the decrease of the model in which |M| + λ replaces M.
double KrylovModel::gain(double shift) const {
  return (slopes_.array().square() / (eigenvalues_.array().abs() + shift)).sum();
}

Eigen::VectorXd KrylovModel::step(double shift) const {
  const Eigen::VectorXd along = -slopes_.array() / (eigenvalues_.array().abs() + shift);
  return basis_.leftCols(vectors()) * (eigenvectors_ * along);
}

KrylovStep KrylovModel::step(double shift, double longest) const {
  KrylovStep found{step(shift), shift, 0};
  while (largest_displacement(found.step) > longest) found.shift *= 2, found.step = step(found.shift);
  const Eigen::ArrayXd inverse = 1 / (eigenvalues_.array().abs() + found.shift);
  found.predicted_decrease = (slopes_.array().square() * inverse * (1 - eigenvalues_.array() * inverse / 2)).sum();
  return found;
}

bool KrylovModels::factorise(const BlockMatrix& matrix, MinimiseWork& work) {
  ++(uses_complete_ ? work.factorisations : work.incomplete_factorisations);
  return uses_complete_ ? complete_.factorise(matrix, shift_) : incomplete_.factorise(matrix, shift_);
}

std::optional<KrylovModel> KrylovModels::model(const BlockMatrix& matrix, const Eigen::VectorXd& gradient, double shift,
                                               MinimiseWork& work) {
  // A complete factorisation succeeds with any shift if the matrix is positive definite.
  shift_ = std::max({uses_complete_ ? 0 : fall * shift_, margin * negative_, shift});
  while (std::isfinite(shift_)) {
    if (!factorise(matrix, work)) {
      shift_ *= growth;
      continue;
    }
    const KrylovModel model(
        matrix, [&](const Eigen::VectorXd& b) { return uses_complete_ ? complete_.solve(b) : incomplete_.solve(b); },
        gradient, shift);
    work.krylov_vectors += model.vectors();
    negative_ = std::max(0.0, -model.lowest());
    uses_complete_ = negative_ == 0 && (uses_complete_ || model.incomplete());
    return model;
  }
  return std::nullopt;
}

}  // namespace isojam
