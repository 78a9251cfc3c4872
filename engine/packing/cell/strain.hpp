#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

// Strains are logarithmic: a strain ε changes every centre-to-centre vector r to exp(ε) r. It does not change
// orientations. With this definition, a traceless ε preserves the volume exactly. Symmetric tensors are written as six
// components in an orthonormal basis (Mandel):
//   (ε_xx, ε_yy, ε_zz, √2 ε_yz, √2 ε_zx, √2 ε_xy)
// In this basis, an orthogonal 6×6 matrix represents a rotation of tensors. A 6×6 matrix has the same eigenvalues as
// the fourth-rank tensor that it represents.

/// The symmetric tensor with these components.
Eigen::Matrix3d strain_tensor(const Vector6d& components);
/// The components of the symmetric part of a tensor.
Vector6d strain_components(const Eigen::Matrix3d& tensor);

/// Column k is the derivative of a vector r with respect to the k-th component of the strain, at zero strain.
using Strains = Eigen::Matrix<double, 3, 6>;
/// The derivatives of r with respect to the six components of the strain.
Strains strained(const Eigen::Vector3d& r);

/// Orthonormal basis of the traceless symmetric tensors. Each column has the components of one tensor.
Eigen::Matrix<double, 6, 5> traceless_basis();
/// Components of the isotropic tensor of unit length: the identity divided by √3.
Vector6d trace_direction();

/// Computes exp(ε). The error of each entry is at most 1e-31. ε may be any matrix with a Frobenius norm below 1.
DoubleDoubleMatrix exponential(const Eigen::Matrix3d& strain);

}  // namespace isojam
