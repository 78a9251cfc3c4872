// tests/polyhedra/packings_test.py has about 110 more files.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/warnings.hpp"
#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/gsd_layer.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr int count = 64;
constexpr double side = 7.4;

/// A random orientation, written w x y z.
std::array<double, 4> orientation(int particle, bool aligned) {
  if (aligned) return {1, 0, 0, 0};
  RandomStream random{static_cast<std::uint64_t>(particle) + 17};
  std::array<double, 4> q{};
  double squared = 0;
  for (double& x : q) x = random.uniform() - .5, squared += x * x;
  for (double& x : q) x /= std::sqrt(squared);
  return q;
}

Vector3d place_of(int particle, double spacing = side / 4) {
  return spacing *
         (Eigen::Vector3i(particle % 4, particle / 4 % 4, particle / 16).cast<double>() - Vector3d::Constant(1.5));
}

/// A GSD file of octahedra with changes.
struct Gsd {
  std::array<float, 6> box{7.4F, 7.4F, 7.4F, 0, 0, 0};
  std::vector<std::string> types{"A"}, shapes{};
  std::vector<std::uint32_t> type_of = std::vector<std::uint32_t>(count, 0);
  double spacing = side / 4;
  float bad_position = 0, bad_orientation = 0;
  bool aligned = false;
};

std::string bytes_of(const Gsd& gsd) {
  std::vector<float> positions, orientations;
  const auto particles = static_cast<int>(gsd.type_of.size());
  for (int i = 0; i < particles; ++i) {
    for (const double x : place_of(i % count, gsd.spacing)) positions.push_back(static_cast<float>(x));
    for (const double x : orientation(i, gsd.aligned)) orientations.push_back(static_cast<float>(x));
  }
  positions[7] += gsd.bad_position;
  orientations[7] += gsd.bad_orientation;
  const std::vector<std::uint32_t> number{static_cast<std::uint32_t>(particles)};
  const std::vector<std::uint32_t> dimensions{3};
  std::vector<GsdChunk> chunks{gsd_chunk("configuration/box", std::span<const float>(gsd.box), 1),
                               gsd_chunk("configuration/dimensions", std::span<const std::uint32_t>(dimensions)),
                               gsd_chunk("particles/N", std::span<const std::uint32_t>(number)),
                               gsd_chunk("particles/types", std::span<const std::string>(gsd.types)),
                               gsd_chunk("particles/typeid", std::span<const std::uint32_t>(gsd.type_of)),
                               gsd_chunk("particles/position", std::span<const float>(positions), 3),
                               gsd_chunk("particles/orientation", std::span<const float>(orientations), 4)};
  if (!gsd.shapes.empty())
    chunks.push_back(gsd_chunk("particles/type_shapes", std::span<const std::string>(gsd.shapes)));
  return gsd_bytes({"elsewhere", "hoomd", 1, 4}, std::vector<std::vector<GsdChunk>>{chunks});
}

std::string polyhedron(const std::vector<Vector3d>& vertices, const Json& more = Json::object()) {
  Json shape{{"type", "ConvexPolyhedron"}, {"vertices", Json::array()}};
  for (const auto& v : vertices) shape["vertices"].push_back({v[0], v[1], v[2]});
  shape.update(more);
  return shape.dump();
}

const std::vector<Vector3d> octahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const std::vector<Vector3d> cube{{1, 1, 1},  {-1, 1, 1},  {1, -1, 1},  {-1, -1, 1},
                                 {1, 1, -1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, -1}};

Json started(const Json& start, const std::string& solid = "octahedron") {
  auto manifest = test::tiny_manifest();
  manifest["sweep"] = {{"solid", {solid}}, {"particles", {count}}};
  manifest["replicates"] = 1;
  manifest["start"] = start;
  return manifest;
}

struct Said {
  std::string error;
  std::vector<std::string> warnings;
  std::optional<Manifest> manifest;
};

/// The outcome of a start from a file with these bytes.
Said said(const std::string& bytes, const Json& more = Json::object(), const std::string& solid = "octahedron") {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "start", bytes);
  Json start{{"packing", "start"}};
  start.update(more);
  Said result;
  try {
    result.manifest = parse_manifest(started(start, solid).dump(), (directory / "m.json").string());
    result.warnings = warnings_of(*result.manifest);
    std::erase_if(result.warnings, [](const std::string& text) { return !text.starts_with("/start/"); });
  } catch (const InputError& error) {
    result.error = error.what();
  }
  return result;
}

