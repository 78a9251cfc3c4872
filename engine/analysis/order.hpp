#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Steinhardt's global Q_l of a set of n bonds, for even l. The bonds may have any length and either direction. Q_l is
/// 1 if all bonds are parallel, about 1/√n if they are independent, and 0 without bonds. The addition theorem
///   Q_l² = (4π/(2l+1)) Σ_m |⟨Y_lm⟩|² = (1/n²) Σ_ij P_l(cos γ_ij)
/// avoids the computation of spherical harmonics.
double steinhardt_order(std::span<const Eigen::Vector3d> bonds, unsigned l);

/// Steinhardt's Q6, computed from the centre-to-centre vectors of all contacts.
double contact_q6(std::span<const Contact> contacts);

/// Value of Q6 above which a packing counts as partly crystalline. It was chosen with 187 packings of 100 tetrahedra,
/// octahedra, dodecahedra or icosahedra near jamming. 175 packings had Q6 ≤ 0.281, and 12 had Q6 ≥ 0.359. The 12
/// packings consisted of icosahedra (11) or dodecahedra (1); their φ_J was higher by 0.02 to 0.08.
inline constexpr double crystalline_q6 = 0.32;

}  // namespace isojam
