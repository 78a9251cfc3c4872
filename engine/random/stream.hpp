#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string_view>

namespace isojam {

/// Purpose of a stream of random bits; part of its key.
enum class Purpose : std::uint64_t { placement = 1, bootstrap = 2 };

/// A reproducible stream of random bits, a function of its key alone, such as (manifest seed, solid and particles,
/// replicate, purpose). The 64-bit Mersenne twister and std::seed_seq are fixed bit by bit by the C++ standard; the
/// distributions of the standard library are not, so the mapping to uniforms is our own.
class RandomStream {
 public:
  /// The stream of that key.
  RandomStream(std::initializer_list<std::uint64_t> key);

  std::uint64_t bits() { return engine_(); }  ///< 64 of them, all as likely
  /// Uniform in [0, 1), all 2^53 multiples of 2^-53 equally likely.
  double uniform();
  /// Standard normal (Box–Muller).
  double normal();

 private:
  std::mt19937_64 engine_;
};

/// 64-bit FNV-1a of a text, to make a key out of a canonical description.
std::uint64_t hash_of(std::string_view text);

}  // namespace isojam
