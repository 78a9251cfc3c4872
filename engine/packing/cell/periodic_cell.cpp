#include "engine/packing/cell/periodic_cell.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

DoubleDoubleMatrix cube_of(double side) {
  DoubleDoubleMatrix vectors;
  vectors.high *= side;
  return vectors;
}

bool is_multiple_of_identity(const DoubleDoubleMatrix& m) {
  const Eigen::Matrix3d high = m.high(0, 0) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d low = m.low(0, 0) * Eigen::Matrix3d::Identity();
  return m.high == high && m.low == low;
}

DoubleDoubleVector column(const DoubleDoubleMatrix& m, int c) { return {m.high.col(c), m.low.col(c)}; }

/// v + k w.
DoubleDoubleVector sum(const DoubleDoubleVector& v, double k, const DoubleDoubleVector& w) {
  DoubleDoubleVector result;
  for (int c = 0; c < 3; ++c) result.set(c, v[c] + w[c] * k);
  return result;
}

/// Lattice vectors during the reduction, sorted by length.
using Basis = std::array<DoubleDoubleVector, 3>;

double length(const DoubleDoubleVector& v) { return v.high.norm(); }

void sort_by_length(Basis& basis) {
  std::stable_sort(basis.begin(), basis.end(), [](const auto& v, const auto& w) { return length(v) < length(w); });
}

/// Subtracts integer multiples of the first two vectors from the last vector to make it as short as possible. Returns
/// true if it became shorter by more than rounding errors.
bool shorten_last(Basis& basis) {
  const Eigen::Vector3d &a = basis[0].high, &b = basis[1].high, c = basis[2].high;
  // Coordinates of the projection of c on the plane of a and b. If a and b are reduced, the nearest lattice point is
  // one of the four lattice points around the projection.
  Eigen::Matrix2d gram;
  gram << a.dot(a), a.dot(b), a.dot(b), b.dot(b);
  const Eigen::Vector2d foot = gram.inverse() * Eigen::Vector2d(a.dot(c), b.dot(c));
  double best = c.norm();
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d trial(std::floor(foot[0]) + i, std::floor(foot[1]) + j);
      const double trial_length = (c - trial[0] * a - trial[1] * b).norm();
      if (trial_length < best * (1 - 1e-12)) best = trial_length, at = trial;
    }
  }
  if (at.isZero(0)) return false;
  basis[2] = sum(sum(basis[2], -at[0], basis[0]), -at[1], basis[1]);
  return true;
}

/// Subtracts an integer multiple of the first vector from the second vector to make it as short as possible (Lagrange).
/// Returns true if it became shorter by more than rounding errors.
bool shorten_second(Basis& basis) {
  const Eigen::Vector3d &a = basis[0].high, &b = basis[1].high;
  const double k = std::round(a.dot(b) / a.dot(a));
  if (!((b - k * a).norm() < b.norm() * (1 - 1e-12))) return false;
  basis[1] = sum(basis[1], -k, basis[0]);
  return true;
}

/// Semaev's algorithm (2001). Three vectors, sorted by length, are Minkowski-reduced if no vector becomes shorter by
/// subtraction of integer multiples of the earlier vectors. Every change shortens a vector by more than rounding
/// errors, so the loop ends. Returns true if a vector has changed.
bool reduce(Basis& basis) {
  bool changed = false;
  while (true) {
    sort_by_length(basis);
    if (shorten_second(basis) || shorten_last(basis)) {
      changed = true;
    } else {
      return changed;
    }
  }
}

}  // namespace

PeriodicCell::PeriodicCell(double side) : PeriodicCell(cube_of(side)) {}

PeriodicCell::PeriodicCell(const DoubleDoubleMatrix& vectors) : vectors_(vectors) {
  measure();
  if (!(std::isfinite(volume_) && volume_ > 0 && vectors.low.allFinite()))
    throw std::invalid_argument(
        "the vectors of a cell must be finite and right-handed, and the side of a cube positive");
}

