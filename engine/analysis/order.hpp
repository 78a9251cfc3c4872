#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Steinhardt's global Q_l of a set of bonds (any length and direction; l even): 1 if all are parallel, about
/// 1/sqrt(number of bonds) if they are independent. The addition theorem
///   Q_l² = (4π/(2l+1)) Σ_m |⟨Y_lm⟩|² = (1/n²) Σ_ij P_l(cos γ_ij)
/// avoids spherical harmonics. 0 without bonds.
double steinhardt_order(std::span<const Eigen::Vector3d> bonds, unsigned l);

/// Q6 over the centre-to-centre vectors of all contacts.
double contact_q6(std::span<const Contact> contacts);

/// Q6 above which a packing counts as partly crystalline. Calibrated on 187 packings of 100 particles near jamming
/// (tetrahedra to icosahedra): 175 had Q6 ≤ 0.281 and 12 had Q6 ≥ 0.359. The 12 were 11 packings of icosahedra and one
/// of dodecahedra; their φ_J was higher by 0.02 to 0.08.
inline constexpr double crystalline_q6 = 0.32;

}  // namespace isojam
