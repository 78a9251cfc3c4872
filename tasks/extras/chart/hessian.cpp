#include <fmt/format.h>

#include <map>

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

/// Results of one setting, with one value for each packing of a case.
struct Samples {
  std::vector<double> seconds, errors, negative;
  int failed = 0;
};

double largest_relative_difference(const Eigen::VectorXd& found, const Eigen::VectorXd& right) {
  return ((found - right).array().abs() / right.array().abs()).maxCoeff();
}

/// Number of eigenvalues that are negative beyond rounding errors.
int count_negative(const Eigen::VectorXd& eigenvalues, double tolerance) {
  return static_cast<int>((eigenvalues.array() < -tolerance).count());
}

ChartPoint point_of(const std::string& task, const std::string& method, const std::string& setting,
                    const Samples& samples) {
  ChartPoint point{
      task,          method, setting, spread(samples.seconds), spread(samples.errors), "done", samples.failed > 0,
      Json::object()};
  const auto negative = spread(samples.negative);
  point.further["negative_modes"] = negative ? Json(negative->median) : Json(nullptr);
  if (point.failed) point.stopped = fmt::format("negative modes in {} of {}", samples.failed, samples.seconds.size());
  return point;
}

class Hessians {
 public:
  Hessians(const Measuring& measuring, ChartFamily& family) : measuring_(measuring), family_(family) {}

  void compare(const TaskEquilibria& task) {
    Samples analytic;
    std::map<double, Samples> differences;
    for (const Packing& packing : task.packings) {
      if (measuring_.over()) break;
      measuring_.progress("Hessians, " + task.task);
      compare(packing, analytic, differences);
    }
    // If a stop was requested, the packings that were measured are still reported; n is their number.
    if (analytic.seconds.empty()) return;
    family_.points.push_back(point_of(task.task, "analytic", "analytic", analytic));
    for (const auto& [h, samples] : differences)
      family_.points.push_back(point_of(task.task, "central differences", fmt::format("h = {:g}", h), samples));
  }

 private:
  void compare(const Packing& packing, Samples& analytic, std::map<double, Samples>& differences) {
    BlockMatrix matrix;
    PackingEnergy energy;
    energy.evaluate(packing, Precision::double_double);
    const auto seconds = timed(measuring_, [&] { matrix = energy.hessian(packing, Precision::double_double); });
    const ModeSet right = dense_modes(matrix);
    const double lambda_max = right.eigenvalues.cwiseAbs().maxCoeff();
    const double tolerance = rounding_bound(matrix, lambda_max);
    add(analytic, seconds, right.relative_error, count_negative(right.eigenvalues, tolerance), 0);
    // A packing at a saddle has negative modes; only additional ones are spurious.
    const int genuine = count_negative(right.eigenvalues, tolerance);
    for (const double h : measuring_.config.difference_steps) {
      if (measuring_.over()) return;
      Eigen::MatrixXd dense;
      const auto taken = timed(measuring_, [&] { dense = difference_hessian(packing, h); });
      const Eigen::VectorXd found = dense_modes(blocks_of(dense)).eigenvalues;
      add(differences[h], taken, largest_relative_difference(found, right.eigenvalues),
          count_negative(found, tolerance), genuine);
    }
  }

  static void add(Samples& samples, const std::vector<double>& seconds, double error, int negative, int genuine) {
    samples.seconds.push_back(spread(seconds)->median);
    samples.errors.push_back(error);
    samples.negative.push_back(negative);
    samples.failed += negative > genuine && genuine == 0;
  }

  const Measuring& measuring_;
  ChartFamily& family_;
};

}  // namespace

void compare_hessians(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family) {
  Hessians hessians(measuring, family);
  for (const TaskEquilibria& task : tasks) hessians.compare(task);
}

}  // namespace isojam
