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

/// Vectors (x + x_low, …), n of them, turned in two doubles; n a multiple of 4, so that the loop is vectorised.
void turn(const TwoDoubleMatrix& rotation, const double* high[3], const double* low[3], int n, double* turned,
          double* turned_low) {
  for (int row = 0; row < 3; ++row, turned += n, turned_low += n) {
    const TwoDouble a = rotation(row, 0), b = rotation(row, 1), c = rotation(row, 2);
    for (int k = 0; k < n; ++k) {
      const double x = high[0][k], y = high[1][k], z = high[2][k];
      const TwoDouble ax = two_product(a.high, x), by = two_product(b.high, y), cz = two_product(c.high, z);
      const TwoDouble two = two_sum(ax.high, by.high), three = two_sum(two.high, cz.high);
      const double first_order =
          (a.high * low[0][k] + a.low * x) + (b.high * low[1][k] + b.low * y) + (c.high * low[2][k] + c.low * z);
      const double rest = (two.low + three.low) + (ax.low + by.low + cz.low) + first_order;
      const TwoDouble sum = fast_two_sum(three.high, rest);
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
  const double* vertices[] = {body.x, body.y, body.z};
  const double* vertices_low[] = {body.x_low, body.y_low, body.z_low};
  const double* normals[] = {body.nx, body.ny, body.nz};
  const double* normals_low[] = {body.nx_low, body.ny_low, body.nz_low};
  const int first_normal = 3 * vertex_stride_;
  turn(rotation, vertices, vertices_low, vertex_stride_, pool_, low_);
  turn(rotation, normals, normals_low, face_stride_, pool_ + first_normal, low_ + first_normal);
  for (int row = 0; row < 3; ++row) {
    for (int k = body.faces; k < face_stride_; ++k)
      pool_[first_normal + row * face_stride_ + k] = low_[first_normal + row * face_stride_ + k] = 0;
  }
}

}  // namespace isojam
