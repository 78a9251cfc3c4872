#include "engine/solve/factor/block_cholesky.hpp"

#include <algorithm>

#include "engine/solve/factor/panels.hpp"

namespace isojam {

namespace {

constexpr int per_panel = panels::height / 6;  ///< particles

int panels_of(int particles) { return (particles + per_panel - 1) / per_panel; }

/// Where a row and a column of 6×6 blocks meet in panels of `width` columns.
std::ptrdiff_t block_at(int row, int column, int width) {
  return panels::size(row / per_panel, width) + std::ptrdiff_t{6} * panels::height * column + 6 * (row % per_panel);
}

using Block6 = Eigen::Map<Matrix6d, Eigen::Unaligned, Eigen::OuterStride<panels::height>>;

/// Makes room for `size` entries of any value. Eigen frees what a vector had before it asks for more, and frees it
/// again if it gets none, unless the vector is empty.
void reallocate(Eigen::VectorXd& vector, std::ptrdiff_t size) {
  if (vector.size() == size) return;
  vector = Eigen::VectorXd();
  vector.resize(size);
}

/// to += from, for 6 rows and `columns` columns of panels.
void add_columns(const double* from, int columns, double* to) {
  for (int c = 0; c < columns; ++c, from += panels::height, to += panels::height) {
    for (int i = 0; i < 6; ++i) to[i] += from[i];
  }
}

}  // namespace

/// Place among the columns, then the rows of the front.
std::ptrdiff_t BlockCholesky::Front::at(int place, int column) const {
  return place < node.columns ? factor + block_at(place, column, width())
                              : below + block_at(place - node.columns, column, width());
}

std::ptrdiff_t BlockCholesky::Front::update_at(int row, int column) const {
  return update + panels::packed_size(row / per_panel) + block_at(row % per_panel, column, 0);
}

bool BlockCholesky::has_pattern_of(const BlockMatrix& matrix) const {
  return size_ == matrix.size() &&
         std::equal(pattern_.begin(), pattern_.end(), matrix.off_diagonal.begin(), matrix.off_diagonal.end(),
                    [](const auto& p, const auto& block) { return p.first == block.row && p.second == block.column; });
}

void BlockCholesky::analyse(const BlockMatrix& matrix) {
  size_ = matrix.size();
  pattern_.clear();
  for (const BlockMatrix::Block& block : matrix.off_diagonal) pattern_.emplace_back(block.row, block.column);
  Elimination plan = plan_elimination(matrix);
  node_of_ = std::move(plan.node_of);
  fronts_.clear();
  for (Supernode& node : plan.supernodes) {
    fronts_.emplace_back();
    fronts_.back().node = std::move(node);
  }
  lay_out_fronts();
  lay_out_updates();
  place_blocks(matrix);
  place_children();
}

void BlockCholesky::lay_out_fronts() {
  std::ptrdiff_t end = 0;
  for (Front& front : fronts_) {
    front.panels = panels_of(static_cast<int>(front.node.rows.size()));
    front.factor = end;
    front.below = end + panels::size(panels_of(front.node.columns), front.width());
    end = front.below + panels::size(front.panels, front.width());
  }
  reallocate(factor_, end);
  reallocate(reciprocals_, std::ptrdiff_t{6} * size_);
}

/// An update lives from its own front to its parent's. Each takes the lowest gap that fits, so that what is in use
/// stays together in the cache.
void BlockCholesky::lay_out_updates() {
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> live;  // begin and end, ascending
  std::ptrdiff_t size = 0;
  for (Front& front : fronts_) {
    const std::ptrdiff_t needed = panels::packed_size(front.panels);
    std::ptrdiff_t begin = 0;
    auto gap = live.begin();
    for (; gap != live.end() && gap->first - begin < needed; ++gap) begin = gap->second;
    front.update = begin;
    if (needed > 0) live.insert(gap, {begin, begin + needed});
    size = std::max(size, begin + needed);
    for (const int child : front.node.children)
      std::erase_if(live, [&](const auto& span) { return span.first == fronts_[child].update; });
  }
  reallocate(updates_, size);
}

namespace {

/// Which of its columns, then rows, place k of the elimination order is in a supernode.
int place_in(const Supernode& node, int k) {
  if (k < node.first + node.columns) return k - node.first;
  return node.columns + static_cast<int>(std::lower_bound(node.rows.begin(), node.rows.end(), k) - node.rows.begin());
}

}  // namespace

void BlockCholesky::place_blocks(const BlockMatrix& matrix) {
  std::vector<int> front_of(node_of_.size()), place_of(node_of_.size());
  diagonal_.resize(node_of_.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const Supernode& node = fronts_[f].node;
    for (int c = 0; c < node.columns; ++c) {
      front_of[node.first + c] = static_cast<int>(f);
      place_of[node_of_[node.first + c]] = node.first + c;
      diagonal_[node_of_[node.first + c]] = {fronts_[f].at(c, c), false};
    }
  }
  off_diagonal_.clear();
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    const int row = place_of[block.row], column = place_of[block.column];
    const Front& front = fronts_[front_of[std::min(row, column)]];
    // A block is stored as (row, column); the lower half wants (later, earlier).
    off_diagonal_.push_back(
        {front.at(place_in(front.node, std::max(row, column)), std::min(row, column) - front.node.first),
         row < column});
  }
}

