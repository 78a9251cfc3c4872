#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/arithmetic/fma.hpp"

#ifdef __aarch64__
#include <arm_neon.h>
#else
#include <immintrin.h>
#endif
#if defined(__AVX2__) && defined(__FMA__)
#define ISOJAM_AVX2 1
#endif

namespace isojam {

/// Four doubles (lanes): one vector of 256 bits if the build uses AVX2 and FMA, otherwise two vectors of 128 bits. Both
/// versions give the same bits.
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
inline Lanes operator-(Lanes a) { return {-a.v}; }
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

/// Two doubles in a vector of 128 bits, which SSE2 and NEON have, and two integers of 64 bits.
using TwoLanes = double __attribute__((vector_size(16)));
using TwoMasks = decltype(TwoLanes{} < TwoLanes{});

inline TwoLanes loaded_two(const void* p) {
  TwoLanes pair;
  std::memcpy(&pair, p, sizeof(pair));
  return pair;
}
[[gnu::cold, gnu::noinline]] inline TwoLanes fma_in_software(TwoLanes a, TwoLanes b, TwoLanes c) {
  return TwoLanes{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1])};
}
inline TwoMasks bits(TwoLanes a) { return reinterpret_cast<TwoMasks>(a); }
inline TwoLanes of_bits(TwoMasks a) { return reinterpret_cast<TwoLanes>(a); }
#ifdef __aarch64__
inline TwoLanes fma(TwoLanes a, TwoLanes b, TwoLanes c) { return vfmaq_f64(c, a, b); }
inline TwoLanes square_root(TwoLanes a) { return vsqrtq_f64(a); }
inline unsigned sign_bits(TwoLanes a) { return static_cast<unsigned>((bits(a)[0] < 0) | (bits(a)[1] < 0) << 1); }
/// All bits of an element are those of the sign bit of s.
inline TwoMasks sign_mask(TwoLanes s) { return bits(s) >> 63; }
#else
[[gnu::always_inline]] inline TwoLanes fma(TwoLanes a, TwoLanes b, TwoLanes c) {
  if (!has_fma()) [[unlikely]]
    return fma_in_software(a, b, c);
  asm volatile("vfmadd213pd %2, %1, %0" : "+x"(a) : "x"(b), "xm"(c));
  return a;
}
inline TwoLanes square_root(TwoLanes a) { return _mm_sqrt_pd(a); }
inline unsigned sign_bits(TwoLanes a) { return static_cast<unsigned>(_mm_movemask_pd(a)); }
inline TwoMasks sign_mask(TwoLanes s) {
  return reinterpret_cast<TwoMasks>(_mm_shuffle_epi32(_mm_srai_epi32(reinterpret_cast<__m128i>(s), 31), 0b11110101));
}
#endif
inline TwoLanes where_negative(TwoLanes s, TwoLanes a, TwoLanes b) {
  return of_bits((sign_mask(s) & bits(a)) | (~sign_mask(s) & bits(b)));
}
/// Element i of (a, b) and then element j, numbered from 0 to 3.
template <int i, int j>
TwoLanes chosen(TwoLanes a, TwoLanes b) {
  return __builtin_shufflevector(a, b, i, j);
}

struct Lanes {
  TwoLanes low, high;

  static Lanes load(const double* p) { return {loaded_two(p), loaded_two(p + 2)}; }
  static Lanes load(const std::uint64_t* p) { return {loaded_two(p), loaded_two(p + 2)}; }
  static Lanes all(double x) { return {TwoLanes{x, x}, TwoLanes{x, x}}; }
  static Lanes of(double x, double y, double z, double w) { return {TwoLanes{x, y}, TwoLanes{z, w}}; }
  void store(double* p) const { std::memcpy(p, this, sizeof(*this)); }
  double first() const { return low[0]; }
};

