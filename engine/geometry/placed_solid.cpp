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

struct ConstArrays {
  const double *x, *y, *z;
};

/// One component of the vectors (x + x_low, …), turned in double-double.
void turn_row(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c, ConstArrays v, ConstArrays v_low,
              int n, double* turned, double* turned_low) {
  const double *x = v.x, *y = v.y, *z = v.z, *x_low = v_low.x, *y_low = v_low.y, *z_low = v_low.z;
#pragma GCC ivdep  // too many arrays for the compiler to check that they are distinct
  for (int k = 0; k < (n + 3) / 4 * 4; ++k) {
    const DoubleDouble ax = two_product(a.high, x[k]), by = two_product(b.high, y[k]), cz = two_product(c.high, z[k]);
    const DoubleDouble two = two_sum(ax.high, by.high), three = two_sum(two.high, cz.high);
    const double first_order =
        (a.high * x_low[k] + a.low * x[k]) + (b.high * y_low[k] + b.low * y[k]) + (c.high * z_low[k] + c.low * z[k]);
    const DoubleDouble sum = fast_two_sum(three.high, (two.low + three.low) + (ax.low + by.low + cz.low) + first_order);
    turned[k] = sum.high;
    turned_low[k] = sum.low;
  }
}

void turn(const DoubleDoubleMatrix& q, ConstArrays v, ConstArrays v_low, int n, Arrays turned, Arrays turned_low) {
  turn_row(q(0, 0), q(0, 1), q(0, 2), v, v_low, n, turned.x, turned_low.x);
  turn_row(q(1, 0), q(1, 1), q(1, 2), v, v_low, n, turned.y, turned_low.y);
  turn_row(q(2, 0), q(2, 1), q(2, 2), v, v_low, n, turned.z, turned_low.z);
}
void set_row(const Eigen::Vector3d& v, double* row) { row[0] = v.x(), row[1] = v.y(), row[2] = v.z(), row[3] = 0; }

}  // namespace

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation)
    : solid_(&solid), rotation_(rotation) {
  const SolidArrays& body = solid.arrays();
  turn(rotation, body.x, body.y, body.z, body.vertices, {x_, y_, z_});
  turn(rotation, body.nx, body.ny, body.nz, body.faces, {normals_[0], normals_[1], normals_[2]});
  copy_rows();
}

PlacedSolid::PlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation)
    : solid_(&solid), rotation_(rotation.high), rotation_low_(rotation.low) {
  const SolidArrays& body = solid.arrays();
  turn(rotation, {body.x, body.y, body.z}, {body.x_low, body.y_low, body.z_low}, body.vertices, {x_, y_, z_},
       {x_low_, y_low_, z_low_});
  turn(rotation, {body.nx, body.ny, body.nz}, {body.nx_low, body.ny_low, body.nz_low}, body.faces,
       {normals_[0], normals_[1], normals_[2]}, {nx_low_, ny_low_, nz_low_});
  copy_rows();
}

void PlacedSolid::copy_rows() {
  for (int v = 0; v < vertices(); ++v) set_row(vertex(v), rows_[v]);
  for (int f = 0; f < faces(); ++f) set_row(normal(f), normal_rows_[f]);
}

}  // namespace isojam
