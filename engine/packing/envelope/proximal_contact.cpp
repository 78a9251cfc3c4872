#include "engine/packing/envelope/proximal_contact.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

// The function F(w) = e(w) + ½ ρ |w|² − μ·w is strictly convex, except where e is slightly non-convex. Newton's method
// finds its minimum in three or four steps unless it meets a kink of ∇e. ∇e has a kink where a gap closes, and where
// the line in which two face planes intersect begins to cross a face. There Newton's method would jump back and forth
// between both sides of the kink. A line search therefore ends each step where the slope of F is a fraction of its
// initial value.

namespace isojam {

namespace {

/// Required residual |∇F| / (|∇e| + |μ|), and the residual that is accepted if rounding errors prevent further
/// progress.
constexpr double goal = 1e-12, enough = 1e-9;
constexpr int most_steps = 60, most_probes = 30;

/// Fractions of the initial slope. A full step is accepted if the slope at its end is at most `overshoot`. A shorter
/// step is accepted if the magnitude of the slope at its end is at most `flat_enough`.
constexpr double overshoot = 0.5, flat_enough = 0.3;

/// Largest displacement of the ghost in one step, in units of the inradius.
constexpr double longest_step = 0.2;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

/// Cholesky factor of a symmetric matrix. If the matrix is not positive definite, a multiple of the identity is added:
/// first scale/4, then four times as much until the result is positive definite.
Eigen::LLT<Matrix6d> factorised(const Matrix6d& matrix, double scale) {
  Eigen::LLT<Matrix6d> factor(matrix);
  double shift = scale / 4;
  while (factor.info() != Eigen::Success && std::isfinite(shift)) {
    factor.compute(matrix + shift * Matrix6d::Identity());
    shift *= 4;
  }
  return factor;
}

/// A trial position of the ghost. All quantities are in the lab frame.
struct Ghost {
  PairEnergy pair;                       ///< energy of A and the ghost
  Vector6d shift = Vector6d::Zero();     ///< w
  Vector6d gradient = Vector6d::Zero();  ///< gradient of F with respect to (x, R·θ) of the ghost
  /// Derivative of the rotational part of w with respect to R·θ of the ghost. The translational part of w is the
  /// translation of the ghost itself.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double value = 0;  ///< F
};

class Proximal {
 public:
  Proximal(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b, const DoubleDoubleVector& r,
           const ProximalTerms& terms)
      : a_(a),
        b_(b),
        r_(r),
        stiffness_(terms.stiffness),
        series_below_(terms.series_below),
        inradius_(std::min(a.solid().inradius(), solid_b.inradius())),
        radius_(solid_b.gyration_radius()),
        multiplier_(to_lab(b, terms.multiplier)) {
    placed_.resize(solid_b, 1, true);
  }

  ProximalContact unshifted() { return result(at(Vector6d::Zero()), true); }

  ProximalContact minimise(const Vector6d& start) {
    Ghost here = at(to_lab(b_, start));
    bool converged = is_minimum(here, std::numeric_limits<double>::infinity());
    for (int k = 0; !converged && k < most_steps; ++k) {
      const double before = imbalance(here);
      if (before < series_below_ && here.pair.energy > 0) return result(by_series(here), true);
      here = step(here);
      converged = is_minimum(here, before);
    }
    return result(here, converged);
  }

 private:
  Ghost at(const Vector6d& shift) {
    ++iterations_;
    Ghost ghost;
    ghost.shift = shift;
    const Eigen::Vector3d half = shift.tail<3>() / (2 * radius_);
    const Pose pose = moved_by_half_rotation(b_, Eigen::Vector3d::Zero(), half);
    placed_.place(0, rotation_matrix(pose));
    DoubleDoubleVector r = r_;
    for (int c = 0; c < 3; ++c) r.set(c, short_sum(r_[c], shift[c]));
    ghost.pair = pair_energy(a_, placed_[0], r);
    // q → exp(dθ) q changes the vector part v by ½ (q₀ dθ + dθ×v).
    ghost.rotation = std::sqrt(1 - half.squaredNorm()) * Eigen::Matrix3d::Identity() - cross_matrix(half);
    const Vector6d spring = stiffness_ * shift - multiplier_;
    ghost.gradient = ghost.pair.gradient_b + joined(spring.head<3>(), ghost.rotation.transpose() * spring.tail<3>());
    ghost.value = ghost.pair.energy + (stiffness_ / 2 * shift - multiplier_).dot(shift);
    return ghost;
  }

