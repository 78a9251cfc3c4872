#include "engine/geometry/placed_solid.hpp"

namespace isojam {

namespace {

struct Arrays {
  double *x, *y, *z;
};

void turn(const Eigen::Matrix3d& q, const double* x, const double* y, const double* z, int n, Arrays turned) {
  const double q00 = q(0, 0), q01 = q(0, 1), q02 = q(0, 2);
  const double q10 = q(1, 0), q11 = q(1, 1), q12 = q(1, 2);
  const double q20 = q(2, 0), q21 = q(2, 1), q22 = q(2, 2);
  for (int k = 0; k < (n + 3) / 4 * 4; ++k) {
    turned.x[k] = q00 * x[k] + q01 * y[k] + q02 * z[k];
    turned.y[k] = q10 * x[k] + q11 * y[k] + q12 * z[k];
    turned.z[k] = q20 * x[k] + q21 * y[k] + q22 * z[k];
  }
}

void set_row(const Eigen::Vector3d& v, double* row) { row[0] = v.x(), row[1] = v.y(), row[2] = v.z(), row[3] = 0; }

}  // namespace

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation)
    : solid_(&solid), rotation_(rotation) {
  const SolidArrays& body = solid.arrays();
  turn(rotation, body.x, body.y, body.z, body.vertices, {x_, y_, z_});
  turn(rotation, body.nx, body.ny, body.nz, body.faces, {normals_[0], normals_[1], normals_[2]});
  for (int v = 0; v < body.vertices; ++v) set_row(vertex(v), rows_[v]);
  for (int f = 0; f < body.faces; ++f) set_row(normal(f), normal_rows_[f]);
}

}  // namespace isojam