void expect_part(const std::string& text, const std::string& part, const std::string& name) {
  EXPECT_NE(text.find(part), std::string::npos) << name << ": \"" << part << "\" is not in \"" << text << "\"";
}

TEST(StartFiles, GsdTypesWithoutShapesHaveTheNamesInTypes) {
  expect_part(said(bytes_of({})).error, R"(for example {"A": "octahedron"})", "without types");
  for (const auto& none : std::vector<std::vector<std::string>>{{}, {"{}"}, {""}, {"null"}}) {
    const auto got = said(bytes_of({.shapes = none}), {{"types", {{"A", "octahedron"}}}});
    EXPECT_EQ(got.error, "");
    ASSERT_TRUE(got.manifest);
    EXPECT_EQ(to_json(*got.manifest).at("start").at("types"), Json({{"A", "octahedron"}}));
    EXPECT_EQ(got.manifest->start->files[0].packing->solids.only().name(), "octahedron");
    EXPECT_EQ(said(bytes_of({.types = {"octahedron"}, .shapes = none})).error, "") << "by the name of the type";
  }
  expect_part(said(bytes_of({}), {{"types", {{"B", "octahedron"}}}}).error, "no type \"B\"", "unknown type");
  expect_part(said(bytes_of({}), {{"types", {{"A", "cube"}}}}).error, "do not match octahedron", "another solid");
  expect_part(said(bytes_of({.shapes = {polyhedron(octahedron)}}), {{"types", {{"A", "octahedron"}}}}).error,
              "remove the type from /start/types", "shape and name");
}

TEST(StartFiles, GsdShapesOfOtherKindsAreRefused) {
  // The name of the type is the name of the solid, which must not decide.
  for (const std::string shape :
       {R"({"type": "Sphere", "diameter": 1})", R"({"type": "Ellipsoid", "a": 1, "b": 1, "c": 2})",
        R"({"type": "Polygon", "rounding_radius": 0, "vertices": [[-1, 0], [1, 0], [0, 1]]})",
        R"({"type": "Mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "indices": [[0, 1, 2]]})",
        R"({"type": "SphereUnion", "centers": [[0, 0, 0]], "diameters": [1]})", R"({"diameter": 1})", "[]", "Sphere",
        R"({"type": "ConvexPolyhedron"})", R"({"type": "ConvexPolyhedron", "vertices": [[NaN, 0, 0]]})",
        R"({"type": "ConvexPolyhedron", "vertices": [[1e999, 0, 0]]})"}) {
    const auto error = said(bytes_of({.types = {"octahedron"}, .shapes = {shape}})).error;
    expect_part(error, "type \"octahedron\" has a shape", shape);
    expect_part(error, "particles/type_shapes", shape);
  }
  expect_part(
      said(bytes_of({.types = {"octahedron"}, .shapes = {polyhedron(octahedron, {{"rounding_radius", .1}})}})).error,
      "rounded", "rounding radius");
  EXPECT_EQ(said(bytes_of({.shapes = {polyhedron(octahedron)}})).error, "");
  // A type without particles may have any shape.
  EXPECT_EQ(said(bytes_of({.types = {"octahedron", "B"}, .shapes = {"{}", R"({"type": "Sphere"})"}})).error, "");
}

TEST(StartFiles, PointsOfAShapeThatAreNoCornersAreReported) {
  auto points = octahedron;
  points.emplace_back(.1, 0, 0);
  const auto got = said(bytes_of({.shapes = {polyhedron(points)}}));
  ASSERT_EQ(got.error, "");
  ASSERT_EQ(got.warnings.size(), 1U);
  expect_part(got.warnings[0], "a vertex that is no corner of its convex hull", "one point");
  EXPECT_TRUE(said(bytes_of({.shapes = {polyhedron(octahedron)}})).warnings.empty());
  points.emplace_back(0, 0, 1.5);
  expect_part(said(bytes_of({.shapes = {polyhedron(points)}})).error, "do not match", "another solid");
}

