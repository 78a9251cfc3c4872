#include <gtest/gtest.h>

#include "tasks/manifest/manifest.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

using test::good_manifest;

Manifest parse(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

std::string differences_to_good(const std::string& pointer, const Json& value) {
  auto other = good_manifest();
  other[Json::json_pointer(pointer)] = value;
  return differences(parse(other), parse(good_manifest()));
}

TEST(Differences, AreNamedWithBothValues) {
  EXPECT_EQ(differences_to_good("/seed", 8), "/seed: 8 in the directory, 7 in this manifest");
  EXPECT_EQ(differences_to_good("/sweep/solid", {"icosahedron"}),
            "/sweep/solid: [\"icosahedron\"] in the directory, [\"dodecahedron\"] in this manifest");
  EXPECT_EQ(differences_to_good("/minimiser/residual", 1e-9),
            "/minimiser/residual: 1e-09 in the directory, 1e-06 in this manifest");
  EXPECT_EQ(differences_to_good("/sweep/fit_window", {0.01, 0.02}),
            "/sweep/fit_window: [0.01,0.02] in the directory, not given in this manifest; "
            "/protocol/fit_window: not given in the directory, 0.02 in this manifest");
  const auto long_list = differences_to_good("/sweep/particles", {100, 101, 102, 103, 104, 105, 106, 107, 108, 109});
  EXPECT_EQ(long_list,
            "/sweep/particles: [100,101,102,103,104,105,106,107,108,... in the directory, [64] in this manifest");
}

TEST(Differences, AreLimitedAndThoseOfTheDigest) {
  auto other = good_manifest();
  other["name"] = "other";
  other["seed"] = 8;
  other["modes"] = 3;
  other["measure"] = Json::array();
  other["protocol"] = {{"fit_window", 0.01}, {"max_steps", 7}, {"longest_step", 0.01}};
  EXPECT_EQ(
      differences(parse(other), parse(good_manifest())),
      "/name: \"other\" in the directory, \"tiny\" in this manifest; /seed: 8 in the directory, 7 in this manifest; "
      "/protocol/longest_step: 0.01 in the directory, 0.05 in this manifest; /protocol/fit_window: 0.01 in the "
      "directory, 0.02 in this manifest; "
      "/protocol/max_steps: 7 in the directory, 400 in this manifest and 2 more");
  auto same = good_manifest();
  same["replicates"] = {{"min", 2}, {"max", 4}, {"quantity", "phi_j"}, {"half_width", 1}};
  same["keep_path"] = true;
  ASSERT_EQ(digest(parse(same)), digest(parse(good_manifest())));
  EXPECT_EQ(differences(parse(same), parse(good_manifest())), "");
}

TEST(Differences, OfStartFilesAreNotShownAsDigests) {
  auto before = parse(good_manifest());
  before.start = Start{};
  before.start->files.push_back({"a.gsd", -1, "0123456789abcdef", {}});
  auto now = before;
  now.start->files[0].digest = "fedcba9876543210";
  EXPECT_EQ(differences(before, now), "the files of /start/packing are not those of the first run");
}

}  // namespace
}  // namespace isojam