void PeriodicCell::measure() {
  const Eigen::Matrix3d& h = vectors_.high;
  is_cube_ = is_multiple_of_identity(vectors_);
  side_ = h(0, 0);
  volume_ = is_cube_ ? side_ * side_ * side_ : h.col(0).dot(h.col(1).cross(h.col(2)));
  if (!is_cube_) side_ = nearest::cbrt(volume_);
  inverse_ = is_cube_ ? Eigen::Matrix3d(Eigen::Matrix3d::Identity() / side_) : Eigen::Matrix3d(h.inverse());
  for (int c = 0; c < 3; ++c) heights_[c] = is_cube_ ? side_ : 1 / inverse_.row(c).norm();
}

bool PeriodicCell::operator==(const PeriodicCell& other) const {
  return vectors_.high == other.vectors_.high && vectors_.low == other.vectors_.low;
}

DoubleDouble PeriodicCell::volume_double_double() const {
  const auto minor = [this](int r, int c) { return vectors_(r, 1) * vectors_(c, 2) - vectors_(c, 1) * vectors_(r, 2); };
  return vectors_(0, 0) * minor(1, 2) + vectors_(1, 0) * minor(2, 0) + vectors_(2, 0) * minor(0, 1);
}

Eigen::Vector3d PeriodicCell::fractional(const Eigen::Vector3d& d) const {
  if (is_cube_) return d / side_;
  return inverse_ * d;
}

DoubleDouble PeriodicCell::translation_double_double(int component, const Eigen::Vector3i& shift) const {
  if (is_cube_) {
    const DoubleDouble product = two_product(side_, shift[component]);
    return fast_two_sum(product.high, product.low + vectors_.low(0, 0) * shift[component]);
  }
  DoubleDouble result;
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble product = two_product(vectors_.high(component, c), shift[c]);
    result = short_sum(result, fast_two_sum(product.high, product.low + vectors_.low(component, c) * shift[c]));
  }
  return result;
}

Eigen::Vector3i PeriodicCell::nearest_shift(const Eigen::Vector3d& d) const {
  const Eigen::Vector3d s = fractional(d);
  Eigen::Vector3i shift;
  for (int c = 0; c < 3; ++c) shift[c] = -static_cast<int>(std::floor(s[c] + 0.5));
  return shift;
}

Eigen::Vector3d PeriodicCell::nearest_image(const Eigen::Vector3d& d) const {
  Eigen::Vector3d first = d + translation(nearest_shift(d));
  if (is_cube_) return first;
  // A nearer image is fewer cells away than the length of the first image divided by the height.
  const Eigen::Vector3i most = (first.norm() * heights_.cwiseInverse()).array().floor().cast<int>() + 1;
  Eigen::Vector3d best = first;
  for (int i = -most[0]; i <= most[0]; ++i) {
    for (int j = -most[1]; j <= most[1]; ++j) {
      for (int k = -most[2]; k <= most[2]; ++k) {
        const Eigen::Vector3d image = first + translation({i, j, k});
        if (image.squaredNorm() < best.squaredNorm()) best = image;
      }
    }
  }
  return best;
}

double PeriodicCell::shortest_translation() const {
  // The first vector of a Minkowski-reduced basis is the shortest translation.
  return is_cube_ ? side_ : reduced().vectors().high.colwise().norm().minCoeff();
}

PeriodicCell PeriodicCell::deformed(const DoubleDoubleMatrix& f) const { return PeriodicCell(f * vectors_); }

PeriodicCell PeriodicCell::reduced() const {
  if (is_cube_) return *this;
  Basis basis{column(vectors_, 0), column(vectors_, 1), column(vectors_, 2)};
  if (!reduce(basis)) return *this;
  if (basis[0].high.dot(basis[1].high.cross(basis[2].high)) < 0) basis[2] = -basis[2];
  DoubleDoubleMatrix vectors;
  for (int c = 0; c < 3; ++c) vectors.high.col(c) = basis[c].high, vectors.low.col(c) = basis[c].low;
  return PeriodicCell(vectors);
}

double least_side(const ConvexSolid& solid) { return 2 * solid.diameter(); }

bool is_legal(const PeriodicCell& cell, const ConvexSolid& solid) {
  return cell.shortest_translation() > least_side(solid);
}

double side_at(int n, double density) { return nearest::cbrt(n / density); }

int least_particles(const ConvexSolid& solid, double density) {
  int n = static_cast<int>(density * cubed(least_side(solid)));
  while (side_at(n, density) <= least_side(solid)) ++n;
  return n;
}

}  // namespace isojam
