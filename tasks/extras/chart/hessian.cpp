#include <fmt/format.h>

#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tasks/extras/chart/comparisons.hpp"

namespace isojam {
namespace {

/// All blocks of a dense symmetric matrix, in the format that dense_modes() takes.
BlockMatrix blocks_of(const Eigen::MatrixXd& dense) {
  BlockMatrix matrix;
  const int particles = static_cast<int>(dense.rows() / 6);
  for (int row = 0; row < particles; ++row) {
    matrix.diagonal.emplace_back(dense.block<6, 6>(6 * row, 6 * row));
    for (int column = row + 1; column < particles; ++column)
      matrix.off_diagonal.push_back({row, column, dense.block<6, 6>(6 * row, 6 * column)});
  }
  return matrix;
}

double largest_relative_difference(const Eigen::VectorXd& found, const Eigen::VectorXd& right) {
  return ((found - right).array().abs() / right.array().abs()).maxCoeff();
}

/// Number of eigenvalues that are negative beyond rounding errors.
int count_negative(const Eigen::VectorXd& eigenvalues, double tolerance) {
  return static_cast<int>((eigenvalues.array() < -tolerance).count());
}

void compare_hessians_of(const Packing& packing, const Measuring& measuring, TaskRuns& runs) {
  BlockMatrix matrix;
  PackingEnergy energy;
  energy.evaluate(packing, Precision::double_double);
  const auto seconds = timed(measuring, [&] { matrix = energy.hessian(packing, Precision::double_double); });
  const ModeSet right = dense_modes(matrix);
  const double tolerance = rounding_bound(matrix, right.eigenvalues.cwiseAbs().maxCoeff());
  runs.add("analytic", "analytic", spread(seconds)->median, right.relative_error, "done", false);
  // A packing at a saddle has negative modes; only additional ones are spurious.
  const int genuine = count_negative(right.eigenvalues, tolerance);
  for (const double h : measuring.config.difference_steps) {
    if (measuring.over()) return;
    Eigen::MatrixXd dense;
    const auto taken = timed(measuring, [&] { dense = difference_hessian(packing, h); });
    const Eigen::VectorXd found = dense_modes(blocks_of(dense)).eigenvalues;
    const bool is_spurious = genuine == 0 && count_negative(found, tolerance) > 0;
    runs.add("central differences", fmt::format("h = {:g}", h), spread(taken)->median,
             largest_relative_difference(found, right.eigenvalues), is_spurious ? "negative modes" : "done",
             is_spurious);
  }
}

}  // namespace

void compare_hessians(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family) {
  for (const TaskEquilibria& task : tasks) {
    TaskRuns runs;
    for (const Packing& packing : task.packings) {
      if (measuring.over()) break;
      measuring.progress("Hessians, " + task.task);
      compare_hessians_of(packing, measuring, runs);
    }
    // If a stop was requested, the packings that were measured are still reported; n is their number.
    runs.append_to(family.points, task.task);
  }
}

}  // namespace isojam
