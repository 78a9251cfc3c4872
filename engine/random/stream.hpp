#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string_view>

namespace isojam {

/// Purpose of a random stream; it is one element of the key of the stream.
enum class Purpose : std::uint64_t { placement = 1, bootstrap = 2, percolation = 3 };

/// A reproducible stream of random bits, which depends only on its key: for example the seed of the manifest, the
/// solid, the number of particles, the replicate and the purpose. The C++ standard defines the 64-bit Mersenne twister
/// and std::seed_seq bit by bit, but not its random distributions, so this class itself converts the bits to random
/// numbers.
class RandomStream {
 public:
  /// The stream with this key.
  RandomStream(std::initializer_list<std::uint64_t> key);

  std::uint64_t bits() { return engine_(); }  ///< the next 64 independent random bits
  /// A uniform random number in [0, 1). All 2^53 multiples of 2^-53 are equally likely.
  double uniform();
  /// A random number with the standard normal distribution (Box–Muller method).
  double normal();

 private:
  std::mt19937_64 engine_;
};

/// 64-bit FNV-1a hash of a text, which makes a number for a key from a text such as the name of a solid.
std::uint64_t hash_of(std::string_view text);

}  // namespace isojam