void BlockCholesky::place_children() {
  for (Front& front : fronts_) {
    for (const int child : front.node.children) {
      Handover handover{child, {}, {}};
      for (const int row : fronts_[child].node.rows) {
        const int place = place_in(front.node, row), k = static_cast<int>(handover.places.size());
        const bool continues = k > 0 && place == handover.places.back() + 1 && place != front.node.columns;
        if (!continues) handover.runs.push_back(k);
        handover.places.push_back(place);
      }
      front.handovers.push_back(std::move(handover));
    }
  }
}

void BlockCholesky::assemble(const BlockMatrix& matrix) {
  factor_.setZero();
  for (int i = 0; i < size_; ++i) {
    Block6 to(factor_.data() + diagonal_[i].at);
    to = matrix.diagonal[i];
  }
  for (std::size_t k = 0; k < off_diagonal_.size(); ++k) {
    const Matrix6d& value = matrix.off_diagonal[k].value;
    Block6 to(factor_.data() + off_diagonal_[k].at);
    if (off_diagonal_[k].transposed) {
      to = value.transpose();
    } else {
      to = value;
    }
  }
}

void BlockCholesky::add_shift(double shift) {
  for (const Target& target : diagonal_) {
    for (int i = 0; i < 6; ++i) factor_[target.at + i * (panels::height + 1)] += shift;
  }
}

void BlockCholesky::gather_updates(const Front& front) {
  std::fill_n(updates_.data() + front.update, panels::packed_size(front.panels), 0.0);
  const int columns = front.node.columns;
  for (const Handover& handover : front.handovers) {
    const Front& child = fronts_[handover.child];
    const int count = static_cast<int>(handover.places.size());
    for (int i = 0; i < count; ++i) {
      const double* const from = updates_.data() + child.update_at(i, 0);
      const int row = handover.places[i];
      for (std::size_t r = 0; r < handover.runs.size() && handover.runs[r] <= i; ++r) {
        const int begin = handover.runs[r], place = handover.places[begin];
        const int end = std::min(i + 1, r + 1 < handover.runs.size() ? handover.runs[r + 1] : count);
        double* const to = place < columns ? factor_.data() + front.at(row, place)
                                           : updates_.data() + front.update_at(row - columns, place - columns);
        add_columns(from + std::ptrdiff_t{6} * panels::height * begin, 6 * (end - begin), to);
      }
    }
  }
}

bool BlockCholesky::factorise(const BlockMatrix& matrix, double shift) {
  if (!has_pattern_of(matrix)) analyse(matrix);
  assemble(matrix);
  add_shift(shift);
  for (const Front& front : fronts_) {
    gather_updates(front);
    double* const below = factor_.data() + front.below;
    if (!panels::factorise(factor_.data() + front.factor, front.width(),
                           reciprocals_.data() + std::ptrdiff_t{6} * front.node.first, below, front.panels)) {
      return false;
    }
    panels::subtract_square(below, front.width(), front.panels, updates_.data() + front.update);
  }
  return true;
}

Eigen::VectorXd BlockCholesky::solve(const Eigen::Ref<const Eigen::VectorXd>& b) const {
  Eigen::VectorXd x(b.size()), below(b.size() + 6);
  for (int k = 0; k < size_; ++k) x.segment<6>(6 * k) = b.segment<6>(6 * node_of_[k]);
  for (const Front& front : fronts_) {
    double* const own = x.data() + std::ptrdiff_t{6} * front.node.first;
    const std::vector<int>& rows = front.node.rows;
    panels::solve_forward(factor_.data() + front.factor, front.width(),
                          reciprocals_.data() + std::ptrdiff_t{6} * front.node.first, own);
    below.head(panels::height * front.panels).setZero();
    panels::subtract_product(factor_.data() + front.below, front.width(), front.panels, own, below.data());
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) x.segment<6>(6 * rows[r]) += below.segment<6>(6 * r);
  }
  // NOLINTNEXTLINE(modernize-loop-convert): clang 14 does not compile the views of g++ 12
  for (auto at = fronts_.rbegin(); at != fronts_.rend(); ++at) {
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
  for (int k = 0; k < size_; ++k) result.segment<6>(6 * node_of_[k]) = x.segment<6>(6 * k);
  return result;
}

}  // namespace isojam
