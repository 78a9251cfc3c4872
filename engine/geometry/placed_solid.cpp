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

}  // namespace

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation)
    : rotation_(rotation),
      solid_(&solid),
      vertex_stride_(padded(solid.arrays().vertices)),
      face_stride_(padded(solid.arrays().faces)) {
  const SolidArrays& body = solid.arrays();
  turn(rotation, body.x, body.y, body.z, vertex_stride_, pool_);
  turn(rotation, body.nx, body.ny, body.nz, face_stride_, pool_ + 3 * vertex_stride_);
}

}  // namespace isojam
