#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/packing.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Motions that change no contact's volume to first order, ∇V_c·u = 0 for all contacts c, without the three
/// translations: what counting one constraint for each contact leaves free, 6N − 3 − rank of them.
struct FloppyMotions {
  Eigen::MatrixXd vectors;  ///< 6N × motions; the largest motion of a particle, |(dx, R·dθ)|, is 1
  Eigen::VectorXd stiffness;  ///< uᵀHu/uᵀu, ascending: the second term of H = ½ ggᵀ + ½ V ∇²V alone opposes them
};

/// Of a state with these normal rows and the Hessian of its energy, which may have no border; the motions diagonalise
/// the Hessian among themselves. Dense: O(N³), N = 100 takes half a second.
FloppyMotions floppy_motions(const RigidityMatrix& normals, const BlockMatrix& hessian);

/// How the energy grows along straight motions, ½[E(+a u) + E(−a u)] − E(0).
struct EnergyAlong {
  Eigen::MatrixXd rise;  ///< motions × amplitudes, Y·V_p
  /// What rounding may make of a rise; a smaller one means nothing.
  double noise = 0;
};

/// Of each column of `motions` (6N, moved() takes them) at each amplitude a, V_p^(1/3). From the whole double-double
/// state: the energy is right to its last bits, its differences to `noise`.
EnergyAlong energy_along(const Packing& packing, const Eigen::MatrixXd& motions, std::span<const double> amplitudes);

}  // namespace isojam