  double imbalance(const Ghost& ghost) const {
    const double gradient = ghost.gradient.norm();
    return gradient > 0 ? gradient / (ghost.pair.gradient_b.norm() + multiplier_.norm()) : 0;
  }

  bool is_minimum(const Ghost& ghost, double before) const {
    const double now = imbalance(ghost);
    return now <= goal || (now <= enough && now >= before / 2);
  }

  /// Second derivatives of F with respect to (x, R·θ) of the ghost, exact to first order in w.
  Matrix6d matrix(const Ghost& ghost) const {
    Matrix6d m = ghost.pair.hessian.bb;
    m.diagonal().head<3>().array() += stiffness_;
    m.bottomRightCorner<3, 3>() += stiffness_ * ghost.rotation.transpose() * ghost.rotation;
    return m;
  }

  /// Newton step in (x, R·θ) of the ghost, or a Levenberg–Marquardt step if the matrix is not positive definite.
  Vector6d newton(const Ghost& here) const {
    const Vector6d step = -factorised(matrix(here), stiffness_).solve(here.gradient);
    const double length = std::max(step.head<3>().norm(), step.tail<3>().norm());
    return std::min(1.0, longest_step * inradius_ / length) * step;
  }

  /// ∇_w e.
  static Vector6d wrench(const Ghost& ghost) {
    const Vector6d& gradient = ghost.pair.gradient_b;
    return joined(gradient.head<3>(), ghost.rotation.transpose().inverse() * gradient.tail<3>());
  }

  /// Slope of F for a change `along` of w.
  double slope(const Ghost& ghost, const Vector6d& along) const {
    return (wrench(ghost) + stiffness_ * ghost.shift - multiplier_).dot(along);
  }

  Ghost step(const Ghost& here) {
    const Vector6d local = newton(here), along = joined(local.head<3>(), here.rotation * local.tail<3>());
    Ghost next = at(here.shift + along);
    const double from = slope(here, along);
    double to = slope(next, along);
    // A step from a gap first leads to an overlap that is far too deep; the next step leads back to the solution.
    if (here.pair.energy == 0 || to <= -overshoot * from) return next;
    // Regula falsi; the slope at the end that does not move is halved (Illinois method).
    double low = 0, high = 1, slope_low = from, slope_high = to;
    for (int k = 0; k < most_probes && std::abs(to) > -flat_enough * from; ++k) {
      const double t = low + (high - low) * std::clamp(slope_low / (slope_low - slope_high), 0.02, 0.98);
      next = at(here.shift + t * along);
      to = slope(next, along);
      if (to > 0) {
        high = t, slope_high = to, slope_low /= k > 0 ? 2 : 1;
      } else {
        low = t, slope_low = to, slope_high /= k > 0 ? 2 : 1;
      }
    }
    return next;
  }

  /// The ghost after a Newton step, by a Taylor series: F to third order in the step, forces and w to second order.
  Ghost by_series(const Ghost& here) const {
    const Vector6d local = newton(here);
    const PairHessian& h = here.pair.hessian;
    Ghost next = here;
    next.shift += joined(local.head<3>(), here.rotation * local.tail<3>());
    next.value += here.gradient.dot(local) / 2;
    next.pair.energy += here.pair.gradient_b.dot(local) + local.dot(h.bb * local) / 2;
    next.pair.gradient_a += h.ab * local;
    next.pair.gradient_b += h.bb * local;
    return next;
  }

  ProximalContact result(const Ghost& ghost, bool converged) const {
    ProximalContact contact;
    const PairEnergy& pair = ghost.pair;
    contact.shift = to_body(b_, ghost.shift);
    contact.value = ghost.value;
    contact.energy = pair.energy;
    contact.touching = pair.energy > 0;
    contact.wrench = to_body(b_, wrench(ghost));
    contact.gradient_a = pair.gradient_a;
    contact.gradient_b = pair.gradient_b;
    // torque about B's centre
    contact.gradient_b.tail<3>() += ghost.shift.head<3>().cross(pair.gradient_b.head<3>()) / radius_;
    contact.ghost = pair.hessian;
    contact.root = factorised(matrix(ghost), stiffness_).matrixL();
    contact.iterations = iterations_;
    contact.converged = converged;
    return contact;
  }

