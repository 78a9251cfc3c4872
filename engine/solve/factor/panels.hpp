#pragma once

#include <cstddef>

#include "engine/parallel/parallel.hpp"

// Dense matrix operations of the multifrontal factorisation. A matrix is stored in panels of 12 rows, which belong to
// two particles. Each operation then reads its matrices sequentially. Entry (i, j) of a matrix with c columns is at the
// index
//   12·c·⌊i/12⌋ + 12·j + i mod 12.
// If a symmetric matrix is stored as its lower half, panel p has only 12·(p + 1) columns. If the number of
// particles is odd, the second half of the last panel is unused. This half must be zero, and remains zero. The
// arguments `count` are numbers of panels. All other sizes are numbers of doubles.

namespace isojam::panels {

inline constexpr int height = 12;

constexpr std::ptrdiff_t size(int count, int columns) { return std::ptrdiff_t{height} * count * columns; }
constexpr std::ptrdiff_t packed_size(int count) { return std::ptrdiff_t{height} * height * count * (count + 1) / 2; }

/// Threads that process the panels of a front: only the calling thread, or all threads of for_each_in_forest(). `all`
/// may be used only inside a call of for_each_in_forest(). `one` and `all` give the same bits.
enum class Threads { one, all };

/// Calls run(k) for k = 0, …, count − 1, either in this order on the calling thread, or in any order on all threads.
template <class Run>
void for_each(int count, Threads threads, const Run& run) {
  if (threads == Threads::all) return for_each_index_within(count, [&run](std::size_t k) { run(static_cast<int>(k)); });
  for (int k = 0; k < count; ++k) run(k);
}

/// Computes the Cholesky factorisation A = L Lᵀ. A has `width` rows and columns, and `width` is a multiple of 6. Only
/// the lower half of A is read. This half is replaced by L, and 1/L_kk is written to `reciprocals`. The matrix B, which
/// has `count` panels of `width` columns, is replaced by B L⁻ᵀ. Returns false if a pivot is not a positive number.
bool factorise(double* a, int width, double* reciprocals, double* b, int count, Threads threads);

/// Computes the symmetric matrix C = −X Xᵀ, stored as its lower half. X has `count` panels of `width` columns.
void minus_square(const double* x, int width, int count, double* c, Threads threads);

/// Replaces y, which has `width` entries, by L⁻¹ y.
void solve_forward(const double* l, int width, const double* reciprocals, double* y);

/// Replaces y, which has `width` entries, by L⁻ᵀ y.
void solve_backward(const double* l, int width, const double* reciprocals, double* y);

/// Subtracts X z from y, where z has `width` entries and y has 12·count entries.
void subtract_product(const double* x, int width, int count, const double* z, double* y);

/// Subtracts Xᵀ y from z, where y has 12·count entries and z has `width` entries.
void subtract_transposed(const double* x, int width, int count, const double* y, double* z);

}  // namespace isojam::panels
