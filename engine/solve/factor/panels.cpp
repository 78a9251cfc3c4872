#include "engine/solve/factor/panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/arithmetic/lanes.hpp"

namespace isojam::panels {

namespace {

constexpr int lanes = 4;
constexpr int vectors = height / lanes;

/// Number of columns that are processed together. They have twelve rows each, which leaves registers for the factors.
constexpr int step = 3;

/// Number of columns of the factor that are used in one pass. A panel with so many columns stays in the first-level
/// cache.
constexpr int depth_at_once = 144;

struct Tile {
  Lanes of[step][vectors];
};

inline void load(const double* from, Lanes (&column)[vectors]) {
#pragma GCC unroll 6
  for (int v = 0; v < vectors; ++v) column[v] = Lanes::load(from + lanes * v);
}

inline void store(const Lanes (&column)[vectors], double* to) {
#pragma GCC unroll 6
  for (int v = 0; v < vectors; ++v) column[v].store(to + lanes * v);
}

/// Computes c −= a·b, rounded once.
inline void subtract_product(const Lanes& a, const Lanes& b, Lanes& c) { c = fma(a, -b, c); }

/// Keeps a value in its register. Otherwise the compiler would load it from memory at every use, and loads would become
/// the bottleneck.
inline void keep([[maybe_unused]] Lanes& value) {
#ifdef ISOJAM_AVX2
  asm("" : "+x"(value.v));
#endif
}

/// Computes tile −= A Bᵀ. A is the first `depth` columns of a panel, and B is the same columns of `step` rows of a
/// panel.
inline void subtract_product(const double* a, const double* b, int depth, Tile& tile) {
  for (int k = 0; k < depth; ++k, a += height, b += height) {
    Lanes column[vectors];
    load(a, column);
#pragma GCC unroll 6
    // NOLINTNEXTLINE(modernize-loop-convert): unrolled by the pragma like the loops around it
    for (int v = 0; v < vectors; ++v) keep(column[v]);
#pragma GCC unroll 3
    for (int j = 0; j < step; ++j) {
      const Lanes factor = Lanes::all(b[j]);
#pragma GCC unroll 6
      for (int v = 0; v < vectors; ++v) subtract_product(column[v], factor, tile.of[j][v]);
    }
  }
}

inline void load(const double* from, Tile& tile) {
#pragma GCC unroll 3
  for (int j = 0; j < step; ++j) load(from + height * j, tile.of[j]);
}

inline void store(const Tile& tile, double* to) {
#pragma GCC unroll 3
  for (int j = 0; j < step; ++j) store(tile.of[j], to + height * j);
}

/// Pointer to rows k … k + step − 1 in column 0.
inline const double* rows_at(const double* matrix, int width, int k) {
  return matrix + size(k / height, width) + k % height;
}

/// Computes X L⁻ᵀ for `step` columns X. `l` points to the corresponding square of L.
inline void solve_step(const double* l, const double* reciprocals, Tile& x) {
#pragma GCC unroll 3
  for (int k = 0; k < step; ++k) {
#pragma GCC unroll 3
    for (int j = 0; j < k; ++j) {
#pragma GCC unroll 6
      for (int v = 0; v < vectors; ++v) subtract_product(x.of[j][v], Lanes::all(l[height * j + k]), x.of[k][v]);
    }
#pragma GCC unroll 6
    for (int v = 0; v < vectors; ++v) x.of[k][v] = x.of[k][v] * Lanes::all(reciprocals[k]);
  }
}

/// Computes columns first … last − 1 of one panel of B L⁻ᵀ. The parts due to columns before `first` must already be
/// subtracted.
void solve_panel(const double* l, int width, const double* reciprocals, int first, int last, double* panel) {
  for (int k = first; k < last; k += step) {
    const double* rows = rows_at(l, width, k);
    Tile tile;
    load(panel + height * k, tile);
    subtract_product(panel + height * first, rows + height * first, k - first, tile);
    solve_step(rows + height * k, reciprocals + k, tile);
    store(tile, panel + height * k);
  }
}

/// Subtracts the parts due to columns first … last − 1 from columns last … end − 1 of a panel.
void update_panel(const double* l, int width, int first, int last, int end, double* panel) {
  for (int k = last; k < end; k += step) {
    Tile tile;
    load(panel + height * k, tile);
    subtract_product(panel + height * first, rows_at(l, width, k) + height * first, last - first, tile);
    store(tile, panel + height * k);
  }
}

/// Adds the part due to `depth` columns of X, from `first` on, to panel p of −X Xᵀ. If first = 0, it overwrites the
/// panel. It is a separate function because g++ 12 keeps fewer tiles in registers if it is part of a lambda.
[[gnu::noinline]] void square_panel(const double* x, int width, int first, int depth, int p, double* c) {
  const double* rows = x + size(p, width) + height * first;
  double* to = c + packed_size(p);
  for (int j = 0; j < height * (p + 1); j += step, to += height * step) {
    Tile tile{};
    if (first > 0) load(to, tile);
    subtract_product(rows, rows_at(x, width, j) + height * first, depth, tile);
    store(tile, to);
  }
}

/// Replaces the square of `step` rows and columns at `a` by its factor L. Returns false if a pivot is not a positive
/// number.
bool factorise_step(double* a, double* reciprocals) {
  for (int k = 0; k < step; ++k) {
    const double pivot = a[height * k + k];
    if (!(pivot > 0 && pivot <= std::numeric_limits<double>::max())) return false;
    const double root = std::sqrt(pivot);
    a[height * k + k] = root;
    reciprocals[k] = 1 / root;
    for (int i = k + 1; i < step; ++i) a[height * k + i] *= reciprocals[k];
    for (int j = k + 1; j < step; ++j) {
      for (int i = j; i < step; ++i) a[height * j + i] -= a[height * k + i] * a[height * k + j];
    }
  }
  return true;
}

/// Computes columns k … k + step − 1 of the panel that contains their diagonal. solve_panel() does this for the panels
/// below. Returns false if a pivot is not a positive number.
bool factorise_diagonal(double* panel, int first, int k, double* reciprocals) {
  const int row = k % height;
  double* columns = panel + height * k;
  Tile tile;
  load(columns, tile);
  subtract_product(panel + height * first, panel + height * first + row, k - first, tile);
  double square[height * step];
  store(tile, square);
  if (!factorise_step(square + row, reciprocals)) return false;
  solve_step(square + row, reciprocals, tile);
  store(tile, columns);
  for (int j = 0; j < step; ++j) {
    std::fill_n(columns + height * j, row + j, 0.0);
    std::copy_n(square + height * j + row + j, step - j, columns + height * j + row + j);
  }
  return true;
}

/// Computes column −= panel · z, where z has `depth` entries.
inline void subtract_columns(const double* panel, int depth, const double* z, Lanes (&column)[vectors]) {
  for (int k = 0; k < depth; ++k, panel += height) {
    Lanes term[vectors];
    load(panel, term);
    for (int v = 0; v < vectors; ++v) subtract_product(term[v], Lanes::all(z[k]), column[v]);
  }
}

}  // namespace

bool factorise(double* a, int width, double* reciprocals, double* b, int count, Threads threads) {
  for (int first = 0; first < width; first += depth_at_once) {
    const int last = std::min(first + depth_at_once, width);
    for (int row = first; row < last; row += height) {
      double* panel = a + size(row / height, width);
      solve_panel(a, width, reciprocals, first, row, panel);
      for (int k = row; k < std::min(row + height, last); k += step) {
        if (!factorise_diagonal(panel, first, k, reciprocals + k)) return false;
      }
    }
    // The remaining panels of A come first, then those of B. A panel is updated by the panels above it, which must be
    // solved before.
    const int next = (last + height - 1) / height, below = (width + height - 1) / height - next;
    const auto panel_at = [&](int p) { return p < below ? a + size(next + p, width) : b + size(p - below, width); };
    const auto solve = [&](int p) { solve_panel(a, width, reciprocals, first, last, panel_at(p)); };
    const auto update = [&](int p) {
      const int end = p < below ? std::min(height * (next + p + 1), width) : width;
      update_panel(a, width, first, last, end, panel_at(p));
    };
    if (threads == Threads::all) {
      for_each(below + count, threads, solve);
      for_each(last < width ? below + count : 0, threads, update);
    } else {
      for (int p = 0; p < below + count; ++p) {
        solve(p);
        update(p);
      }
    }
  }
  return true;
}

void minus_square(const double* x, int width, int count, double* c, Threads threads) {
  for (int first = 0; first < width; first += depth_at_once) {
    const int depth = std::min(depth_at_once, width - first);
    for_each(count, threads, [=](int p) { square_panel(x, width, first, depth, p, c); });
  }
}

void solve_forward(const double* l, int width, const double* reciprocals, double* y) {
  for (int first = 0; first < width; first += height) {
    const double* panel = l + size(first / height, width);
    double rows[height] = {};
    const int count = std::min(height, width - first);
    std::copy_n(y + first, count, rows);
    Lanes column[vectors];
    load(rows, column);
    subtract_columns(panel, first, y, column);
    for (int k = 0; k < count; ++k) {
      store(column, rows);
      y[first + k] = rows[k] * reciprocals[first + k];
      subtract_columns(panel + height * (first + k), 1, y + first + k, column);
    }
  }
}

void solve_backward(const double* l, int width, const double* reciprocals, double* y) {
  for (int first = (width - 1) / height * height; first >= 0; first -= height) {
    const double* panel = l + size(first / height, width);
    double rows[height] = {};
    for (int k = std::min(height, width - first) - 1; k >= 0; --k) {
      const double* column = panel + height * (first + k);
      double sum = y[first + k];
      for (int i = height - 1; i > k; --i) sum -= column[i] * rows[i];
      y[first + k] = rows[k] = sum * reciprocals[first + k];
    }
    subtract_transposed(panel, first, 1, rows, y);
  }
}

void subtract_product(const double* x, int width, int count, const double* z, double* y) {
  for (int p = 0; p < count; ++p) {
    Lanes column[vectors];
    load(y + height * p, column);
    subtract_columns(x + size(p, width), width, z, column);
    store(column, y + height * p);
  }
}

void subtract_transposed(const double* x, int width, int count, const double* y, double* z) {
  constexpr int columns = 6;
  for (int k = 0; k < width; k += columns) {
    Lanes sums[columns] = {};
    for (int p = 0; p < count; ++p) {
      const double* from = x + size(p, width) + height * k;
      Lanes rows[vectors];
      load(y + height * p, rows);
#pragma GCC unroll 6
      for (int j = 0; j < columns; ++j) {
        Lanes column[vectors];
        load(from + height * j, column);
#pragma GCC unroll 6
        for (int v = 0; v < vectors; ++v) subtract_product(column[v], rows[v], sums[j]);
      }
    }
    for (int j = 0; j < columns; ++j) {
      double parts[lanes];
      sums[j].store(parts);
      for (const double part : parts) z[k + j] += part;
    }
  }
}

}  // namespace isojam::panels
