#include "engine/random/stream.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

std::mt19937_64 seeded(std::initializer_list<std::uint64_t> key) {
  // seed_seq mixes 32-bit words, so each 64-bit word of the key is passed as two halves.
  std::vector<std::uint32_t> words;
  for (const std::uint64_t word : key) {
    words.push_back(static_cast<std::uint32_t>(word));
    words.push_back(static_cast<std::uint32_t>(word >> 32));
  }
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::initializer_list<std::uint64_t> key) : engine_(seeded(key)) {}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double RandomStream::normal() {
  const double radius = std::sqrt(-2 * nearest::log1p(-uniform()));
  return radius * nearest::cos(2 * std::numbers::pi * uniform());
}

std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

}  // namespace isojam
