#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

/// Even permutations of five points, with all signs.
Json truncated_icosidodecahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<std::array<double, 3>, 5> points{
      {{1 / g, 1 / g, 3 + g}, {2 / g, g, 1 + 2 * g}, {1 / g, g * g, 3 * g - 1}, {2 * g - 1, 2, 2 + g}, {g, 3, 2 * g}}};
  Json vertices = Json::array();
  for (const auto& p : points) {
    for (unsigned minus = 0; minus < 8; ++minus) {
      const auto entry = [&](std::size_t c) { return (minus >> c & 1) != 0 ? -p[c] : p[c]; };
      for (std::size_t c = 0; c < 3; ++c) vertices.push_back({entry(c), entry((c + 1) % 3), entry((c + 2) % 3)});
    }
  }
  return vertices;
}

TEST(SolidRuns, JamSolidsOfManyFaces) {
  const test::TemporaryDirectory directory;
  auto manifest = test::tiny_manifest();
  manifest["solids"] = {{"ball", {{"vertices", truncated_icosidodecahedron()}}}};
  manifest["sweep"] = {{"solid", {"ball"}}, {"particles", {32}}};
  manifest["replicates"] = 1;
  manifest["measure"] = {"contacts"};
  test::write_text(directory / "m.json", manifest.dump());
  const auto run = test::isojam({"run", "m.json", "-o", "r"}, directory.path());
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  const auto record = Json::parse(test::files_below(directory / "r" / "records").at("ball-N32-r0000.json"));
  EXPECT_EQ(record.at("spec").at("vertices").size(), 120U);
  const auto exported = test::isojam({"export", "r", "all", "--format", "vtp", "-o", "faces"}, directory.path());
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
}

}  // namespace
}  // namespace isojam