inline Lanes operator+(Lanes a, Lanes b) { return {a.low + b.low, a.high + b.high}; }
inline Lanes operator-(Lanes a, Lanes b) { return {a.low - b.low, a.high - b.high}; }
inline Lanes operator-(Lanes a) { return {-a.low, -a.high}; }
inline Lanes operator*(Lanes a, Lanes b) { return {a.low * b.low, a.high * b.high}; }
inline Lanes operator/(Lanes a, Lanes b) { return {a.low / b.low, a.high / b.high}; }
[[gnu::always_inline]] inline Lanes fma(Lanes a, Lanes b, Lanes c) {
  return {fma(a.low, b.low, c.low), fma(a.high, b.high, c.high)};
}
[[gnu::always_inline]] inline Lanes fma_minus(Lanes a, Lanes b, Lanes c) { return fma(a, b, -c); }
inline Lanes min(Lanes a, Lanes b) { return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high}; }
inline Lanes max(Lanes a, Lanes b) { return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high}; }
inline Lanes operator&(Lanes a, Lanes b) {
  return {of_bits(bits(a.low) & bits(b.low)), of_bits(bits(a.high) & bits(b.high))};
}
inline Lanes operator|(Lanes a, Lanes b) {
  return {of_bits(bits(a.low) | bits(b.low)), of_bits(bits(a.high) | bits(b.high))};
}
inline Lanes absolute(Lanes a) { return a & Lanes::all(std::bit_cast<double>(~std::uint64_t{0} >> 1)); }
inline Lanes where_negative(Lanes s, Lanes a, Lanes b) {
  return {where_negative(s.low, a.low, b.low), where_negative(s.high, a.high, b.high)};
}
inline Lanes equal(Lanes a, Lanes b) { return {of_bits(a.low == b.low), of_bits(a.high == b.high)}; }
inline Lanes halves(Lanes a, Lanes b) { return {a.low, b.high}; }
inline Lanes without_fourth(Lanes a) { return {a.low, chosen<0, 2>(a.high, TwoLanes{})}; }
inline unsigned sign_bits(Lanes a) { return sign_bits(a.low) | sign_bits(a.high) << 2; }
inline void transpose(const double* p, const double* q, const double* r, const double* s, Lanes& x, Lanes& y,
                      Lanes& z) {
  const Lanes a = Lanes::load(p), b = Lanes::load(q), c = Lanes::load(r), d = Lanes::load(s);
  x = {chosen<0, 2>(a.low, b.low), chosen<0, 2>(c.low, d.low)};
  y = {chosen<1, 3>(a.low, b.low), chosen<1, 3>(c.low, d.low)};
  z = {chosen<0, 2>(a.high, b.high), chosen<0, 2>(c.high, d.high)};
}
inline void rows_of(Lanes x, Lanes y, Lanes z, Lanes* rows) {
  rows[0] = {chosen<0, 2>(x.low, y.low), chosen<0, 2>(z.low, TwoLanes{})};
  rows[1] = {chosen<1, 3>(x.low, y.low), chosen<1, 3>(z.low, TwoLanes{})};
  rows[2] = {chosen<0, 2>(x.high, y.high), chosen<0, 2>(z.high, TwoLanes{})};
  rows[3] = {chosen<1, 3>(x.high, y.high), chosen<1, 3>(z.high, TwoLanes{})};
}
inline Lanes square_root(Lanes a) { return {square_root(a.low), square_root(a.high)}; }
inline Lanes yzx(Lanes a) { return {chosen<1, 2>(a.low, a.high), chosen<0, 3>(a.low, a.high)}; }
inline Lanes yzwx(Lanes a) { return {chosen<1, 2>(a.low, a.high), chosen<1, 2>(a.high, a.low)}; }
inline Lanes swapped_pairs(Lanes a) { return {chosen<1, 0>(a.low, a.low), chosen<1, 0>(a.high, a.high)}; }
inline Lanes swapped_halves(Lanes a) { return {a.high, a.low}; }
template <int k>
Lanes lane(Lanes a) {
  return Lanes::all((k < 2 ? a.low : a.high)[k % 2]);
}
inline std::uint32_t equal_unions(std::uint64_t bytes, const std::uint8_t* tail, const std::uint8_t* head,
                                  std::uint32_t all) {
  std::uint8_t of[8];
  std::memcpy(of, &bytes, sizeof(of));
  std::uint32_t same = 0;
  for (int e = 0; e < 16; ++e) same |= std::uint32_t{(of[tail[e]] | of[head[e]]) == all} << e;
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
