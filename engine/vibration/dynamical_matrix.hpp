#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam {

// The dynamical matrix D of a packing, ω² u = D u, has the coordinates of PackingEnergy::hessian: r = {x, R·θ} per
// particle, R its radius of gyration. The mass of a particle is its volume. The mass tensor of the coordinate R·θ is
// I/R², since ½ θ'ᵀIθ' = ½ (Rθ')ᵀ(I/R²)(Rθ'). For spherical tops of unit volume both are 1, and D = ∂²E/∂r². Otherwise
// D = M^(-1/2) ∂²E/∂r² M^(-1/2) with the symmetric root, and a mode u displaces the particles by M^(-1/2) u. λ = ω² in
// (Y/ρ)·V_p^(-2/3).

/// D from the Hessian of the packing, which must not have a border.
BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian);

/// M^(-1/2) u for columns of 6N entries: displacements (x, R·θ) from modes of D.
Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes);

/// Largest entry of M^(-1) for rotations in principal axes: R²/I with the smallest moment of inertia of any particle. 1
/// for spherical tops of unit volume.
double greatest_inverse_mass(const Packing& packing);

/// Both halves of D, 6N × 6N, and of its border if it has one.
Eigen::SparseMatrix<double> sparse_matrix(const BlockMatrix& matrix);
/// The same as a dense matrix.
Eigen::MatrixXd dense_matrix(const BlockMatrix& matrix);

/// The three translations of the whole packing, 6N × 3, orthonormal: null vectors of D in any state.
Eigen::MatrixXd translations(const BlockMatrix& matrix);

/// Norm max_i Σ_j |D_ij|, an upper bound of all |λ|; 0 without contacts, infinity if D is not finite.
double norm_bound(const BlockMatrix& matrix);

/// Upper bound of the rounding error of an eigenvalue if |λ| is at most `lambda_max`: ε √(6N) (z + 1) · lambda_max, z
/// the largest number of off-diagonal blocks in a row. Entries are sums over contacts with an error of ε times the
/// stiffest one, and a row has z + 1 blocks of them. Errors of a factorisation or a sum over 6N entries accumulate like
/// a random walk (Higham and Mary 2019). An eigenvalue within this bound of 0 cannot be distinguished from 0.
double rounding_bound(const BlockMatrix& matrix, double lambda_max);

/// Test oracle for D, and the paper's method: central differences of the gradient,
///   (∇E(r + h e_k) − ∇E(r − h e_k)) / 2h
/// for each of the 6N coordinates, displaced as in minimisers, then symmetrised, since rotations of a particle that is
/// not in equilibrium do not commute. Needs 12N evaluations; dense, 6N × 6N. Correct only if h is smaller than the
/// depth of the shallowest flat contact; otherwise pairs close and open within a step. Throws std::invalid_argument
/// unless h > 0.
Eigen::MatrixXd difference_hessian(const Packing& packing, double h, Precision precision = Precision::double_double);

}  // namespace isojam
