#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tests/tasks/packings/meshes.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

Json swept(const Json& solids, const std::vector<std::string>& names) {
  auto manifest = test::tiny_manifest();
  if (!solids.is_null()) manifest["solids"] = solids;
  manifest["sweep"]["solid"] = names;
  manifest["sweep"]["particles"] = {200};
  return manifest;
}

Manifest parse(const Json& manifest, const std::string& file = "m.json") {
  return parse_manifest(manifest.dump(), file);
}

/// Pointers of the errors. Their whole text is added to `all`.
std::vector<std::string> refused(const Json& manifest, std::string* all = nullptr) {
  try {
    parse(manifest);
    return {};
  } catch (const InputError& error) {
    std::vector<std::string> pointers;
    for (const auto& each : error.all()) pointers.push_back(each.pointer);
    if (all) *all = error.what();
    return pointers;
  }
}

const Json tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(SolidDefinitions, AreSweptByTheirNames) {
  const Json solids{{"brick", {{"box", {1, 1.5, 2}}}}, {"mine", {{"vertices", tetrahedron}}}};
  const auto manifest = parse(swept(solids, {"mine", "prism6", "brick", "truncated_tetrahedron", "cube"}));
  std::vector<std::string> names;
  for (const auto& solid : manifest.solids) names.emplace_back(to_string(solid));
  EXPECT_EQ(names, (std::vector<std::string>{"cube", "truncated_tetrahedron", "prism6", "brick", "mine"}));
  const ConvexSolid& brick = *manifest.solids[3].solid();
  const double scale = std::cbrt(3.0);
  EXPECT_NEAR(brick.inradius(), .5 / scale, 1e-15);
  EXPECT_NEAR(brick.circumradius(), std::sqrt(1 + 2.25 + 4) / 2 / scale, 1e-15);
}

TEST(SolidDefinitions, InvalidSolidsAreRejectedAtOnce) {
  auto with_inner = tetrahedron;
  with_inner.insert(with_inner.begin() + 1, Json{.1, .1, .1});
  const Json solids{{"2nd", {{"box", {1, 1, 1}}}},
                    {"cube", {{"box", {1, 1, 1}}}},
                    {"dented", {{"vertices", with_inner}}},
                    {"far", {{"vertices", {{1e10, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}}}},
                    {"flat", {{"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}}},
                    {"gone", {{"file", "no-such-file.off"}}},
                    {"half", {{"box", {1, 2}}}},
                    {"long", {{"box", {1, 1, 1e4}}}},
                    {"none", Json::object()},
                    {"sheet", {{"box", {1, 1e-17, 1}}}},
                    {"slab", {{"box", {1, 0, 1}}}},
                    {"thread", {{"box", {1, 1, 1e9}}}},
                    {"twice", {{"box", {1, 1, 1}}, {"file", "x.off"}}},
                    {"wrong", {{"sphere", 1}}}};
  std::string all;
  EXPECT_EQ(refused(swept(solids, {"dented", "flat", "sphere", "prism4"}), &all),
            (std::vector<std::string>{"/sweep/solid/2", "/sweep/solid/3", "/solids/2nd", "/solids/cube",
                                      "/solids/dented/vertices/1", "/solids/far/vertices/0/0", "/solids/flat/vertices",
                                      "/solids/gone/file", "/solids/half/box", "/solids/long/box", "/solids/none",
                                      "/solids/sheet/box", "/solids/slab/box/1", "/solids/thread/box", "/solids/twice",
                                      "/solids/wrong/sphere"}))
      << all;
  EXPECT_NE(all.find("inside the hull of the others"), std::string::npos) << all;
  EXPECT_NE(all.find("prism3, prism5 to prism64, "), std::string::npos) << all;
}

TEST(SolidDefinitions, TooManyFeaturesAreRejected) {
  Json sphere = Json::array();
  for (int k = 0; k < 67; ++k) {
    const double z = (2.0 * k + 1) / 67 - 1, turn = 2.4 * k, r = std::sqrt(1 - z * z);
    sphere.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  std::string all;
  EXPECT_EQ(refused(swept({{"ball", {{"vertices", sphere}}}}, {"ball"}), &all),
            std::vector<std::string>{"/solids/ball/vertices"});
  EXPECT_NE(all.find("195 edges and 130 faces"), std::string::npos) << "edges and faces of 67 points: " << all;
  EXPECT_NE(all.find("set \"corners\" to 66"), std::string::npos) << all;
}

TEST(SolidDefinitions, CanonicalFormContainsTheVertices) {
  const Json solids{{"brick", {{"box", {1, 1.5, 2}}}}, {"unused", {{"box", {1, 1, 3}}}}};
  const auto manifest = parse(swept(solids, {"brick", "cube"}));
  const auto canonical = to_json(manifest);
  EXPECT_EQ(canonical.at("solids").size(), 1U) << canonical.dump();
  EXPECT_EQ(canonical.at("solids").at("brick").at("vertices").size(), 8U);
  EXPECT_EQ(to_json(parse(canonical)), canonical);
  EXPECT_EQ(to_json(parse(canonical)), to_json(manifest));
  EXPECT_EQ(parse(canonical).solids, manifest.solids) << "the same solid, to the last bit";
  EXPECT_NE(to_json(parse(swept({{"brick", {{"box", {1, 1.5, 2.5}}}}}, {"brick", "cube"}))), to_json(manifest));
  EXPECT_FALSE(to_json(parse(swept(nullptr, {"cube"}))).contains("solids")) << "manifests of old keep their digests";
}

/// A box of 1 × 2 × 3.
test::Sample box() {
  auto sample = test::cube();
  for (auto& p : sample.points) p = (p + Vector3d::Constant(.5)).cwiseProduct(Vector3d(1, 2, 3));
  return sample;
}

constexpr const char* commented_off = R"(OFF # a box
8 6 12
0 0 0
1 0 0
1 2 0
0 2 0
0 0 3   # the top
1 0 3
1 2 3
0 2 3
4 3 2 1 0
4 4 5 6 7 255 0 0
4 0 1 5 4
4 2 3 7 6
4 1 2 6 5
4 0 4 7 3
)";

TEST(SolidFiles, AreRelativeToTheManifest) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "shapes");
  test::write_text(directory / "shapes" / "a.off", commented_off);
  test::write_text(directory / "shapes" / "b.stl", test::text_stl(test::triangles(box())));
  test::write_text(directory / "shapes" / "c.stl", test::binary_stl(test::triangles(box())));
  const Json solids{{"a", {{"file", "shapes/a.off"}}},
                    {"b", {{"file", "shapes/b.stl"}}},
                    {"c", {{"file", "shapes/c.stl"}}},
                    {"d", {{"box", {1, 2, 3}}}}};
  const auto manifest = parse(swept(solids, {"a", "b", "c", "d"}), (directory / "m.json").string());
  for (const auto& solid : manifest.solids) {
    EXPECT_EQ(solid.solid()->faces().size(), 6U) << to_string(solid);
    EXPECT_NEAR(solid.solid()->inradius(), .5 / std::cbrt(6.0), 1e-15) << to_string(solid);
    EXPECT_NEAR(solid.solid()->diameter(), std::sqrt(14.0) / std::cbrt(6.0), 1e-15) << to_string(solid);
  }
  EXPECT_EQ(parse(to_json(manifest)).solids, manifest.solids) << "without the files";
}

}  // namespace
}  // namespace isojam
