#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/packings/packing_json.hpp"
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

TEST(SolidDefinitions, NeedParticlesForTheirOwnSize) {
  auto manifest = swept({{"stick", {{"box", {1, 1, 8}}}}}, {"stick"});
  manifest["sweep"]["particles"] = {24};
  std::string all;
  EXPECT_EQ(refused(manifest, &all), std::vector<std::string>{"/sweep/particles/0"});
  EXPECT_NE(all.find("stick"), std::string::npos) << all;
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

/// A box of 1 × 2 × 3 made of 12 triangles.
std::vector<std::array<Vector3d, 3>> box_triangles() {
  const auto corner = [](int k) { return Vector3d(k & 1 ? 1 : 0, k & 2 ? 2 : 0, k & 4 ? 3 : 0); };
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& q : quads) {
    triangles.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    triangles.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
  return triangles;
}

std::string text_stl() {
  std::string text = "solid box of three edges\n";
  for (const auto& triangle : box_triangles()) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto& v : triangle) text += fmt::format("   vertex {:.6e} {:.6e} {:.6e}\n", v.x(), v.y(), v.z());
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid\n";
}

std::string binary_stl() {
  std::string bytes = "solid as binary files may begin too";
  bytes.resize(80, ' ');
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  put(static_cast<std::uint32_t>(box_triangles().size()));
  for (const auto& triangle : box_triangles()) {
    for (int c = 0; c < 3; ++c) put(0.0F);
    for (const auto& v : triangle) {
      for (int c = 0; c < 3; ++c) put(static_cast<float>(v[c]));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

constexpr const char* off = R"(OFF # a box
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
  test::write_text(directory / "shapes" / "a.off", off);
  test::write_text(directory / "shapes" / "b.stl", text_stl());
  test::write_text(directory / "shapes" / "c.stl", binary_stl());
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

TEST(SolidPackings, ComeBackBitForBit) {
  const auto manifest = parse(swept({{"brick", {{"box", {1, 1.5, 2}}}}}, {"brick", "rhombic_dodecahedron"}));
  for (const auto& solid : manifest.solids) {
    RandomStream random{81};
    const auto packing = random_packing(*solid.solid(), 100, .5, random);
    const auto json = to_json(packing);
    EXPECT_EQ(json.contains("vertices"), to_string(solid) == "brick");
    const auto text = Json::parse(json.dump());
    const auto again = read_packing(JsonPlace(text, "p.json"));
    EXPECT_TRUE(again.solids == packing.solids);
    EXPECT_EQ(again.poses, packing.poses);
  }
}

TEST(SolidRuns, NameTheirSolids) {
  const test::TemporaryDirectory directory;
  auto manifest = swept({{"brick", {{"box", {1, 1.2, 1.4}}}}}, {"brick", "truncated_tetrahedron"});
  manifest["sweep"]["particles"] = {60};
  manifest["replicates"] = 1;
  manifest["measure"] = {"contacts", "order", "clusters", "modes", "moduli"};
  manifest["modes"] = 4;
  test::write_text(directory / "m.json", manifest.dump());
  const auto run = test::isojam({"run", "m.json", "-o", "r"}, directory.path());
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_NE(run.out.find("brick"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("truncated_tetrahedron"), std::string::npos) << run.out;
  for (const auto& command : {std::vector<std::string>{"aggregate", "r"},
                              {"report", "r"},
                              {"status", "r"},
                              {"export", "r", "all", "--format", "gsd", "-o", "gsd"}}) {
    const auto done = test::isojam(command, directory.path());
    EXPECT_EQ(done.exit_code, 0) << command.front() << ": " << done.err;
  }
  const auto record = test::files_below(directory / "r" / "records").at("brick-N60-r0000.json");
  EXPECT_EQ(Json::parse(record).at("spec").at("vertices").size(), 8U);
}

}  // namespace
}  // namespace isojam
