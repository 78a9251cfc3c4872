#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string_view>

namespace isojam {

/// Purpose of a stream of random bits; part of its key.
enum class Purpose : std::uint64_t { placement = 1, bootstrap = 2 };

/// A reproducible stream of random bits that depends only on its key, such as (manifest seed, solid and particles,
/// replicate, purpose). The C++ standard fixes the 64-bit Mersenne twister and std::seed_seq bit by bit. It does not
/// fix its distributions, so this class maps bits to uniform numbers itself.
class RandomStream {
 public:
  /// The stream with this key.
  RandomStream(std::initializer_list<std::uint64_t> key);

  std::uint64_t bits() { return engine_(); }  ///< 64 independent random bits
  /// Uniform in [0, 1), all 2^53 multiples of 2^-53 equally likely.
  double uniform();
  /// Standard normal (Box–Muller).
  double normal();

 private:
  std::mt19937_64 engine_;
};

/// 64-bit FNV-1a hash of a text; makes a key from a canonical description.
std::uint64_t hash_of(std::string_view text);

}  // namespace isojam
