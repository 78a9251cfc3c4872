#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Steinhardt's global Q_l of a set of n bonds, for even l. Bonds may have any length, and either of their two
/// directions. Q_l is 1 if all bonds are parallel, about 1/√n if they are independent, and 0 without bonds. It is
/// computed with the addition theorem, which avoids the spherical harmonics Y_lm:
///   Q_l² = (4π/(2l+1)) Σ_m |⟨Y_lm⟩|² = (1/n²) Σ_ij P_l(cos γ_ij)
/// P_l is the Legendre polynomial, and γ_ij is the angle between bonds i and j.
double steinhardt_order(std::span<const Eigen::Vector3d> bonds, unsigned l);

/// Steinhardt's Q6, computed from the centre-to-centre vectors of all contacts.
double contact_q6(std::span<const Contact> contacts);

/// Value of Q6 above which a packing is called crystalline. In 187 packings of 100 tetrahedra, octahedra, dodecahedra
/// or icosahedra near jamming, Q6 was either at most 0.281 (175 packings) or at least 0.359 (12 packings). φ_J of the
/// 12 packings was higher than φ_J of the others by 0.02 to 0.08. Eleven of them were packings of icosahedra, and one
/// was a packing of dodecahedra.
inline constexpr double crystalline_q6 = 0.32;

}  // namespace isojam