  const PlacedSolid& a_;
  const Pose& b_;
  const DoubleDoubleVector& r_;
  double stiffness_, series_below_, inradius_, radius_;
  Vector6d multiplier_;  // lab frame
  PlacedSolids placed_;  // the ghost
  int iterations_ = 0;
};

/// Schur complement of L Lᵀ in the second derivatives with respect to A and the ghost. It is computed as h − Xᵀ X,
/// where X is L⁻¹ times these derivatives, because the inverse of L Lᵀ would cause rounding errors. For a flat contact
/// the derivatives are of order 0.1, and ρ may be 1e-9. Products with the inverse would then have an error of
/// 1e-16·0.1/ρ, which couples stiff and soft directions and appears as negative curvature.
PairHessian complement(const PairHessian& h, const Matrix6d& root) {
  const auto lower = root.triangularView<Eigen::Lower>();
  const Matrix6d a = lower.solve(h.ab.transpose()), b = lower.solve(h.bb);
  PairHessian left = h;
  left.aa -= a.transpose() * a;
  left.ab -= a.transpose() * b;
  left.bb -= b.transpose() * b;
  return left;
}

}  // namespace

PairHessian ProximalContact::curvature() const { return plain ? ghost : complement(ghost, root); }

PairHessian ProximalContact::curvature(double stiffness) const {
  return complement(ghost, factorised(ghost.bb + stiffness * Matrix6d::Identity(), stiffness).matrixL());
}

double ProximalContact::predicted(const Vector6d& a, const Vector6d& b) const {
  Vector6d pull = Vector6d::Zero();
  if (!plain) pull = root.triangularView<Eigen::Lower>().solve(ghost.ab.transpose() * a + ghost.bb * b);
  return value + gradient_a.dot(a) + gradient_b.dot(b) +
         (a.dot(ghost.aa * a) + 2 * a.dot(ghost.ab * b) + b.dot(ghost.bb * b) - pull.squaredNorm()) / 2;
}

Vector6d ProximalContact::shift_change(const Vector6d& a, const Vector6d& b) const {
  if (plain) return Vector6d::Zero();
  const auto lower = root.triangularView<Eigen::Lower>();
  return -lower.transpose().solve(lower.solve(ghost.ab.transpose() * a + ghost.bb * b));
}

ProximalContact proximal_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                 const DoubleDoubleVector& r, const ProximalTerms& terms, const Vector6d& start) {
  return Proximal(a, solid_b, b, r, terms).minimise(start);
}

ProximalContact unshifted_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                  const DoubleDoubleVector& r, double stiffness) {
  return Proximal(a, solid_b, b, r, {Vector6d::Zero(), stiffness}).unshifted();
}

ProximalContact plain_contact(const PlacedSolid& a, const PlacedSolid& placed_b, const Pose& b,
                              const DoubleDoubleVector& r) {
  const PairEnergy pair = pair_energy(a, placed_b, r);
  ProximalContact contact;
  contact.value = contact.energy = pair.energy;
  contact.touching = pair.energy > 0;
  contact.wrench = to_body(b, pair.gradient_b);
  contact.gradient_a = pair.gradient_a;
  contact.gradient_b = pair.gradient_b;
  contact.ghost = pair.hessian;
  contact.iterations = 1;
  contact.plain = true;
  return contact;
}

Vector6d to_lab(const Pose& b, const Vector6d& w) {
  const Eigen::Matrix3d rotation = b.orientation.toRotationMatrix();
  return joined(rotation * w.head<3>(), rotation * w.tail<3>());
}

Vector6d to_body(const Pose& b, const Vector6d& w) {
  const Eigen::Matrix3d rotation = b.orientation.toRotationMatrix();
  return joined(rotation.transpose() * w.head<3>(), rotation.transpose() * w.tail<3>());
}

}  // namespace isojam
