#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

// Strain is logarithmic: r → exp(ε) r for every centre-to-centre vector r, ε symmetric; orientations do not change. A
// traceless ε then preserves the volume to all orders. Symmetric tensors are written in the orthonormal basis
//   (ε_xx, ε_yy, ε_zz, √2 ε_yz, √2 ε_zx, √2 ε_xy)   (Mandel),
// in which rotations are orthogonal and the eigenvalues of a 6×6 matrix are those of the tensor.

/// The tensor with these six components.
Eigen::Matrix3d strain_tensor(const Vector6d& components);
/// The six components of the symmetric part of a tensor.
Vector6d strain_components(const Eigen::Matrix3d& tensor);

/// 3 × 6 matrix: column I is the change of r due to the I-th unit strain.
using Strains = Eigen::Matrix<double, 3, 6>;
/// Changes of a centre-to-centre vector r.
Strains strained(const Eigen::Vector3d& r);

/// Orthonormal basis of the traceless tensors, as columns.
Eigen::Matrix<double, 6, 5> traceless_basis();
/// The normalised tensor along the trace: the identity divided by √3.
Vector6d trace_direction();

/// exp(ε) with an error of at most 1e-31; ε need not be symmetric, |ε| < 1.
DoubleDoubleMatrix exponential(const Eigen::Matrix3d& strain);

}  // namespace isojam
