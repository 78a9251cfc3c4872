#include "engine/solve/factor/definite_solver.hpp"

#include <algorithm>
#include <cmath>

namespace isojam {

namespace {

/// From this number of particles on, a complete factorisation costs more than `iteration_limit` iterations.
constexpr int large = 600, iteration_limit = 300;

/// Shift of the preconditioner in units of the largest diagonal entry, if the factorisation fails without one. It grows
/// by `growth` until the factorisation succeeds.
constexpr double first_extra_shift = 1e-10, growth = 10, most_extra_shift = 1;

double largest_diagonal(const BlockMatrix& matrix) {
  double largest = 0;
  for (const Matrix6d& block : matrix.diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  return largest;
}

}  // namespace

IterativeSolution conjugate_gradients(const BlockMatrix& matrix, double shift, const IncompleteCholesky& preconditioner,
                                      const Eigen::VectorXd& b, double tolerance, int most_iterations) {
  IterativeSolution found;
  found.x = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd r = b, z = preconditioner.solve(r), p = z;
  double error = r.dot(z);
  const double goal = tolerance * tolerance * error;
  while (error > goal) {
    if (found.iterations == most_iterations) return found;
    ++found.iterations;
    const Eigen::VectorXd image = matrix * p + shift * p;
    const double curvature = p.dot(image);
    if (!(curvature > 0)) {
      found.end = IterativeSolution::End::negative_curvature;
      return found;
    }
    const double length = error / curvature;
    found.x += length * p;
    r -= length * image;
    z = preconditioner.solve(r);
    const double next = r.dot(z);
    p = z + (next / error) * p;
    error = next;
  }
  if (std::isfinite(error)) found.end = IterativeSolution::End::converged;
  return found;
}

std::optional<Eigen::VectorXd> DefiniteSolver::solve(const BlockMatrix& matrix, double shift, const Eigen::VectorXd& b,
                                                     double tolerance, MinimiseWork& work) {
  if (matrix.size() >= large) {
    const double scale = largest_diagonal(matrix);
    double extra = 0;
    ++work.incomplete_factorisations;
    while (!incomplete_.factorise(matrix, shift + extra * scale) && extra < most_extra_shift) {
      extra = extra > 0 ? growth * extra : first_extra_shift;
      ++work.incomplete_factorisations;
    }
    if (extra < most_extra_shift) {
      IterativeSolution found = conjugate_gradients(matrix, shift, incomplete_, b, tolerance, iteration_limit);
      work.krylov_vectors += found.iterations;
      if (found.end == IterativeSolution::End::converged) return std::move(found.x);
      if (found.end == IterativeSolution::End::negative_curvature) return std::nullopt;
    }
  }
  ++work.factorisations;
  if (!complete_.factorise(matrix, shift)) return std::nullopt;
  return complete_.solve(b);
}

}  // namespace isojam
