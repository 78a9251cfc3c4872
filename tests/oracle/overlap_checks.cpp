#include "tests/oracle/overlap_checks.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace isojam::oracle {

namespace {

double ratio(const Real& error, const Real& scale) {
  if (error == 0) return 0;
  return scale == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(Real(error / scale));
}

double surface(SolidKind kind) { return 3 / platonic(kind).inradius(); }  // V = surface × inradius / 3 = 1

}  // namespace

OverlapErrors errors(const Overlap& measured, const ExactOverlap& exact, SolidKind a) {
  const Real area = exact.area.norm();
  const Real lever = exact.moment.norm();
  const Real moment = std::max(lever, Real(area * platonic(a).inradius()));
  return {ratio(abs(Real(Real(measured.volume) - exact.volume)), exact.volume),
          ratio((measured.area.cast<Real>() - exact.area).norm(), area),
          ratio((measured.moment.cast<Real>() - exact.moment).norm(), moment)};
}

OverlapTolerance tolerance(PairClass pair_class, SolidKind a, SolidKind b) {
  const double floor = plane_rounding(platonic(a), platonic(b)) * std::min(surface(a), surface(b));
  switch (pair_class) {
    case PairClass::random_contact: return {5e-12, 0, 1e-10, false};
    case PairClass::near_parallel_faces:
    case PairClass::edge_in_face:
    case PairClass::parallel_edges:
    case PairClass::vertex_vertex: return {1e-10, 0, 1e-10, false};
    case PairClass::same_orientation:
    case PairClass::coplanar_faces:
    case PairClass::coincident:
    case PairClass::near_coincident: return {1e-6, floor, 1e-10, true};
  }
  return {};
}

double gradient_noise(const ExactOverlap& exact, SolidKind a) {
  if (exact.contested_area == 0) return 0;
  const double lever = platonic(a).circumradius() / platonic(a).inradius();
  return lever * exact.contested_area / static_cast<double>(exact.area.norm());
}

double gradient_limit(const ExactOverlap& exact, SolidKind a, const OverlapTolerance& tolerance) {
  return tolerance.contested ? std::max(tolerance.gradient, gradient_noise(exact, a)) : tolerance.gradient;
}

std::string disagreement(const Overlap& measured, const ExactOverlap& exact, SolidKind a,
                         const OverlapTolerance& tolerance) {
  const OverlapErrors error = errors(measured, exact, a);
  const double gradient = gradient_limit(exact, a, tolerance);
  std::ostringstream wrong;
  wrong << std::setprecision(17);
  // written so that a NaN counts as a disagreement
  const bool volume_ok =
      error.volume <= tolerance.volume || abs(Real(Real(measured.volume) - exact.volume)) <= tolerance.volume_floor;
  if (!volume_ok) {
    wrong << "V = " << measured.volume << ", exact " << static_cast<double>(exact.volume) << ", relative error "
          << error.volume << " > " << tolerance.volume << "; ";
  }
  const auto compare = [&](const char* name, double relative, const Eigen::Vector3d& found, const RealVector& right) {
    if (relative <= gradient || gradient == std::numeric_limits<double>::infinity()) return;
    wrong << name << " = (" << found.transpose() << "), exact (" << right.cast<double>().transpose()
          << "), relative error " << relative << " > " << gradient << "; ";
  };
  compare("S", error.area, measured.area, exact.area);
  compare("M", error.moment, measured.moment, exact.moment);
  return wrong.str();
}

std::string describe(const PairCase& pair) {
  std::ostringstream text;
  text << std::setprecision(17) << to_string(pair.a) << " and " << to_string(pair.b) << ", q (w, x, y, z) = ("
       << pair.quaternion.w() << ", " << pair.quaternion.x() << ", " << pair.quaternion.y() << ", "
       << pair.quaternion.z() << "), displacement (" << pair.displacement.transpose() << ")";
  return text.str();
}

}  // namespace isojam::oracle
