#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/warnings.hpp"
#include "tests/tasks/packings/meshes.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using namespace test;

Json swept(const Json& solid) {
  auto manifest = tiny_manifest();
  manifest["solids"] = {{"mine", solid}};
  manifest["sweep"]["solid"] = {"mine"};
  manifest["sweep"]["particles"] = {200};
  return manifest;
}

Manifest parse(const Json& solid, const std::string& file = "m.json") {
  EXPECT_EQ(violations("manifest", swept(solid)), "");
  return parse_manifest(swept(solid).dump(), file);
}

/// The warnings about solids.
std::vector<std::string> warned(const Manifest& manifest) {
  auto all = warnings_of(manifest);
  std::erase_if(all, [](const std::string& text) { return !text.starts_with("/solids/"); });
  return all;
}

/// A dodecahedron whose coordinates are rounded by `round`.
template <class Round>
Json dodecahedron(const Round& round) {
  const double golden = std::numbers::phi;
  Json vertices = Json::array();
  const auto add = [&](double x, double y, double z) { vertices.push_back({round(x), round(y), round(z)}); };
  for (const double a : {-1, 1}) {
    for (const double b : {-1, 1}) {
      for (const double c : {-1, 1}) add(a, b, c);
      add(0, a / golden, b * golden);
      add(a / golden, b * golden, 0);
      add(a * golden, 0, b / golden);
    }
  }
  return vertices;
}

double six_digits(double x) { return std::round(x * 1e6) / 1e6; }
double single(double x) { return static_cast<double>(static_cast<float>(x)); }
double exact(double x) { return x; }

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in \"" << text << "\"";
}

/// The value of `merge` in a text; 0 if there is none.
double proposed(const std::string& text) {
  const std::string key = "\"merge\" to ";
  const auto at = text.find(key);
  return at == std::string::npos ? 0 : std::stod(text.substr(at + key.size()));
}

std::array<std::size_t, 3> features(const Manifest& manifest) {
  const ConvexSolid& solid = *manifest.solids[0].solid();
  return {solid.faces().size(), solid.edges().size(), solid.vertices().size()};
}

constexpr std::array<std::size_t, 3> published{12, 30, 20};

TEST(SolidRepairs, JoinFacesOfVerticesWithFewDigits) {
  EXPECT_EQ(features(parse({{"vertices", dodecahedron(exact)}})), published);
  EXPECT_TRUE(warned(parse({{"vertices", dodecahedron(exact)}})).empty());
  for (const auto& [vertices, precision] : {std::pair(dodecahedron(six_digits), "the vertices have 7 digits"),
                                            std::pair(dodecahedron(single), "the vertices are in single precision")}) {
    const auto rounded = parse({{"vertices", vertices}});
    EXPECT_GT(features(rounded)[0], published[0]) << "nothing is joined without a request";
    const auto warnings = warned(rounded);
    ASSERT_EQ(warnings.size(), 1U);
    std::printf("%s\n", warnings[0].c_str());
    expect_part(warnings[0], "/solids/mine: the normals of the two faces at the edge from (");
    expect_part(warnings[0], precision);
    const double merge = proposed(warnings[0]);
    EXPECT_GT(merge, 0);
    EXPECT_LT(merge, 1e-5);
    const auto joined = parse({{"vertices", vertices}, {"merge", merge}});
    EXPECT_EQ(features(joined), published);
    EXPECT_TRUE(warned(joined).empty());
    EXPECT_GT(joined.definitions.at("mine").report.joined_faces, 0);
    EXPECT_LT(joined.definitions.at("mine").report.largest_move, 10 * merge);
    // The copy of the manifest needs no repair.
    const auto copy = to_json(joined);
    EXPECT_FALSE(copy.at("solids").at("mine").contains("merge"));
    const auto again = parse_manifest(copy.dump(), "copy.json");
    EXPECT_EQ(again.solids, joined.solids) << "the same solid, to the last bit";
    EXPECT_EQ(to_json(again), copy);
    EXPECT_TRUE(warned(again).empty());
  }
}

TEST(SolidRepairs, AreMadeOnRequestOnly) {
  Json points = Json::array();
  for (const auto& p : cube().points) points.push_back({p.x(), p.y(), p.z()});
  auto more = points;
  more.push_back({.1, 0, 0});
  expect_part(refusal(swept({{"vertices", more}})), "/solids/mine/vertices/8: ");
  const auto hull = parse({{"vertices", more}, {"hull", true}});
  EXPECT_EQ(features(hull), (std::array<std::size_t, 3>{6, 12, 8}));
  EXPECT_EQ(hull.definitions.at("mine").report.dropped, 1);
  more.back() = {.5, .5, .5 + 1e-9};
  EXPECT_NE(features(parse({{"vertices", points}})), features(parse({{"vertices", more}, {"hull", true}})));
  const auto welded = parse({{"vertices", more}, {"merge", 1e-8}});
  EXPECT_EQ(features(welded), (std::array<std::size_t, 3>{6, 12, 8}));
  EXPECT_EQ(welded.definitions.at("mine").report.welded, 1);
  expect_part(refusal(swept({{"vertices", points}, {"corners", 6}})), "set \"max_volume_change\" to 0.34");
  const auto fewer = parse({{"vertices", points}, {"corners", 6}, {"max_volume_change", .34}});
  const auto copy = to_json(fewer).at("solids").at("mine");
  std::printf("copy of the definition: volume_change %g\n", copy.at("volume_change").get<double>());
  EXPECT_EQ(copy.at("volume_change"), fewer.definitions.at("mine").report.volume_change);
  EXPECT_EQ(features(fewer)[2], 6U);
  EXPECT_EQ(fewer.definitions.at("mine").report.removed_corners, 2);
  EXPECT_LT(fewer.definitions.at("mine").report.volume_change, -.1);
}

TEST(SolidRepairs, AreReportedByValidateAndByTheDryRun) {
  const TemporaryDirectory directory;
  auto divided = with_face_centres(cube());
  for (auto& p : divided.points) p *= 2;
  divided.points.emplace_back(0, 0, 0);
  write_text(directory / "divided.off", off(divided));
  auto manifest = swept({{"file", "divided.off"}});
  manifest["solids"]["unused"] = {{"vertices", dodecahedron(six_digits)}, {"merge", 1e-6}};
  write_text(directory / "m.json", manifest.dump());
  for (const auto& command : {std::vector<std::string>{"validate", "m.json"}, {"run", "m.json", "--dry-run"}}) {
    const auto done = test::isojam(command, directory.path());
    EXPECT_EQ(done.exit_code, 0) << done.err;
    std::printf("%s", done.out.c_str());
    expect_part(done.out, "mine: 6 faces, 12 edges, 8 vertices; volume 8 before scaling; vertices within ");
    expect_part(
        done.out,
        "smallest angle between the normals of adjacent faces 1.571 rad; 6 points omitted that are not corners");
    expect_part(done.out, "not used: 1 vertex that belongs to no face");
    expect_part(done.out, "unused: 12 faces, 30 edges, 20 vertices; volume 14.4721");
    expect_part(done.out, "faces joined to larger faces; largest move of a corner ");
  }
}

}  // namespace
}  // namespace isojam
