#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam {

// The dynamical matrix D of a packing has the eigenvalue equation D u = λ u with λ = ω². It uses the coordinates of
// PackingEnergy::hessian, r = {x, R·θ} for each particle, where R is the radius of gyration. The mass of a particle is
// its volume. The mass tensor of the coordinate R·θ is I/R², because ½ θ'ᵀIθ' = ½ (Rθ')ᵀ(I/R²)(Rθ'). For spherical tops
// of unit volume, mass and mass tensor are 1, and D = ∂²E/∂r². Otherwise D = M^(-1/2) ∂²E/∂r² M^(-1/2) with the
// symmetric root, and a mode u displaces the particles by M^(-1/2) u. λ is in units of (Y/ρ)·V_p^(-2/3).

/// Computes D from the Hessian of the packing. The Hessian must not have a border.
BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian);

/// Computes the displacements (x, R·θ) = M^(-1/2) u of the particles from modes u of D. Each column of `modes` is one
/// mode with 6N entries.
Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes);

/// Largest value of R²/I over all particles and all principal moments of inertia I: the largest eigenvalue of M^(-1)
/// for rotations. It is 1 for spherical tops of unit volume.
double greatest_inverse_mass(const Packing& packing);

/// All entries of the symmetric matrix as a sparse matrix, 6N × 6N, with the border if there is one.
Eigen::SparseMatrix<double> sparse_matrix(const BlockMatrix& matrix);
/// All entries of the symmetric matrix as a dense matrix.
Eigen::MatrixXd dense_matrix(const BlockMatrix& matrix);

/// The three translations of the whole packing as orthonormal columns, 6N × 3. They are null vectors of D in any state.
Eigen::MatrixXd translations(const BlockMatrix& matrix);

/// The norm max_i Σ_j |D_ij|, an upper bound of all |λ|. It is 0 without contacts, and infinite if D is not finite.
double norm_bound(const BlockMatrix& matrix);

/// Upper bound of the rounding error of an eigenvalue: ε √(6N) (z + 1) · lambda_max. Here lambda_max is the largest
/// |λ|, and z is the largest number of off-diagonal blocks in a row. The bound follows from two estimates. Entries of D
/// are sums over contacts; their error is ε times the stiffness of the stiffest contact, and a row has z + 1 blocks of
/// such entries. The errors of a factorisation or of a sum over 6N entries accumulate like a random walk (Higham and
/// Mary 2019). An eigenvalue whose magnitude is below this bound cannot be distinguished from 0.
double rounding_bound(const BlockMatrix& matrix, double lambda_max);

/// Computes the Hessian by the method of the paper, central differences of the gradient,
///   (∇E(r + h e_k) − ∇E(r − h e_k)) / 2h
/// for each of the 6N coordinates, displaced as by moved(). Tests use it as a reference for the analytic Hessian. The
/// matrix is symmetrised, because rotations of a particle that is not in equilibrium do not commute. The result is a
/// dense 6N × 6N matrix and needs 12N evaluations. It is correct only if h is smaller than the depth of the flattest
/// contact; otherwise contacts form and break within a step. Throws std::invalid_argument unless h > 0.
Eigen::MatrixXd difference_hessian(const Packing& packing, double h, Precision precision = Precision::double_double);

}  // namespace isojam
