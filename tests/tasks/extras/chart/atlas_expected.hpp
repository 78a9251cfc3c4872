#pragma once

#include <span>

namespace isojam::test {

/// Expected verdicts of a method in a regime: one letter for each setting, in the order of the atlas.
struct ExpectedCells {
  const char *regime, *method, *verdicts;
};

std::span<const ExpectedCells> expected_overlaps();
std::span<const ExpectedCells> expected_packings();
std::span<const ExpectedCells> expected_minimisers();
std::span<const ExpectedCells> expected_modes();

}  // namespace isojam::test
