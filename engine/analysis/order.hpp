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

/// Q6 above which packings count as partly crystalline. Of 187 packings of N = 100 near jamming (tetrahedra to
/// icosahedra) 175 had Q6 up to .281 and 12 from .359 on, 11 of icosahedra and one of dodecahedra, whose φ_J were
/// higher by .02 to .08.
inline constexpr double crystalline_q6 = 0.32;

}  // namespace isojam
