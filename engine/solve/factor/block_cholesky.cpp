#include "engine/solve/factor/block_cholesky.hpp"

#include <algorithm>

#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// Number of multiplications for a front (a third of a millisecond) above which threads share its rows.
constexpr double work_of_shared_front = 5e6;

using Block6 = Eigen::Map<Matrix6d, Eigen::Unaligned, Eigen::OuterStride<panels::height>>;

/// Makes room for `size` entries with arbitrary values, and for some more, so that small changes of the pattern need no
/// new memory. The vector is emptied first. Otherwise Eigen would free its memory before the allocation, and again if
/// the allocation fails.
void reserve(Eigen::VectorXd& vector, std::ptrdiff_t size) {
  if (vector.size() >= size) return;
  vector = Eigen::VectorXd();
  vector.resize(size + size / 8);
}

/// Computes to += from, for 6 rows and `columns` columns of panels.
void add_columns(const double* from, int columns, double* to) {
  for (int c = 0; c < columns; ++c, from += panels::height, to += panels::height) {
    for (int i = 0; i < 6; ++i) to[i] += from[i];
  }
}

void set_zero(double* begin, double* end, panels::Threads threads) {
  constexpr std::ptrdiff_t at_once = 1 << 15;
  panels::for_each(static_cast<int>((end - begin + at_once - 1) / at_once), threads,
                   [=](int k) { std::fill(begin + at_once * k, std::min(end, begin + at_once * (k + 1)), 0.0); });
}

}  // namespace

bool BlockCholesky::has_pattern_of(const BlockMatrix& matrix) const {
  return size_ == matrix.size() &&
         std::equal(pattern_.begin(), pattern_.end(), matrix.off_diagonal.begin(), matrix.off_diagonal.end(),
                    [](const auto& p, const auto& block) { return p.first == block.row && p.second == block.column; });
}

void BlockCholesky::analyse(const BlockMatrix& matrix) {
  size_ = -1;  // in case analysis runs out of memory
  plan_ = plan_fronts(matrix);
  pattern_.clear();
  for (const BlockMatrix::Block& block : matrix.off_diagonal) pattern_.emplace_back(block.row, block.column);
  reserve(factor_, plan_.factor_size);
  reserve(reciprocals_, std::ptrdiff_t{6} * matrix.size());
  reserve(updates_, plan_.updates_size);
  size_ = matrix.size();
}

void BlockCholesky::assemble(const Front& front, const BlockMatrix& matrix, double shift, panels::Threads threads) {
  set_zero(factor_.data() + front.factor, factor_.data() + front.factor_end(), threads);
  for (int c = 0; c < front.node.columns; ++c) {
    Block6 to(factor_.data() + front.at(c, c));
    to = matrix.diagonal[plan_.node_of[front.node.first + c]];
    to.diagonal().array() += shift;
  }
  for (int b = front.first_block; b < front.last_block; ++b) {
    const BlockPlace& place = plan_.blocks[b];
    const Matrix6d& value = matrix.off_diagonal[place.block].value;
    Block6 to(factor_.data() + place.at);
    if (place.transposed) {
      to = value.transpose();
    } else {
      to = value;
    }
  }
}

/// Adds the runs first … last − 1 of one row of the update of a child to the front.
void BlockCholesky::take_over(const Front& front, const Handover& handover, int row, int first, int last) {
  const int columns = front.node.columns, count = static_cast<int>(handover.places.size());
  const int runs = static_cast<int>(handover.runs.size());
  const double* const from = updates_.data() + plan_.fronts[handover.child].update_at(row, 0);
  const int to_row = handover.places[row];
  for (int r = first; r < last && handover.runs[r] <= row; ++r) {
    const int begin = handover.runs[r], place = handover.places[begin];
    const int end = std::min(row + 1, r + 1 < runs ? handover.runs[r + 1] : count);
    double* const to = place < columns ? factor_.data() + front.at(to_row, place)
                                       : updates_.data() + front.update_at(to_row - columns, place - columns);
    add_columns(from + std::ptrdiff_t{6} * panels::height * begin, 6 * (end - begin), to);
  }
}

/// Adds the columns of all children. One child is added after another, so that the order does not depend on the
/// threads.
void BlockCholesky::gather_columns(const Front& front, panels::Threads threads) {
  for (const Handover& handover : front.handovers) {
    panels::for_each(static_cast<int>(handover.places.size()), threads,
                     [&](int row) { take_over(front, handover, row, 0, handover.runs_of_columns); });
  }
}

void BlockCholesky::gather_update(const Front& front, panels::Threads threads) {
  for (const Handover& handover : front.handovers) {
    const int runs = static_cast<int>(handover.runs.size());
    if (runs == handover.runs_of_columns) continue;
    const int first = handover.runs[handover.runs_of_columns];
    panels::for_each(static_cast<int>(handover.places.size()) - first, threads,
                     [&](int row) { take_over(front, handover, first + row, handover.runs_of_columns, runs); });
  }
}

