#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/cohesion.hpp"
#include "engine/packing/packing.hpp"

namespace isojam::oracle {

/// The members of Evaluation in quadruple precision. They are computed from both doubles of positions, orientations and
/// vertices.
struct QuadEvaluation {
  Quad energy = 0;
  std::vector<Quad3> force, torque;  ///< force and torque on each particle, in the lab frame
  QuadMatrix virial{};               ///< Σ (∂E/∂r) rᵀ over contacts
  Quad mean_force = 0;               ///< mean of |F| over contacts
  Quad residual = 0;                 ///< largest |F_i| or |T_i|/R, divided by mean_force; 0 without contacts
  long contacts = 0;
};

/// Evaluates a packing by clipped_overlap() for all pairs of particles, which is slow. With cohesion, mean_force and
/// contacts are still those of the pairs that touch.
QuadEvaluation evaluate_in_quad(const Packing& packing, const std::optional<Cohesion>& cohesion = std::nullopt);

/// The gradient ∂E/∂(x, R·θ) with 6N entries, in the order of Evaluation::gradient.
std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing);
/// The gradient of E + p V_cell, followed by its derivatives with respect to the coordinates ℓ·ε of the free strains,
/// with ℓ = strain_length() (cell/control.hpp).
std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing, const CellControl& control);

/// The central difference (gradient(packing + h·direction) − gradient(packing − h·direction))/2h. Gradients are in
/// quadruple precision, so h may be far smaller than the depth of every contact.
Eigen::VectorXd difference_of_gradients(const Packing& packing, const Eigen::VectorXd& direction, double h);

}  // namespace isojam::oracle
