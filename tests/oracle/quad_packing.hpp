#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/packing.hpp"

namespace isojam::oracle {

/// The members of Evaluation in quadruple precision, with the low parts of positions, orientations and solid.
struct QuadEvaluation {
  Quad energy = 0;
  std::vector<Quad3> force, torque;  ///< per particle, lab frame
  QuadMatrix virial{};               ///< Σ (∂E/∂r) rᵀ over touching pairs
  Quad mean_force = 0;               ///< mean of |F| over touching pairs
  Quad residual = 0;                 ///< max of |F_i|, |T_i|/R over mean_force; 0 without contacts
  long contacts = 0;
};

/// Computes every pair by clipped_overlap, from all pairs of particles: slow.
QuadEvaluation evaluate_in_quad(const Packing& packing);

/// ∂E/∂(x, R·θ), 6N entries, in the order of Evaluation::gradient.
std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing);
/// The same for E + p V, followed by the derivatives with respect to the free strains ℓ·ε.
std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing, const CellControl& control);

/// (gradient(packing + h·direction) − gradient(packing − h·direction))/2h, with gradients in quadruple precision, so
/// that h may be far below the depth of every contact.
Eigen::VectorXd difference_of_gradients(const Packing& packing, const Eigen::VectorXd& direction, double h);

}  // namespace isojam::oracle
