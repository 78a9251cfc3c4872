#pragma once

#include <span>

namespace isojam::test {

/// Expected verdicts of the stability atlas (atlas.hpp) for a method in a regime: for each setting, in the order of the
/// atlas, the first letter of an AtlasVerdict. '?' accepts `holds` and `refuses`.
struct ExpectedCells {
  const char *regime, *method, *verdicts;
};

std::span<const ExpectedCells> expected_overlaps();
std::span<const ExpectedCells> expected_packings();
std::span<const ExpectedCells> expected_minimisers();
std::span<const ExpectedCells> expected_modes();

}  // namespace isojam::test
