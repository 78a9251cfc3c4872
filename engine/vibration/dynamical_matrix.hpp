#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam {

// The dynamical matrix D of a packing, ω² u = D u, has the coordinates of PackingEnergy::hessian, r = {x, R·θ} per
// particle, R its radius of gyration. A particle has as mass its volume, and the coordinate R·θ the tensor of mass
// I/R², since ½ θ'ᵀIθ' = ½ (Rθ')ᵀ(I/R²)(Rθ'). For spherical tops of unit volume both are 1, and D = ∂²E/∂r². Otherwise
// D = M^(-1/2) ∂²E/∂r² M^(-1/2) with the symmetric root, and a mode moves the particles by M^(-1/2) u.
// λ = ω² in (Y/ρ)·V_p^(-2/3).

/// D from the Hessian of the packing, which may have no border.
BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian);

/// M^(-1/2) u, columns of 6N: displacements (x, R·θ) from modes of D.
Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes);

/// The greatest entry of M^(-1) for turns, in principal axes, R²/I of the least moment of any particle: by how much
/// more than R·θ a torque turns. 1 for spherical tops of unit volume.
double greatest_inverse_mass(const Packing& packing);

/// Both halves of D, 6N × 6N, and of its border where it has one.
Eigen::SparseMatrix<double> sparse_matrix(const BlockMatrix& matrix);
/// The same, dense.
Eigen::MatrixXd dense_matrix(const BlockMatrix& matrix);

/// The three translations of the packing as a whole, 6N × 3, orthonormal: null vectors of D in any state.
Eigen::MatrixXd translations(const BlockMatrix& matrix);

/// Norm max_i Σ_j |D_ij|, which no |λ| exceeds; 0 without contacts, infinity if D is not finite.
double norm_bound(const BlockMatrix& matrix);

/// Bound on what rounding does to an eigenvalue when |λ| goes up to `lambda_max`: ε √(6N) (z + 1) · lambda_max, z the
/// most blocks beside the diagonal in a row. Entries are sums over contacts and wrong by ε of the stiffest, a row has
/// z + 1 blocks of them, and errors of a factorisation or a sum over 6N of them add up as in a random walk (Higham and
/// Mary 2019). No eigenvalue nearer to 0 can be told from 0.
double rounding_bound(const BlockMatrix& matrix, double lambda_max);

/// The oracle for D, and the paper's way to it: central differences of the gradient,
///   (∇E(r + h e_k) − ∇E(r − h e_k)) / 2h
/// for each of the 6N coordinates, moved as minimisers move them, then symmetrised (turns of a particle that is not
/// in balance do not commute). 12N evaluations; dense, 6N × 6N. Right only while h is smaller than the shallowest flat
/// contact is deep, beyond which pairs close and open within a step. Throws std::invalid_argument unless h > 0.
Eigen::MatrixXd difference_hessian(const Packing& packing, double h, Precision precision = Precision::double_double);

}  // namespace isojam
