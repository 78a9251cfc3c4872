#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#define ISOJAM_AVX2 1
#endif

namespace isojam {

/// Four doubles (lanes). If the build uses AVX2 and FMA, they are in one vector register. Otherwise the portable
/// version below is used. It gives the same bits, but it is much slower if the compiler translates std::fma to a call
/// of the C library.
#ifdef ISOJAM_AVX2

struct Lanes {
  __m256d v;

  static Lanes load(const double* p) { return {_mm256_loadu_pd(p)}; }
  static Lanes load(const std::uint64_t* p) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the intrinsic requires it
    return {_mm256_castsi256_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)))};
  }
  static Lanes all(double x) { return {_mm256_set1_pd(x)}; }
  static Lanes of(double x, double y, double z, double w) { return {_mm256_setr_pd(x, y, z, w)}; }
  void store(double* p) const { _mm256_storeu_pd(p, v); }
  double first() const { return _mm256_cvtsd_f64(v); }
};

inline Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_pd(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {_mm256_div_pd(a.v, b.v)}; }
inline Lanes fma(Lanes a, Lanes b, Lanes c) { return {_mm256_fmadd_pd(a.v, b.v, c.v)}; }
inline Lanes fma_minus(Lanes a, Lanes b, Lanes c) { return {_mm256_fmsub_pd(a.v, b.v, c.v)}; }
inline Lanes min(Lanes a, Lanes b) { return {_mm256_min_pd(a.v, b.v)}; }
inline Lanes max(Lanes a, Lanes b) { return {_mm256_max_pd(a.v, b.v)}; }
inline Lanes absolute(Lanes a) { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)}; }
/// Selects for each lane: a if the sign bit of s is set, otherwise b.
inline Lanes where_negative(Lanes s, Lanes a, Lanes b) { return {_mm256_blendv_pd(b.v, a.v, s.v)}; }
/// Compares each lane: the sign bit of the result is set if a = b, and clear otherwise. The other bits differ between
/// the two versions; do not use them.
inline Lanes equal(Lanes a, Lanes b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)}; }
/// Joins lanes 0 and 1 of a with lanes 2 and 3 of b.
inline Lanes halves(Lanes a, Lanes b) { return {_mm256_blend_pd(a.v, b.v, 0b1100)}; }
inline Lanes without_fourth(Lanes a) { return {_mm256_blend_pd(a.v, _mm256_setzero_pd(), 0b1000)}; }
/// A number whose bit k is the sign bit of lane k.
inline unsigned sign_bits(Lanes a) { return static_cast<unsigned>(_mm256_movemask_pd(a.v)); }
inline Lanes operator&(Lanes a, Lanes b) { return {_mm256_and_pd(a.v, b.v)}; }  ///< bitwise
inline Lanes operator|(Lanes a, Lanes b) { return {_mm256_or_pd(a.v, b.v)}; }
/// Sets x, y, z to the first three components of four rows.
inline void transpose(const double* p, const double* q, const double* r, const double* s, Lanes& x, Lanes& y,
                      Lanes& z) {
  const __m256d a = _mm256_loadu_pd(p), b = _mm256_loadu_pd(q), c = _mm256_loadu_pd(r), d = _mm256_loadu_pd(s);
  const __m256d even = _mm256_unpacklo_pd(a, b), even_2 = _mm256_unpacklo_pd(c, d);
  x = {_mm256_permute2f128_pd(even, even_2, 0x20)};
  y = {_mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20)};
  z = {_mm256_permute2f128_pd(even, even_2, 0x31)};
}
/// Stores the four rows (x, y, z, 0).
inline void rows_of(Lanes x, Lanes y, Lanes z, Lanes* rows) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d even = _mm256_unpacklo_pd(x.v, y.v), odd = _mm256_unpackhi_pd(x.v, y.v);
  const __m256d even_z = _mm256_unpacklo_pd(z.v, zero), odd_z = _mm256_unpackhi_pd(z.v, zero);
  rows[0] = {_mm256_permute2f128_pd(even, even_z, 0x20)}, rows[1] = {_mm256_permute2f128_pd(odd, odd_z, 0x20)};
  rows[2] = {_mm256_permute2f128_pd(even, even_z, 0x31)}, rows[3] = {_mm256_permute2f128_pd(odd, odd_z, 0x31)};
}
inline Lanes square_root(Lanes a) { return {_mm256_sqrt_pd(a.v)}; }
inline Lanes yzx(Lanes a) { return {_mm256_permute4x64_pd(a.v, 0b11001001)}; }
/// The lanes in the order 1, 2, 3, 0.
inline Lanes yzwx(Lanes a) { return {_mm256_permute4x64_pd(a.v, 0b00111001)}; }
/// The lanes in the order 1, 0, 3, 2.
inline Lanes swapped_pairs(Lanes a) { return {_mm256_permute_pd(a.v, 0b0101)}; }
/// The lanes in the order 2, 3, 0, 1.
inline Lanes swapped_halves(Lanes a) { return {_mm256_permute2f128_pd(a.v, a.v, 1)}; }
template <int k>
Lanes lane(Lanes a) {
  return {_mm256_permute4x64_pd(a.v, 0b01010101 * k)};
}
/// Compares 16 pairs of bytes with `all`. Let b_k be byte k of `bytes`, t = tail[e] and h = head[e]. Then bit e of the
/// result is set if b_t | b_h = `all`, for e = 0 … 15. All t and h must be below 8. `tail` and `head` must be aligned
/// to 16 bytes.
inline std::uint32_t equal_unions(std::uint64_t bytes, const std::uint8_t* tail, const std::uint8_t* head,
                                  std::uint32_t all) {
  const __m128i table = _mm_cvtsi64_si128(static_cast<long long>(bytes));
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the intrinsic requires it
  const __m128i t = _mm_shuffle_epi8(table, _mm_load_si128(reinterpret_cast<const __m128i*>(tail)));
  const __m128i h = _mm_shuffle_epi8(table, _mm_load_si128(reinterpret_cast<const __m128i*>(head)));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  const __m128i same = _mm_cmpeq_epi8(_mm_or_si128(t, h), _mm_set1_epi8(static_cast<char>(all)));
  return static_cast<std::uint32_t>(_mm_movemask_epi8(same));
}

