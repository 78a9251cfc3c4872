#include "engine/geometry/placed_solid.hpp"

#include <cassert>

namespace isojam {

namespace {

constexpr int block = PlacedSolid::block;

struct ConstArrays {
  const double *x, *y, *z;
};

ConstArrays arrays_of(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  return {x.data(), y.data(), z.data()};
}

/// Rotates the n vectors v and stores them in blocks.
void rotate(const Eigen::Matrix3d& q, ConstArrays v, int n, double* rotated) {
  const double q00 = q(0, 0), q01 = q(0, 1), q02 = q(0, 2);
  const double q10 = q(1, 0), q11 = q(1, 1), q12 = q(1, 2);
  const double q20 = q(2, 0), q21 = q(2, 1), q22 = q(2, 2);
  for (int first = 0; first < n; first += 4, rotated += block) {
    const double *x = v.x + first, *y = v.y + first, *z = v.z + first;
    for (int k = 0; k < 4; ++k) rotated[k] = q00 * x[k] + q01 * y[k] + q02 * z[k];
    for (int k = 0; k < 4; ++k) rotated[4 + k] = q10 * x[k] + q11 * y[k] + q12 * z[k];
    for (int k = 0; k < 4; ++k) rotated[8 + k] = q20 * x[k] + q21 * y[k] + q22 * z[k];
  }
}

/// One component of four vectors (x + x_low, …), rotated in double-double.
void rotate_row(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c, ConstArrays v, ConstArrays v_low,
                double* rotated, double* rotated_low) {
  const double *x = v.x, *y = v.y, *z = v.z, *x_low = v_low.x, *y_low = v_low.y, *z_low = v_low.z;
  // There are too many arrays for g++ to check that they are distinct. clang has no such pragma, and does check them.
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (int k = 0; k < 4; ++k) {
    const DoubleDouble ax = two_product(a.high, x[k]), by = two_product(b.high, y[k]), cz = two_product(c.high, z[k]);
    const DoubleDouble two = two_sum(ax.high, by.high), three = two_sum(two.high, cz.high);
    const double first_order =
        (a.high * x_low[k] + a.low * x[k]) + (b.high * y_low[k] + b.low * y[k]) + (c.high * z_low[k] + c.low * z[k]);
    const DoubleDouble sum = fast_two_sum(three.high, (two.low + three.low) + (ax.low + by.low + cz.low) + first_order);
    rotated[k] = sum.high;
    rotated_low[k] = sum.low;
  }
}

void rotate(const DoubleDoubleMatrix& q, ConstArrays v, ConstArrays v_low, int n, double* rotated,
            double* rotated_low) {
  for (int first = 0; first < n; first += 4, rotated += block, rotated_low += block) {
    const ConstArrays high{v.x + first, v.y + first, v.z + first};
    const ConstArrays low{v_low.x + first, v_low.y + first, v_low.z + first};
    for (int row = 0; row < 3; ++row)
      rotate_row(q(row, 0), q(row, 1), q(row, 2), high, low, rotated + 4 * row, rotated_low + 4 * row);
  }
}

/// Number of doubles for n vectors.
std::ptrdiff_t room(int n) { return std::ptrdiff_t{block} * ((n + 3) / 4); }

constexpr std::ptrdiff_t line = 8;  ///< doubles

/// Memory of one solid in lines: vertices, normals and the rotation.
std::size_t lines_of(const ConvexSolid& solid) {
  constexpr std::ptrdiff_t matrix = 9;
  return static_cast<std::size_t>((room(solid.arrays().vertices) + room(solid.arrays().faces) + matrix + line - 1) /
                                  line);
}

}  // namespace

void PlacedSolids::resize(const ConvexSolid& solid, std::size_t count, bool low) {
  // Once allocated, low parts are kept, so that occasional requests for them do not reallocate every time.
  has_low_ = low || (has_low_ && solid_ == &solid);
  solid_ = &solid;
  count_ = count;
  places_.clear();
  stride_ = lines_of(solid);
  to_normals_ = room(solid.arrays().vertices);
  to_low_ = line * static_cast<std::ptrdiff_t>(stride_ * count);
  lines_.resize(stride_ * count * (has_low_ ? 2 : 1));
}

void PlacedSolids::resize(std::span<const ConvexSolid* const> solids, bool low) {
  solid_ = nullptr;
  count_ = solids.size();
  has_low_ = low;
  places_.clear();
  std::size_t lines = 0;
  for (const ConvexSolid* solid : solids) {
    places_.push_back({solid, lines});
    lines += lines_of(*solid);
  }
  to_low_ = line * static_cast<std::ptrdiff_t>(lines);
  lines_.resize(lines * (low ? 2 : 1));
}

PlacedSolid PlacedSolids::unlike(std::size_t k) const {
  const ConvexSolid& solid = *places_[k].solid;
  const double* at = &lines_[places_[k].line].value[0];
  return {solid, at, at + room(solid.arrays().vertices), to_low_};
}

std::pair<const ConvexSolid*, double*> PlacedSolids::room_of(std::size_t k) {
  if (solid_ != nullptr) return {solid_, &lines_[k * stride_].value[0]};
  return {places_[k].solid, &lines_[places_[k].line].value[0]};
}

void PlacedSolids::place(std::size_t k, const Eigen::Matrix3d& rotation) {
  auto [solid, at] = room_of(k);
  const SolidArrays& body = solid->arrays();
  rotate(rotation, arrays_of(body.x, body.y, body.z), body.vertices, at);
  at += room(body.vertices);
  rotate(rotation, arrays_of(body.nx, body.ny, body.nz), body.faces, at);
  at += room(body.faces);
  Eigen::Map<Eigen::Matrix3d>{at} = rotation;
}

void PlacedSolids::place(std::size_t k, const DoubleDoubleMatrix& rotation) {
  assert(has_low_);
  auto [solid, at] = room_of(k);
  const SolidArrays& body = solid->arrays();
  double* low = at + to_low_;
  rotate(rotation, arrays_of(body.x, body.y, body.z), arrays_of(body.x_low, body.y_low, body.z_low), body.vertices, at,
         low);
  at += room(body.vertices), low += room(body.vertices);
  rotate(rotation, arrays_of(body.nx, body.ny, body.nz), arrays_of(body.nx_low, body.ny_low, body.nz_low), body.faces,
         at, low);
  at += room(body.faces), low += room(body.faces);
  Eigen::Map<Eigen::Matrix3d>{at} = rotation.high;
  Eigen::Map<Eigen::Matrix3d>{low} = rotation.low;
}

LonePlacedSolid::LonePlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation) {
  alone_.resize(solid, 1, false);
  alone_.place(0, rotation);
}

LonePlacedSolid::LonePlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation) {
  alone_.resize(solid, 1, true);
  alone_.place(0, rotation);
}

}  // namespace isojam