TEST(StartFiles, EveryNumberOfGsdMustBeFinite) {
  constexpr auto nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  const Gsd good{.types = {"octahedron"}};
  EXPECT_EQ(said(bytes_of(good)).error, "");
  for (const float bad : {nan, infinite, -infinite}) {
    for (std::size_t k = 0; k < 6; ++k) {
      auto gsd = good;
      gsd.box[k] = bad;
      expect_part(said(bytes_of(gsd)).error, fmt::format("row {} of its chunk configuration/box", k), "box");
    }
    auto gsd = good;
    gsd.bad_position = bad;
    expect_part(said(bytes_of(gsd)).error, "row 2 of its chunk particles/position", "position");
    gsd.bad_position = 0, gsd.bad_orientation = bad;
    expect_part(said(bytes_of(gsd)).error, "row 1 of its chunk particles/orientation", "orientation");
  }
}

TEST(StartFiles, VeryLowDensitiesAreRefused) {
  Gsd gsd{.box = {1e30F, 1e30F, 1e30F, 0, 0, 0}, .types = {"octahedron"}};
  const auto error = said(bytes_of(gsd)).error;
  expect_part(error, "the initial density", "box of 1e30");
  expect_part(error, "/start/density", "box of 1e30");
  // The remedy does not hide that the particles are in one place of this box.
  expect_part(said(bytes_of(gsd), {{"density", .05}}).error, "overlap by", "box of 1e30 with a density");
  gsd.box = {20, 20, 20, 0, 0, 0}, gsd.spacing = 5;
  expect_part(said(bytes_of(gsd)).error, "below 0.035", "density 0.008");
  EXPECT_EQ(said(bytes_of(gsd), {{"density", .05}}).error, "");
  gsd.box = {12, 12, 12, 0, 0, 0}, gsd.spacing = 3;
  EXPECT_EQ(said(bytes_of(gsd)).error, "") << "density 0.037";
}

TEST(StartFiles, AlignedParticlesGiveAWarning) {
  const Gsd lattice{.box = {4.12F, 4.12F, 4.12F, 0, 0, 0}, .types = {"cube"}, .spacing = 1.03, .aligned = true};
  const auto got = said(bytes_of(lattice), Json::object(), "cube");
  ASSERT_EQ(got.error, "");
  ASSERT_EQ(got.warnings.size(), 1U);
  expect_part(got.warnings[0], "the packing is ordered: its orientational order S is 1.00", "lattice");
  auto loose = lattice;
  loose.box = {6, 6, 6, 0, 0, 0}, loose.spacing = 1.5;
  ASSERT_EQ(said(bytes_of(loose), Json::object(), "cube").warnings.size(), 1U);
  loose.aligned = false;
  EXPECT_TRUE(said(bytes_of(loose), Json::object(), "cube").warnings.empty());
}

TEST(StartFiles, TypesArePairedWithParticlesOnce) {
  Gsd gsd{.types = std::vector<std::string>(300000, "octahedron")};
  expect_part(said(bytes_of(gsd)).error, "300000 types for 64 particles", "types");
  // As many types as particles, each with its own shape: a search of all particles for each type would visit 4e8 pairs.
  ForeignPacking foreign;
  foreign.cell = 100 * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 20000; ++i) {
    foreign.types.push_back({fmt::format("T{}", i), i % 2 ? cube : std::vector<Vector3d>{}, {}});
    const int layer = i / 729;
    foreign.bodies.push_back(
        {2 * (i / 2) + 1, 1, Vector3d(i % 27, i / 27 % 27, layer) * 3, Eigen::Quaterniond::Identity()});
  }
  EXPECT_EQ(packing_of(foreign, SolidKind::cube).size(), 20000);
}

TEST(StartFiles, PipesDevicesAndDirectoriesAreRefused) {
  const test::TemporaryDirectory directory;
  ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(directory / "folder");
  for (const std::string path : {"pipe", "folder", "/dev/zero", "/dev/null", "missing"}) {
    auto solids = test::tiny_manifest();
    solids["solids"] = {{"mine", {{"file", path}}}};
    solids["sweep"]["solid"] = {"mine"};
    for (const auto& [manifest, pointer] : {std::pair(started({{"packing", path}}), std::string("/start/packing")),
                                            std::pair(solids, std::string("/solids/mine/file"))}) {
      try {
        parse_manifest(manifest.dump(), (directory / "m.json").string());
        ADD_FAILURE() << path << " was read";
      } catch (const InputError& error) {
        expect_part(error.what(), pointer + ": ", path);
        expect_part(error.what(),
                    path == "folder"    ? "is a directory, not a file"
                    : path == "missing" ? "No such file"
                                        : "is a pipe or a device, not a file",
                    path);
      }
    }
  }
}

}  // namespace
}  // namespace isojam