bool BlockCholesky::eliminate(const Front& front, const BlockMatrix& matrix, double shift) {
  const auto threads =
      plan_.ranges.size() > 1 && front.work() >= work_of_shared_front ? panels::Threads::all : panels::Threads::one;
  assemble(front, matrix, shift, threads);
  gather_columns(front, threads);
  double* const below = factor_.data() + front.below;
  if (!panels::factorise(factor_.data() + front.factor, front.width(),
                         reciprocals_.data() + std::ptrdiff_t{6} * front.node.first, below, front.panels, threads)) {
    return false;
  }
  // The children are added after the product, so that the product can overwrite the memory.
  panels::minus_square(below, front.width(), front.panels, updates_.data() + front.update, threads);
  gather_update(front, threads);
  return true;
}

bool BlockCholesky::factorise(const BlockMatrix& matrix, double shift) {
  return factorise_blocks(matrix, shift) && factorise_border(matrix, shift);
}

/// Factorises the Schur complement C' − Bᵀ H'⁻¹ B. B is the border, C is the corner, H' = H + shift·1 and C' = C +
/// shift·1. It is computed from the response X = −H'⁻¹ B as C' + BᵀX + XᵀB + XᵀH'X. This form is stationary in X, so
/// its error is of second order in the error of X. The form C' − Bᵀ H'⁻¹ B would lose most digits to cancellation.
bool BlockCholesky::factorise_border(const BlockMatrix& matrix, double shift) {
  const Eigen::Index n = 6 * Eigen::Index{matrix.size()}, strains = matrix.strains();
  response_.resize(n, strains);
  if (strains == 0) return true;
  Eigen::MatrixXd reaction(n, strains);
  for (Eigen::Index k = 0; k < strains; ++k) {
    response_.col(k) = -solve_blocks(matrix.border.col(k));
    Eigen::VectorXd column = Eigen::VectorXd::Zero(n + strains);
    column.head(n) = response_.col(k);
    reaction.col(k) = (matrix * column).head(n) + shift * column.head(n);
  }
  const Eigen::MatrixXd cross = matrix.border.transpose() * response_;
  Eigen::MatrixXd complement = matrix.corner + cross + cross.transpose() + response_.transpose() * reaction;
  complement.diagonal().array() += shift;
  complement_.compute(complement);
  return complement_.info() == Eigen::Success;
}

bool BlockCholesky::factorise_blocks(const BlockMatrix& matrix, double shift) {
  if (!has_pattern_of(matrix)) analyse(matrix);
  const auto eliminate_range = [&](int r) {
    for (int f = plan_.ranges[r].first; f < plan_.ranges[r].last; ++f) {
      if (!eliminate(plan_.fronts[f], matrix, shift)) return false;
    }
    return true;
  };
  if (plan_.ranges.size() > 1) return for_each_in_forest(plan_.parents, eliminate_range);
  return plan_.ranges.empty() || eliminate_range(0);
}

Eigen::VectorXd BlockCholesky::solve(const Eigen::Ref<const Eigen::VectorXd>& b) const {
  const Eigen::Index n = response_.rows(), strains = response_.cols();
  if (strains == 0) return solve_blocks(b);
  Eigen::VectorXd x(b.size());
  x.tail(strains) = complement_.solve(b.tail(strains) + response_.transpose() * b.head(n));
  x.head(n) = solve_blocks(b.head(n)) + response_ * x.tail(strains);
  return x;
}

Eigen::VectorXd BlockCholesky::solve_blocks(const Eigen::Ref<const Eigen::VectorXd>& b) const {
  Eigen::VectorXd x(b.size()), below(b.size() + 6);
  for (int k = 0; k < size_; ++k) x.segment<6>(6 * k) = b.segment<6>(6 * plan_.node_of[k]);
  for (const Front& front : plan_.fronts) {
    double* const own = x.data() + std::ptrdiff_t{6} * front.node.first;
    const std::vector<int>& rows = front.node.rows;
    panels::solve_forward(factor_.data() + front.factor, front.width(),
                          reciprocals_.data() + std::ptrdiff_t{6} * front.node.first, own);
    below.head(panels::height * front.panels).setZero();
    panels::subtract_product(factor_.data() + front.below, front.width(), front.panels, own, below.data());
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) x.segment<6>(6 * rows[r]) += below.segment<6>(6 * r);
  }
  // NOLINTNEXTLINE(modernize-loop-convert): clang 14 does not compile the views of g++ 12
  for (auto at = plan_.fronts.rbegin(); at != plan_.fronts.rend(); ++at) {
    const Front& front = *at;
    double* const own = x.data() + std::ptrdiff_t{6} * front.node.first;
    const std::vector<int>& rows = front.node.rows;
    below.head(panels::height * front.panels).setZero();
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) below.segment<6>(6 * r) = x.segment<6>(6 * rows[r]);
    panels::subtract_transposed(factor_.data() + front.below, front.width(), front.panels, below.data(), own);
    panels::solve_backward(factor_.data() + front.factor, front.width(),
                           reciprocals_.data() + std::ptrdiff_t{6} * front.node.first, own);
  }
  Eigen::VectorXd result(b.size());
  for (int k = 0; k < size_; ++k) result.segment<6>(6 * plan_.node_of[k]) = x.segment<6>(6 * k);
  return result;
}

}  // namespace isojam
