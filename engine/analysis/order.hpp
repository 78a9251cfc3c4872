#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Steinhardt's global Q_l of a set of bonds (any length, either direction; l even): 1 if all are parallel, about
/// 1/sqrt(number of bonds) if they are independent. By the addition theorem
///   Q_l² = (4π/(2l+1)) Σ_m |⟨Y_lm⟩|² = (1/n²) Σ_ij P_l(cos γ_ij),
/// so no spherical harmonic is ever computed. 0 without bonds.
double steinhardt_order(std::span<const Eigen::Vector3d> bonds, unsigned l);

/// Q6 over the centre-to-centre lines of all contacts.
double contact_q6(std::span<const Contact> contacts);

/// Packings above count as partly crystalline. At N = 64 fifteen disordered packings gave .04 to .27, and a crystalline
/// one of icosahedra .47; larger packings scatter less.
inline constexpr double crystalline_q6 = 0.35;

}  // namespace isojam
