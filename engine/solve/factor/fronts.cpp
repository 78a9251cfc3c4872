#include "engine/solve/factor/fronts.hpp"

#include <algorithm>

#include "engine/solve/factor/ordering.hpp"
#include "engine/solve/factor/panels.hpp"

namespace isojam {

namespace {

/// Number of multiplications (3 ms) below which one thread does the whole factorisation.
constexpr double work_to_share = 5e7;

/// Fraction of all work below which one thread does a whole subtree. It is so small that several threads are busy until
/// the end.
constexpr double part_of_one = 1.0 / 32;

constexpr int per_panel = panels::height / 6;  ///< particles per panel

int panels_of(int particles) { return (particles + per_panel - 1) / per_panel; }

/// Index of the 6×6 block at a row and a column of particles in panels of `width` columns.
std::ptrdiff_t block_at(int row, int column, int width) {
  return panels::size(row / per_panel, width) + std::ptrdiff_t{6} * panels::height * column + 6 * (row % per_panel);
}

/// Index of position k of the elimination order in the list of the columns of a supernode, followed by its rows.
int place_in(const Supernode& node, int k) {
  if (k < node.first + node.columns) return k - node.first;
  return node.columns + static_cast<int>(std::lower_bound(node.rows.begin(), node.rows.end(), k) - node.rows.begin());
}

void lay_out_fronts(FrontPlan& plan) {
  for (Front& front : plan.fronts) {
    front.panels = panels_of(front.rows());
    front.factor = plan.factor_size;
    front.below = front.factor + panels::size(panels_of(front.node.columns), front.width());
    plan.factor_size = front.factor_end();
  }
}

void place_blocks(const BlockMatrix& matrix, FrontPlan& plan) {
  std::vector<int> front_of(plan.node_of.size()), place_of(plan.node_of.size());
  for (std::size_t f = 0; f < plan.fronts.size(); ++f) {
    const Supernode& node = plan.fronts[f].node;
    for (int k = node.first; k < node.first + node.columns; ++k) {
      front_of[k] = static_cast<int>(f);
      place_of[plan.node_of[k]] = k;
    }
  }
  const auto front_with = [&](const BlockMatrix::Block& block) -> Front& {
    return plan.fronts[front_of[std::min(place_of[block.row], place_of[block.column])]];
  };
  for (const BlockMatrix::Block& block : matrix.off_diagonal) ++front_with(block).last_block;
  int end = 0;
  for (Front& front : plan.fronts) {
    front.first_block = end;
    end += front.last_block;
    front.last_block = front.first_block;
  }
  plan.blocks.resize(matrix.off_diagonal.size());
  for (std::size_t b = 0; b < matrix.off_diagonal.size(); ++b) {
    const BlockMatrix::Block& block = matrix.off_diagonal[b];
    const int row = place_of[block.row], column = place_of[block.column];
    Front& front = front_with(block);
    // A block is stored as (row, column); the lower half needs (later, earlier).
    plan.blocks[front.last_block++] = {
        static_cast<int>(b),
        front.at(place_in(front.node, std::max(row, column)), std::min(row, column) - front.node.first), row < column};
  }
}

void place_children(FrontPlan& plan) {
  for (Front& front : plan.fronts) {
    for (const int child : front.node.children) {
      Handover handover{child, {}, {}, 0};
      for (const int row : plan.fronts[child].node.rows) {
        const int place = place_in(front.node, row), k = static_cast<int>(handover.places.size());
        const bool continues = k > 0 && place == handover.places.back() + 1 && place != front.node.columns;
        if (!continues) {
          handover.runs.push_back(k);
          if (place < front.node.columns) ++handover.runs_of_columns;
        }
        handover.places.push_back(place);
      }
      front.handovers.push_back(std::move(handover));
    }
  }
}

void divide(FrontPlan& plan) {
  const std::size_t n = plan.fronts.size();
  std::vector<double> work(n);               // work of the subtree
  std::vector<int> parent(n, -1), first(n);  // parent front, and first front of the subtree
  double all = 0;
  for (std::size_t f = 0; f < n; ++f) {
    const Front& front = plan.fronts[f];
    first[f] = static_cast<int>(f);
    work[f] = front.work();
    all += work[f];
    for (const int child : front.node.children) {
      work[f] += work[child];
      parent[child] = static_cast<int>(f);
      first[f] = std::min(first[f], first[child]);
    }
  }
  if (all < work_to_share) {
    if (n > 0) plan.ranges.push_back({0, static_cast<int>(n)});
    plan.parents.assign(plan.ranges.size(), -1);
    return;
  }
  const double small = part_of_one * all;
  std::vector<int> range_of(n, -1);  // range that ends with this front
  for (std::size_t f = 0; f < n; ++f) {
    if (work[f] <= small && parent[f] >= 0 && work[parent[f]] <= small) continue;
    range_of[f] = static_cast<int>(plan.ranges.size());
    plan.ranges.push_back({work[f] <= small ? first[f] : static_cast<int>(f), static_cast<int>(f) + 1});
  }
  for (const FrontRange& range : plan.ranges) {
    const int above = parent[range.last - 1];
    plan.parents.push_back(above >= 0 ? range_of[above] : -1);
  }
}

/// Memory of the update of one front.
struct Span {
  std::ptrdiff_t begin = 0, end = 0;
  int front = 0;
};

/// Places the updates of the fronts of a range in memory. `live` contains the updates of the child ranges, sorted by
/// memory. Returns the size of the used memory. An update is needed until its parent front is processed. Each update is
/// placed in the lowest gap that is large enough, so that active memory stays together in the cache.
std::ptrdiff_t lay_out_range(const FrontRange& range, std::vector<Span> live, std::vector<Front>& fronts) {
  std::ptrdiff_t size = 0;
  for (int f = range.first; f < range.last; ++f) {
    Front& front = fronts[f];
    const std::ptrdiff_t needed = front.update_size();
    std::ptrdiff_t begin = 0;
    auto gap = live.begin();
    for (; gap != live.end() && gap->begin - begin < needed; ++gap) begin = gap->end;
    front.update = begin;
    if (needed > 0) live.insert(gap, {begin, begin + needed, f});
    size = std::max(size, begin + needed);
    for (const int child : front.node.children)
      std::erase_if(live, [child](const Span& span) { return span.front == child; });
  }
  return size;
}

/// Each range has a part of the memory of its parent range, for itself and all ranges below it. In this memory it
/// overwrites only updates that a front below it has already used.
void lay_out_updates(FrontPlan& plan) {
  const std::size_t n = plan.ranges.size();
  std::vector<std::ptrdiff_t> size(n, 0), begin(n, 0);
  std::vector<std::vector<Span>> left(n);  // updates left by the children of each range
  for (std::size_t r = 0; r < n; ++r) {
    // At this point size[r] is the memory of the children.
    size[r] = std::max(size[r], lay_out_range(plan.ranges[r], std::move(left[r]), plan.fronts));
    const int parent = plan.parents[r], last = plan.ranges[r].last - 1;
    std::ptrdiff_t& end = parent >= 0 ? size[parent] : plan.updates_size;
    begin[r] = end;
    end += size[r];
    const std::ptrdiff_t update = begin[r] + plan.fronts[last].update;
    if (parent >= 0) left[parent].push_back({update, update + plan.fronts[last].update_size(), last});
  }
  for (std::size_t r = n; r-- > 0;) {
    if (plan.parents[r] >= 0) begin[r] += begin[plan.parents[r]];
    for (int f = plan.ranges[r].first; f < plan.ranges[r].last; ++f) plan.fronts[f].update += begin[r];
  }
}

}  // namespace

std::ptrdiff_t Front::factor_end() const { return below + panels::size(panels, width()); }

std::ptrdiff_t Front::update_size() const { return panels::packed_size(panels); }

double Front::work() const {
  const double c = width(), r = 6.0 * rows();
  return c * (c * c / 3 + c * r + r * r) / 2;
}

std::ptrdiff_t Front::at(int place, int column) const {
  return place < node.columns ? factor + block_at(place, column, width())
                              : below + block_at(place - node.columns, column, width());
}

std::ptrdiff_t Front::update_at(int row, int column) const {
  return update + panels::packed_size(row / per_panel) + block_at(row % per_panel, column, 0);
}

FrontPlan plan_fronts(const BlockMatrix& matrix) {
  Elimination elimination = plan_elimination(matrix, fill_reducing_order(matrix));
  FrontPlan plan;
  plan.node_of = std::move(elimination.node_of);
  plan.fronts.resize(elimination.supernodes.size());
  for (std::size_t f = 0; f < plan.fronts.size(); ++f) plan.fronts[f].node = std::move(elimination.supernodes[f]);
  lay_out_fronts(plan);
  divide(plan);
  lay_out_updates(plan);
  place_blocks(matrix, plan);
  place_children(plan);
  return plan;
}

}  // namespace isojam
