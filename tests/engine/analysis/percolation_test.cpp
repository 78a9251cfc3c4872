#include "engine/analysis/percolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/engine/analysis/constructed_clusters.hpp"

namespace isojam {
namespace {

using constructed::add_chain;
using constructed::at;
using constructed::block;
using constructed::row;
using constructed::Structure;

RandomPercolation drawn(const Structure& structure, std::size_t bonds, int draws, std::uint64_t key = 1) {
  RandomStream random{key};
  return random_percolation(structure.packing, structure.bonds, bonds, draws, random);
}

TEST(Percolation, OfConstructedClusters) {
  Structure chain = at(30, row(7, 0));
  add_chain(chain, 0, 4);
  const Percolation pieces = percolation(chain.packing, chain.bonds);
  EXPECT_DOUBLE_EQ(pieces.S, (16 + 3) / 7.0);
  EXPECT_DOUBLE_EQ(pieces.largest, 4 / 7.0);
  EXPECT_EQ(pieces.winding_rank, 0);
  EXPECT_EQ(pieces.sizes, (std::map<int, int>{{1, 3}, {4, 1}}));
  const Structure lattice = block({3, 3, 3}, {true, true, true}, 3);
  const Percolation whole = percolation(lattice.packing, lattice.bonds);
  EXPECT_EQ(whole.winding_rank, 3);
  EXPECT_EQ(whole.largest, 1);
  EXPECT_EQ(whole.S, 27);
}

TEST(RandomPercolation, HasTheExtremeCases) {
  const Structure lattice = block({3, 3, 3}, {true, true, true}, 3);
  const RandomPercolation none = drawn(lattice, 0, 5), all = drawn(lattice, lattice.bonds.size(), 5);
  EXPECT_DOUBLE_EQ(none.S, 1);
  EXPECT_DOUBLE_EQ(none.winds[0], 0);
  EXPECT_DOUBLE_EQ(all.S, 27);
  EXPECT_DOUBLE_EQ(all.largest, 1);
  EXPECT_EQ(all.winds[2], 1);
  const RandomPercolation one = drawn(lattice, 1, 50);
  EXPECT_NEAR(one.S, (25 + 4) / 27.0, 1e-13);
  EXPECT_NEAR(one.largest, 2 / 27.0, 1e-14);
}

TEST(RandomPercolation, ChoosesBondsWithEqualProbability) {
  Structure chain = at(30, row(4, 0));
  add_chain(chain, 0, 4);
  ASSERT_EQ(chain.bonds.size(), 3U);
  // Neighbouring bonds give a cluster of three (S = 10/4) in two of three cases, the outer bonds two pairs (S = 8/4).
  const int draws = 20000;
  const double mean = (2 * 2.5 + 2) / 3, error = 0.5 * std::sqrt(2.0 / 9 / draws);
  const double S = drawn(chain, 2, draws).S;
  std::printf("S %.4f, expected %.4f ± %.4f\n", S, mean, error);
  EXPECT_NEAR(S, mean, 5 * error);
}

TEST(RandomPercolation, FindsWindings) {
  const Structure ring = block({5, 1, 1}, {true, false, false}, 5);
  ASSERT_EQ(ring.bonds.size(), 5U);
  EXPECT_EQ(drawn(ring, 4, 100).winds[0], 0);
  EXPECT_EQ(drawn(ring, 5, 200).winds[0], 1);
  EXPECT_EQ(drawn(ring, 5, 100).winds[1], 0);
}

TEST(RandomPercolation, DependsOnlyOnTheKey) {
  const Structure lattice = block({4, 4, 4}, {true, true, true}, 4);
  EXPECT_EQ(drawn(lattice, 40, 30).S, drawn(lattice, 40, 30).S);
  EXPECT_NE(drawn(lattice, 40, 30).S, drawn(lattice, 40, 30, 2).S);
  EXPECT_THROW(drawn(lattice, lattice.bonds.size() + 1, 1), std::invalid_argument);
  EXPECT_THROW(drawn(lattice, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
