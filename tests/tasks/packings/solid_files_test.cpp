// tests/polyhedra/corpus_test.py has about 300 more files.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/geometry/hull.hpp"
#include "tasks/packings/content_error.hpp"
#include "tasks/packings/intake.hpp"
#include "tests/tasks/packings/meshes.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using namespace test;

struct Outcome {
  std::string text, remedy;
  std::size_t line = 0;
  std::array<std::size_t, 3> features{};  ///< numbers of faces, edges and vertices
  Intake intake;
};

Outcome outcome(const std::string& bytes, const RepairOptions& options = {}) {
  Outcome result;
  try {
    result.intake = solid_in(read_mesh(bytes), options);
    const ConvexSolid solid("x", result.intake.vertices);
    result.features = {solid.faces().size(), solid.edges().size(), solid.vertices().size()};
  } catch (const ContentError& error) {
    result.text = error.what(), result.remedy = error.remedy(), result.line = error.line();
  } catch (const NoSolid& error) {
    result.text = error.what();
  }
  return result;
}

using Features = std::array<std::size_t, 3>;
constexpr Features of_tetrahedron{4, 6, 4};

TEST(SolidFileFormats, PartsThatAreNotUsedAreNoted) {
  auto unused = cube();
  unused.points.emplace_back(9, 9, 9);
  EXPECT_EQ(outcome(off(with_face_centres(cube()))).intake.report.dropped, 6);
  EXPECT_EQ(outcome(off(unused)).intake.notes, std::vector<std::string>{"1 vertex that belongs to no face"});
  EXPECT_EQ(outcome(binary_stl(triangles(cube())) + "\r\n").intake.notes,
            std::vector<std::string>{"2 bytes after the last triangle"});
}

/// The value of `merge` in a remedy; 0 if there is none.
double proposed(const std::string& remedy) {
  const std::string key = "\"merge\" to ";
  const auto at = remedy.find(key);
  return at == std::string::npos ? 0 : std::stod(remedy.substr(at + key.size()));
}

TEST(SolidFileRepairs, WeldCornersThatNearlyCoincide) {
  const auto corners = jittered(triangles(tetrahedron()));
  for (const auto& bytes : {text_stl(corners), binary_stl(corners)}) {
    const auto refused = outcome(bytes);
    EXPECT_NE(refused.text.find("not closed"), std::string::npos) << refused.text;
    const double merge = proposed(refused.remedy);
    EXPECT_GT(merge, 1e-7) << refused.remedy;
    EXPECT_LT(merge, 1e-5) << refused.remedy;
    const auto welded = outcome(bytes, {.merge = merge});
    EXPECT_EQ(welded.text, "");
    EXPECT_EQ(welded.features, of_tetrahedron);
    EXPECT_EQ(welded.intake.report.welded + welded.intake.report.dropped, 8);
    EXPECT_NE(outcome(bytes, {.merge = merge / 100}).text, "") << "a smaller value does not weld them";
  }
}

TEST(SolidFileLimits, AreCheckedBeforeTheWork) {
  // Whatever follows the numbers would be refused at its own line if it were read.
  const auto many = outcome("OFF\n10000000 100000 0\nthis is not read\n");
  EXPECT_EQ(many.line, 2U);
  EXPECT_NE(many.text.find("number of vertices is 10000000"), std::string::npos) << many.text;
  // The search for the diameter visits all pairs of different points, so that their number has its own limit.
  Sample strip;
  for (int k = 0; k < 12002; ++k) strip.points.emplace_back(k, k % 2, 0);
  for (int k = 0; k < 12000; ++k) strip.faces.push_back({k, k + 1, k + 2});
  EXPECT_NE(outcome(off(strip)).text.find("more than 12000 different points"), std::string::npos);
}

}  // namespace
}  // namespace isojam
