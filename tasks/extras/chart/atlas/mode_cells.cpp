#include "engine/vibration/spectrum.hpp"

#include <fmt/format.h>

#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/lanczos.hpp"
#include "engine/vibration/lanczos_operators.hpp"
#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/atlas/cells.hpp"
#include "tasks/extras/chart/atlas/states.hpp"

namespace isojam {

namespace {

/// Number of the softest modes that are compared, without the three translations.
constexpr int wanted = 6;

/// Allowed relative error of an eigenvalue. The dynamical matrix consists of doubles. With a condition number of 1e12,
/// its eigenvalues are not more accurate than this.
constexpr double mode_tolerance = 1e-3;

/// Largest relative deviation among the first `wanted` elements of two ascending lists.
double deviation(const Eigen::VectorXd& found, const Eigen::VectorXd& exact) {
  return ((found.head<wanted>() - exact.head<wanted>()).array().abs() / exact.head<wanted>().array().abs()).maxCoeff();
}

AtlasRow by_plain_lanczos(AtlasRow row, const BlockMatrix& matrix, const Eigen::VectorXd& exact) {
  Product product(matrix);
  const LanczosModes modes =
      lanczos(LanczosOperation(product), {.wanted = LanczosWanted::least, .modes = wanted + 3, .subspace = 60});
  if (modes.ended != LanczosEnd::converged) {
    row.figure = fmt::format("{} products", modes.products);
    return refused(row, "not converged");
  }
  const Eigen::VectorXd found = modes.eigenvalues.tail(wanted);
  return judged(row, deviation(found, exact), mode_tolerance, "relative error of λ");
}

AtlasRow by_shift_invert(AtlasRow row, const BlockMatrix& matrix, const Eigen::VectorXd& exact, double shift) {
  ModeOptions options{.lowest = wanted, .highest = 1};
  options.shift = shift;
  const ModeSet found = spectrum_ends(matrix, options).lowest;
  if (found.size() < wanted) return refused(row, std::string(to_string(found.ended)));
  row = judged(row, deviation(found.eigenvalues, exact), mode_tolerance, "relative error of λ");
  // If the shift is unsuitable, the solver finds this from residuals and inertia, and finally uses the dense solver.
  row.reason += fmt::format(", {}", to_string(found.ended));
  if (row.verdict == AtlasVerdict::fails && found.relative_error > mode_tolerance)
    return refused(row, fmt::format("its own error bound is {:.0e}", found.relative_error));
  return row;
}

void append_conditions(const AtlasStates& states, AtlasRows& rows) {
  for (const Packing& state : states.all()) {
    if (rows.over()) return;
    const BlockMatrix matrix = PackingEnergy().hessian(state, Precision::double_double);
    const Eigen::VectorXd exact = dense_modes(matrix).eigenvalues;
    const std::string setting = fmt::format("{:.1e}", exact.tail<1>()[0] / exact[0]);
    const AtlasRow row{"softest modes, condition number", setting, {}, false, {}, {}, {}};
    const auto named = [&row](const std::string& method, bool standard) {
      AtlasRow one = row;
      one.method = method, one.standard = standard;
      return one;
    };
    rows.add(by_shift_invert(named("shift-invert, −σ/λ_max = 1e-11", true), matrix, exact, 1e-11));
    rows.add(by_shift_invert(named("shift-invert, −σ/λ_max = 1e-6", false), matrix, exact, 1e-6));
    rows.add(by_plain_lanczos(named("plain Lanczos", false), matrix, exact));
  }
}

/// Allowed relative error of the softest eigenvalue of a Hessian from differences.
constexpr double difference_tolerance = 1e-2;

/// Verdict on a Hessian: it must have no spurious negative modes, and the error of its softest eigenvalue must be
/// small.
AtlasRow judged_hessian(AtlasRow row, const Eigen::MatrixXd& matrix, double softest) {
  const Eigen::VectorXd lambda = symmetric_eigenvalues(matrix);
  const long negative = (lambda.array() < -softest / 2).count();
  const double error = std::abs(lambda[3] - softest) / softest;
  row = judged(row, error, difference_tolerance, fmt::format("{} negative modes, error of the softest", negative));
  if (negative > 0) row.verdict = AtlasVerdict::fails, row.reason = "spurious negative modes";
  return row;
}

void append_differences(const AtlasStates& states, double distance, AtlasRows& rows) {
  const Packing& state = states.above(distance);
  const BlockMatrix matrix = PackingEnergy().hessian(state, Precision::double_double);
  const double softest = dense_modes(matrix).eigenvalues[0];
  const std::string regime = fmt::format("Hessian at Δφ = {:.3f}, step", states.distance_of(state));
  rows.add(judged_hessian({regime, "none", "analytic", true, {}, {}, {}}, dense_matrix(matrix), softest));
  for (const double h : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    for (const Precision precision : {Precision::working, Precision::double_double}) {
      if (rows.over()) return;
      const bool in_double_double = precision == Precision::double_double;
      rows.add(
          judged_hessian({regime,
                          decade_name(h),
                          in_double_double ? "central differences in double-double" : "central differences in doubles",
                          false,
                          {},
                          {},
                          {}},
                         difference_hessian(state, h, precision), softest));
    }
  }
}

}  // namespace

std::vector<AtlasRow> modes_atlas(const AtlasStates& states, const std::stop_token& stop) {
  AtlasRows rows(stop);
  append_conditions(states, rows);
  append_differences(states, 0.1, rows);
  append_differences(states, 0.01, rows);
  return rows.taken();
}

}  // namespace isojam
