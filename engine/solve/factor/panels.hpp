#pragma once

#include <cstddef>

#include "engine/parallel/parallel.hpp"

// Dense kernels of the multifrontal factorisation. A matrix is stored in panels of 12 rows, two particles each, so that
// every kernel reads both of its factors as one stream: entry (i, j) of a matrix with c columns is at
//   12·c·(i / 12) + 12·j + i mod 12.
// A symmetric matrix is stored as its lower half, panel by panel: panel p has 12·(p + 1) columns. For an odd number of
// particles the last panel is half padding, which must be zero and remains zero. Sizes are in doubles, except that
// `count` is in panels.

namespace isojam::panels {

inline constexpr int height = 12;

constexpr std::ptrdiff_t size(int count, int columns) { return std::ptrdiff_t{height} * count * columns; }
constexpr std::ptrdiff_t packed_size(int count) { return std::ptrdiff_t{height} * height * count * (count + 1) / 2; }

/// Threads for the panels of a front: only the calling thread, or also other threads of for_each_in_forest, which must
/// then be the caller. Both give the same bits.
enum class Threads { one, all };

/// Calls run(k) for every k < count, in this order or on all threads.
template <class Run>
void for_each(int count, Threads threads, const Run& run) {
  if (threads == Threads::all) return for_each_index_within(count, [&run](std::size_t k) { run(static_cast<int>(k)); });
  for (int k = 0; k < count; ++k) run(k);
}

/// Replaces the lower half of A by L, A = L Lᵀ, and the upper half by zero. A has `width` rows and columns, a multiple
/// of 6. `reciprocals` receives 1/L_kk. Replaces B, which has `count` panels, by B L⁻ᵀ. Returns false if a pivot is not
/// a positive number.
bool factorise(double* a, int width, double* reciprocals, double* b, int count, Threads threads);

/// Sets C, a packed symmetric matrix, to the lower half of −X Xᵀ; X has `count` panels of `width` columns.
void minus_square(const double* x, int width, int count, double* c, Threads threads);

/// Replaces y, which has `width` entries, by L⁻¹ y.
void solve_forward(const double* l, int width, const double* reciprocals, double* y);

/// Replaces y by L⁻ᵀ y.
void solve_backward(const double* l, int width, const double* reciprocals, double* y);

/// y −= X z; z has `width` entries, y has 12·count.
void subtract_product(const double* x, int width, int count, const double* z, double* y);

/// z −= Xᵀ y.
void subtract_transposed(const double* x, int width, int count, const double* y, double* z);

}  // namespace isojam::panels