#else

struct Lanes {
  double v[4];

  static Lanes load(const double* p) { return {{p[0], p[1], p[2], p[3]}}; }
  static Lanes load(const std::uint64_t* p) {
    return {{std::bit_cast<double>(p[0]), std::bit_cast<double>(p[1]), std::bit_cast<double>(p[2]),
             std::bit_cast<double>(p[3])}};
  }
  static Lanes all(double x) { return {{x, x, x, x}}; }
  static Lanes of(double x, double y, double z, double w) { return {{x, y, z, w}}; }
  void store(double* p) const {
    for (int k = 0; k < 4; ++k) p[k] = v[k];
  }
  double first() const { return v[0]; }
};

template <class Function>
Lanes each(const Function& function) {
  return {{function(0), function(1), function(2), function(3)}};
}

inline Lanes operator+(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] + b.v[k]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] - b.v[k]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] * b.v[k]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] / b.v[k]; });
}
inline Lanes fma(Lanes a, Lanes b, Lanes c) {
  return each([&](int k) { return std::fma(a.v[k], b.v[k], c.v[k]); });
}
inline Lanes fma_minus(Lanes a, Lanes b, Lanes c) {
  return each([&](int k) { return std::fma(a.v[k], b.v[k], -c.v[k]); });
}
inline Lanes min(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes max(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes absolute(Lanes a) {
  return each([&](int k) { return std::abs(a.v[k]); });
}
inline Lanes where_negative(Lanes s, Lanes a, Lanes b) {
  return each([&](int k) { return std::signbit(s.v[k]) ? a.v[k] : b.v[k]; });
}
inline Lanes equal(Lanes a, Lanes b) {
  return each([&](int k) { return a.v[k] == b.v[k] ? -1.0 : 1.0; });
}
inline Lanes halves(Lanes a, Lanes b) { return {{a.v[0], a.v[1], b.v[2], b.v[3]}}; }
inline Lanes without_fourth(Lanes a) { return {{a.v[0], a.v[1], a.v[2], 0}}; }
inline unsigned sign_bits(Lanes a) {
  unsigned bits = 0;
  for (int k = 0; k < 4; ++k) bits |= unsigned{std::signbit(a.v[k])} << k;
  return bits;
}
inline Lanes operator&(Lanes a, Lanes b) {
  return each([&](int k) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a.v[k]) & std::bit_cast<std::uint64_t>(b.v[k]));
  });
}
inline Lanes operator|(Lanes a, Lanes b) {
  return each([&](int k) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a.v[k]) | std::bit_cast<std::uint64_t>(b.v[k]));
  });
}
inline void transpose(const double* p, const double* q, const double* r, const double* s, Lanes& x, Lanes& y,
                      Lanes& z) {
  x = Lanes::of(p[0], q[0], r[0], s[0]), y = Lanes::of(p[1], q[1], r[1], s[1]), z = Lanes::of(p[2], q[2], r[2], s[2]);
}
inline void rows_of(Lanes x, Lanes y, Lanes z, Lanes* rows) {
  for (int k = 0; k < 4; ++k) rows[k] = Lanes::of(x.v[k], y.v[k], z.v[k], 0);
}
inline Lanes square_root(Lanes a) {
  return each([&](int k) { return std::sqrt(a.v[k]); });
}
inline Lanes yzx(Lanes a) { return {{a.v[1], a.v[2], a.v[0], a.v[3]}}; }
inline Lanes yzwx(Lanes a) { return {{a.v[1], a.v[2], a.v[3], a.v[0]}}; }
inline Lanes swapped_pairs(Lanes a) { return {{a.v[1], a.v[0], a.v[3], a.v[2]}}; }
inline Lanes swapped_halves(Lanes a) { return {{a.v[2], a.v[3], a.v[0], a.v[1]}}; }
template <int k>
Lanes lane(Lanes a) {
  return Lanes::all(a.v[k]);
}
inline std::uint32_t equal_unions(std::uint64_t bytes, const std::uint8_t* tail, const std::uint8_t* head,
                                  std::uint32_t all) {
  std::uint32_t same = 0;
  for (int e = 0; e < 16; ++e)
    same |= std::uint32_t{((bytes >> 8 * tail[e] | bytes >> 8 * head[e]) & 0xFF) == all} << e;
  return same;
}

