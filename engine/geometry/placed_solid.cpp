#include "engine/geometry/placed_solid.hpp"

namespace isojam {

namespace {

constexpr int padded(int n) { return (n + 3) & ~3; }

void turn(const Eigen::Matrix3d& rotation, const double* x, const double* y, const double* z, int n, double* turned) {
  for (int row = 0; row < 3; ++row, turned += n) {
    const double a = rotation(row, 0), b = rotation(row, 1), c = rotation(row, 2);
    for (int k = 0; k < n; ++k) turned[k] = a * x[k] + b * y[k] + c * z[k];
  }
}

/// n vectors as arrays of their components, and of the low parts of these.
struct VectorArrays {
  const double *x, *y, *z, *x_low, *y_low, *z_low;
};

/// The vectors turned in two doubles.
void turn(const TwoDoubleMatrix& rotation, const VectorArrays& v, int n, double* turned, double* turned_low) {
  const double *x = v.x, *y = v.y, *z = v.z, *x_low = v.x_low, *y_low = v.y_low, *z_low = v.z_low;
  for (int row = 0; row < 3; ++row, turned += n, turned_low += n) {
    const TwoDouble a = rotation(row, 0), b = rotation(row, 1), c = rotation(row, 2);
#pragma GCC ivdep  // too many arrays for the compiler to check that they are distinct
    for (int k = 0; k < n; ++k) {
      const TwoDouble ax = two_product(a.high, x[k]), by = two_product(b.high, y[k]), cz = two_product(c.high, z[k]);
      const TwoDouble two = two_sum(ax.high, by.high), three = two_sum(two.high, cz.high);
      const double first_order =
          (a.high * x_low[k] + a.low * x[k]) + (b.high * y_low[k] + b.low * y[k]) + (c.high * z_low[k] + c.low * z[k]);
      const TwoDouble sum = fast_two_sum(three.high, (two.low + three.low) + (ax.low + by.low + cz.low) + first_order);
      turned[k] = sum.high;
      turned_low[k] = sum.low;
    }
  }
}

}  // namespace

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation)
    : rotation_(rotation),
      solid_(&solid),
      vertex_stride_(padded(solid.arrays().vertices)),
      face_stride_(padded(solid.arrays().faces)) {
  const SolidArrays& body = solid.arrays();
  double* normals = pool_ + 3 * vertex_stride_;
  turn(rotation, body.x, body.y, body.z, vertex_stride_, pool_);
  turn(rotation, body.nx, body.ny, body.nz, face_stride_, normals);
  for (int row = 0; row < 3; ++row) {
    for (int k = body.faces; k < face_stride_; ++k) normals[row * face_stride_ + k] = 0;
  }
}

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const TwoDoubleMatrix& rotation)
    : rotation_(rotation.high),
      rotation_low_(rotation.low),
      solid_(&solid),
      vertex_stride_(padded(solid.arrays().vertices)),
      face_stride_(padded(solid.arrays().faces)) {
  const SolidArrays& body = solid.arrays();
  const VectorArrays vertices{body.x, body.y, body.z, body.x_low, body.y_low, body.z_low};
  const VectorArrays normals{body.nx, body.ny, body.nz, body.nx_low, body.ny_low, body.nz_low};
  const int first_normal = 3 * vertex_stride_;
  turn(rotation, vertices, vertex_stride_, pool_, low_);
  turn(rotation, normals, face_stride_, pool_ + first_normal, low_ + first_normal);
  for (int row = 0; row < 3; ++row) {
    for (int k = body.faces; k < face_stride_; ++k)
      pool_[first_normal + row * face_stride_ + k] = low_[first_normal + row * face_stride_ + k] = 0;
  }
}

}  // namespace isojam
