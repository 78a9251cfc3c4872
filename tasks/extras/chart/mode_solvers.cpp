#include "engine/vibration/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/solve/factor/shift_invert.hpp"
#include "engine/vibration/lanczos.hpp"
#include "engine/vibration/lanczos_operators.hpp"
#include "tasks/extras/chart/comparisons.hpp"

namespace isojam {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int wanted = modes_compared;
constexpr int restarts = 100;
constexpr double tolerance = 1e-13;
/// If the relative error of an eigenvalue is larger, the solver found other modes than the requested ones.
constexpr double worst_useful_mode = 1e-2;

struct ComputedModes {
  std::string stopped;
  VectorXd eigenvalues;  ///< in ascending order; empty if the solver did not converge
};

template <class Operation>
ComputedModes solve(const BlockMatrix& matrix, Operation& operation, LanczosRequest request) {
  request.modes = wanted;
  request.restarts = restarts;
  request.tolerance = tolerance;
  request.start = lanczos_start(matrix);
  LanczosModes modes = lanczos(LanczosOperation(operation), request);
  if (modes.ended == LanczosEnd::small_problem_failed) return {"small eigenproblem did not converge", {}};
  if (modes.ended == LanczosEnd::restarts_spent) return {"restart limit reached", {}};
  std::sort(modes.eigenvalues.begin(), modes.eigenvalues.end());
  return {"converged", std::move(modes.eigenvalues)};
}

ComputedModes by_inversion(const BlockMatrix& matrix, double shift, Index subspace) {
  ShiftInvert inverse(matrix);
  Deflated<ShiftInvert> operation(inverse, matrix);
  try {
    return solve(matrix, operation, {.subspace = subspace, .shift = shift});
  } catch (const std::domain_error&) {
    return {"shift equals an eigenvalue", {}};
  }
}

/// The dynamical matrix D, in which the eigenvalue of the translations is lambda_max instead of 0. It is then far from
/// the lowest modes. With a projection alone, rounding errors would bring the translations back.
class Raised {
 public:
  using Scalar = double;

  Raised(const BlockMatrix& matrix, double lambda_max)
      : product_(matrix), root_masses_(matrix.root_masses), lambda_max_(lambda_max) {}

  Index rows() const { return product_.rows(); }
  void set_shift(double) {}
  void perform_op(const double* x, double* y) const {
    const Eigen::Map<const VectorXd> in(x, rows());
    VectorXd rest = in;
    remove_translations(root_masses_, rest);
    product_.perform_op(rest.data(), y);
    Eigen::Map<VectorXd> out(y, rows());
    remove_translations(root_masses_, out);
    out += lambda_max_ * (in - rest);
  }

 private:
  Product product_;
  const VectorXd& root_masses_;
  double lambda_max_;
};

ComputedModes by_products(const BlockMatrix& matrix, double lambda_max, Index subspace) {
  Raised operation(matrix, lambda_max);
  return solve(matrix, operation, {.wanted = LanczosWanted::least, .subspace = subspace});
}

void add(TaskRuns& runs, const std::string& method, const std::string& setting, double seconds,
         const ComputedModes& found, const VectorXd& right) {
  if (found.eigenvalues.size() == 0) return runs.add(method, setting, seconds, {}, found.stopped, true);
  const VectorXd lowest = right.head(found.eigenvalues.size());
  const double error = ((found.eigenvalues - lowest).array().abs() / lowest.array().abs()).maxCoeff();
  const bool is_wrong = !(error < worst_useful_mode);
  runs.add(method, setting, seconds, error, is_wrong ? "wrong modes" : found.stopped, is_wrong);
}

void compare_modes_of(const Packing& packing, const Measuring& measuring, TaskRuns& runs) {
  const BlockMatrix matrix = double_double_hessian(packing);
  ModeSet dense;
  const auto dense_seconds = timed(measuring, [&] { dense = dense_modes(matrix); });
  const double lambda_max = dense.eigenvalues.cwiseAbs().maxCoeff();
  const auto measure = [&](const std::string& method, const std::string& setting, const auto& work) {
    if (measuring.over()) return;
    ComputedModes found;
    const auto seconds = timed(measuring, [&] { found = work(); });
    add(runs, method, setting, spread(seconds)->median, found, dense.eigenvalues);
  };
  // The dense solver is the reference for the other solvers. Its own error is its error bound.
  add(runs, "dense", "all modes", spread(dense_seconds)->median,
      {"converged", dense.eigenvalues * (1 + dense.relative_error)}, dense.eigenvalues);
  const Index all = dense.eigenvalues.size();
  for (const int subspace : measuring.config.subspaces) {
    const Index dimension = std::min<Index>(subspace, all);
    for (const double shift : measuring.config.shifts)
      measure("shift-invert", fmt::format("shift {:g}, subspace {}", shift, dimension),
              [&] { return by_inversion(matrix, -shift * lambda_max, dimension); });
    measure("Lanczos without inversion", fmt::format("subspace {}", dimension),
            [&] { return by_products(matrix, lambda_max, dimension); });
  }
}

}  // namespace

void compare_modes(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family) {
  for (const TaskEquilibria& task : tasks) {
    TaskRuns runs;
    for (const Packing& packing : task.packings) {
      if (measuring.over()) break;
      measuring.progress("modes, " + task.task);
      compare_modes_of(packing, measuring, runs);
    }
    runs.append_to(family.points, task.task);
  }
}

}  // namespace isojam
