#pragma once

#include <cstddef>

#include "engine/parallel/parallel.hpp"

// Dense kernels of the multifrontal factorisation. A matrix is kept in panels of 12 rows, two particles each, so that
// every kernel reads both of its factors as one stream: entry (i, j) of a matrix of c columns is at
//   12·c·(i / 12) + 12·j + i mod 12.
// A symmetric matrix is kept as its lower half, panel by panel: panel p has 12·(p + 1) columns. The last panel of an
// odd number of particles is half padding, which has to be zero and stays so. All sizes in doubles but for panels.

namespace isojam::panels {

inline constexpr int height = 12;

constexpr std::ptrdiff_t size(int count, int columns) { return std::ptrdiff_t{height} * count * columns; }
constexpr std::ptrdiff_t packed_size(int count) { return std::ptrdiff_t{height} * height * count * (count + 1) / 2; }

/// Who works on the panels of a front: the thread that calls, or also others of for_each_in_forest, from which it then
/// has to be called. The bits are the same.
enum class Threads { one, all };

/// Calls run(k) for every k < count, in this order or on all threads.
template <class Run>
void for_each(int count, Threads threads, const Run& run) {
  if (threads == Threads::all) return for_each_index_within(count, [&run](std::size_t k) { run(static_cast<int>(k)); });
  for (int k = 0; k < count; ++k) run(k);
}

/// Puts L of A = L Lᵀ in place of the lower half of A, which has `width` rows and columns, a multiple of 6; what was
/// above the diagonal becomes zero. `reciprocals` receives 1/L_kk. B L⁻ᵀ in place of B, which has `count` panels.
/// False if a pivot was not a positive number.
bool factorise(double* a, int width, double* reciprocals, double* b, int count, Threads threads);

/// Sets C, which is packed, to the lower half of −X Xᵀ; X has `count` panels of `width` columns.
void minus_square(const double* x, int width, int count, double* c, Threads threads);

/// Puts L⁻¹ y in place of y, which has `width` entries.
void solve_forward(const double* l, int width, const double* reciprocals, double* y);

/// Puts L⁻ᵀ y in place of y.
void solve_backward(const double* l, int width, const double* reciprocals, double* y);

/// Takes X z from y: y −= X z, z of `width` entries, y of 12·count.
void subtract_product(const double* x, int width, int count, const double* z, double* y);

/// Takes Xᵀ y from z: z −= Xᵀ y.
void subtract_transposed(const double* x, int width, int count, const double* y, double* z);

}  // namespace isojam::panels