#endif

/// Numbers for the tags of doubles. tagged() stores an index below `range`, a power of two, in the last log2(range) of
/// the 52 mantissa bits of a double, and tag_of() reads it. The minimum or maximum of tagged doubles therefore contains
/// the index of the element where it was found.
template <std::uint64_t range>
struct Tags {
  alignas(32) std::uint64_t mask[4] = {-range, -range, -range, -range};
  alignas(32) std::uint64_t number[range];
  constexpr Tags() : number() {
    for (std::uint64_t k = 0; k < range; ++k) number[k] = k;
  }
};
template <std::uint64_t range>
inline constexpr Tags<range> tags;

/// Stores the index first + k in lane k. `first` must be a multiple of 4 below `range`.
template <std::uint64_t range>
Lanes tagged(Lanes a, int first) {
  return (a & Lanes::load(tags<range>.mask)) | Lanes::load(tags<range>.number + first);
}
template <std::uint64_t range>
std::uint32_t tag_of(double x) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x) & (range - 1));
}

/// least(), greatest() and sum() compute the minimum, maximum or sum of all lanes. Every lane of the result contains
/// it.
inline Lanes least(Lanes a) {
  const Lanes pairs = min(a, swapped_pairs(a));
  return min(pairs, swapped_halves(pairs));
}
inline Lanes greatest(Lanes a) {
  const Lanes pairs = max(a, swapped_pairs(a));
  return max(pairs, swapped_halves(pairs));
}
inline Lanes sum(Lanes a) {
  const Lanes pairs = a + swapped_pairs(a);
  return pairs + swapped_halves(pairs);
}

/// The components of a×b in the order z, x, y. For a sum of such products, the permutation to x, y, z is needed only
/// once, at the end.
inline Lanes cross_zxy(Lanes a, Lanes b) { return fma_minus(a, yzx(b), yzx(a) * b); }

}  // namespace isojam
