#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam {

// The dynamical matrix D of a packing has the eigenvalue equation D u = λ u with λ = ω², in units of (Y/ρ)·V_p^(-2/3).
// Its coordinates are those of PackingEnergy::hessian: r = {x, R·θ} for each particle, where R is the radius of
// gyration. M contains the mass of each particle, which is its volume, because ρ = 1, and for the coordinate R·θ the
// mass tensor I/R², because the kinetic energy of a rotation is ½ θ'ᵀIθ' = ½ (Rθ')ᵀ(I/R²)(Rθ') at the angular velocity
// θ' and the tensor of inertia I. Then D = M^(-1/2) ∂²E/∂r² M^(-1/2), and a mode u displaces the particles by M^(-1/2)
// u. If all particles are spherical tops (three equal moments of inertia) of unit volume, M = 1 and D = ∂²E/∂r².

/// Computes D from the Hessian of the packing. The Hessian must not have a border.
BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian);

/// Computes the displacements M^(-1/2) u of the particles in modes u of D, as coordinates (x, R·θ). Each column of
/// `modes` is one mode with 6N entries.
Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes);

/// Largest value of R²/I over all particles and all principal moments of inertia I. It is the largest eigenvalue of the
/// part of M^(-1) that belongs to rotations, and 1 for spherical tops of unit volume.
double greatest_inverse_mass(const Packing& packing);

/// All entries of the symmetric matrix as a dense matrix. It has 6N × 6N entries, or more if there is a border.
Eigen::MatrixXd dense_matrix(const BlockMatrix& matrix);

/// The three translations t of the whole packing as orthonormal columns, 6N × 3. D t = 0 in any state.
Eigen::MatrixXd translations(const BlockMatrix& matrix);

/// The norm max_i Σ_j |D_ij|, an upper bound of all |λ|. It is 0 without contacts, and infinite if D is not finite.
double norm_bound(const BlockMatrix& matrix);

/// Upper bound of the rounding error of an eigenvalue, below which an eigenvalue cannot be distinguished from 0:
/// ε √(6N) (z + 1) λ_max, where λ_max is the largest |λ|, z is the largest number of off-diagonal blocks in a row, and
/// ε = 2⁻⁵². The factor z + 1 is there because entries of D are sums over contacts with an error of ε times the
/// stiffness of the stiffest contact, and the root because the errors of a factorisation or of a sum over 6N entries
/// accumulate like a random walk (Higham and Mary 2019).
double rounding_bound(const BlockMatrix& matrix, double lambda_max);

/// Computes the Hessian by the method of the paper, central differences of the gradient,
///   (∇E(r + h e_k) − ∇E(r − h e_k)) / 2h
/// for each coordinate k of the 6N coordinates, with h in units of V_p^(1/3). Tests use the result as a reference for
/// the analytic Hessian. It is a dense 6N × 6N matrix, which needs 12N evaluations, and it is symmetrised, because
/// rotations do not commute out of equilibrium. It is correct only if h is smaller than the depth of the flattest
/// contact, because contacts otherwise form and break within a step. Throws std::invalid_argument unless h > 0.
Eigen::MatrixXd difference_hessian(const Packing& packing, double h, Precision precision = Precision::double_double);

}  // namespace isojam
