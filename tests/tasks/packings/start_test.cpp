#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "engine/packing/energy.hpp"
#include "tasks/extras/export/formats.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/manifest/warnings.hpp"
#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/gsd_layer.hpp"
#include "tasks/packings/similarity.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Mixture shapes_and_sizes() {
  return {{{SolidKind::cube, .5, {.from = 1.3}},
           {SolidKind::tetrahedron, .25},
           {*Solid::named("truncated_tetrahedron"), .25, {.law = SizeLaw::uniform, .from = .8, .to = 1.2}}},
          "three"};
}

Packing sample(const Mixture& mixture, int n = 120) {
  RandomStream random{91};
  return random_packing(mixture.particles(n), .4, random);
}

/// The description of a solid in another program: y = unit·(shift + turn·x), with the vertices in reverse order.
struct Frame {
  double unit = 3.7;
  Quaterniond turn = Quaterniond(.3, -.5, .7, .2).normalized();
  Vector3d shift = Vector3d(.4, -.1, .2);
};

GsdChunk chunk(const std::string& name, const std::vector<double>& values, std::uint32_t columns) {
  const std::vector<float> narrow(values.begin(), values.end());
  return gsd_chunk(name, std::span<const float>(narrow), columns);
}

/// The packing in a GSD file as a user of that program would have it.
std::string foreign_gsd(const Packing& packing, const Frame& frame) {
  std::vector<std::string> names, shapes;
  std::vector<const ConvexSolid*> types;
  std::vector<std::uint32_t> of;
  std::vector<double> positions, orientations;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const ConvexSolid* solid = &packing.solids[i];
    auto found = std::find(types.begin(), types.end(), solid);
    if (found == types.end()) {
      Json shape{{"type", "ConvexPolyhedron"}};
      const std::vector<Vector3d> backwards(solid->vertices().rbegin(), solid->vertices().rend());
      for (const Vector3d& v : backwards) {
        const Vector3d y = frame.unit * (frame.shift + frame.turn * v);
        shape["vertices"].push_back({y[0], y[1], y[2]});
      }
      names.push_back(fmt::format("T{}", types.size()));
      shapes.push_back(shape.dump());
      found = types.insert(types.end(), solid);
    }
    of.push_back(static_cast<std::uint32_t>(found - types.begin()));
    // x + q x₀ = x' + q' y₀, where y₀ = unit·(shift + turn·x₀)
    const Quaterniond q = packing.poses[i].orientation * frame.turn.conjugate();
    const Vector3d x = frame.unit * (packing.poses[i].position - q * frame.shift);
    positions.insert(positions.end(), x.begin(), x.end());
    for (const double c : {q.w(), q.x(), q.y(), q.z()}) orientations.push_back(c);
  }
  const double side = frame.unit * packing.cell.side();
  const std::vector<std::uint32_t> number{static_cast<std::uint32_t>(packing.size())};
  const std::vector<std::vector<GsdChunk>> frames{
      {chunk("configuration/box", {side, side, side, 0, 0, 0}, 1),
       gsd_chunk("particles/N", std::span<const std::uint32_t>(number)),
       gsd_chunk("particles/types", std::span<const std::string>(names)),
       gsd_chunk("particles/type_shapes", std::span<const std::string>(shapes)),
       gsd_chunk("particles/typeid", std::span<const std::uint32_t>(of)), chunk("particles/position", positions, 3),
       chunk("particles/orientation", orientations, 4)}};
  return gsd_bytes({"elsewhere", "hoomd", 1, 4}, frames);
}

/// Largest distance between corners of the same particles, apart from periodic images.
double farthest_corner(const Packing& a, const Packing& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const Vector3d d = a.cell.nearest_image(b.poses[i].position - a.poses[i].position);
    for (const Vector3d& v : a.solids[i].vertices()) {
      const Vector3d corner = a.poses[i].orientation * v;
      double least = 1e300;
      for (const Vector3d& w : b.solids[i].vertices())
        least = std::min(least, (d + b.poses[i].orientation * w - corner).norm());
      worst = std::max(worst, least);
    }
  }
  return worst;
}

TEST(ForeignPackings, OfGsdAreTheIntendedOnes) {
  for (const Mixture& mixture : {Mixture(SolidKind::tetrahedron), Mixture(SolidKind::cube), shapes_and_sizes()}) {
    const Packing packing = sample(mixture);
    const Packing again = packing_of(read_gsd_packing(foreign_gsd(packing, {}), -1), mixture);
    ASSERT_EQ(again.size(), packing.size());
    EXPECT_TRUE(again.cell.is_cube());
    EXPECT_NEAR(again.density(), packing.density(), 1e-6);
    for (std::size_t i = 0; i < packing.poses.size(); ++i)
      EXPECT_TRUE(&again.solids.unit(i) == &packing.solids.unit(i) &&
                  again.solids[i].scale() == packing.solids[i].scale());
    EXPECT_LT(farthest_corner(packing, again), 1e-5) << mixture.name();
    const double energy = PackingEnergy().evaluate(packing).energy;
    EXPECT_NEAR(PackingEnergy().evaluate(again).energy, energy, 1e-4 * energy) << mixture.name();
  }
}

TEST(ForeignPackings, OfXyzAreTheIntendedOnes) {
  for (const Mixture& mixture : {Mixture(SolidKind::octahedron), shapes_and_sizes()}) {
    const Packing packing = sample(mixture);
    const std::vector<ExportFrame> frames{make_frame(packing, std::nullopt), make_frame(packing, std::nullopt)};
    const auto text = xyz_file(frames);
    for (const int frame : {0, 1, -1}) {
      const Packing again = packing_of(read_xyz_packing(text, frame), mixture);
      EXPECT_LT(farthest_corner(packing, again), 1e-12) << mixture.name();
    }
    EXPECT_THROW(read_xyz_packing(text, 2), ContentError);
    // isojam's own GSD file, in single precision.
    EXPECT_LT(farthest_corner(packing, packing_of(read_gsd_packing(gsd_file(frames), 1), mixture)), 1e-5);
  }
}

TEST(ForeignPackings, HaveTheIntendedCell) {
  DoubleDoubleMatrix f;
  f.high(0, 0) = 1.2, f.high(1, 1) = .9;
  f.high(0, 1) = .2, f.high(0, 2) = -.15, f.high(1, 2) = .1;
  const Packing packing = deformed(sample(SolidKind::cube), f);
  const std::vector<ExportFrame> frames{make_frame(packing, std::nullopt)};
  for (const auto& foreign : {read_gsd_packing(gsd_file(frames), 0), read_xyz_packing(xyz_file(frames), 0)}) {
    const Packing again = packing_of(foreign, SolidKind::cube);
    const Eigen::Matrix3d there = packing.cell.vectors().high, back = again.cell.vectors().high;
    EXPECT_LT((back - there).norm(), 1e-6 * there.norm()) << there << "\n" << back;
    EXPECT_LT(farthest_corner(packing, again), 1e-5);
  }
}

TEST(ForeignPackings, InvalidFilesAreRejected) {
  const Packing packing = sample(SolidKind::cube);
  const auto whole = foreign_gsd(packing, {});
  RandomStream random{92};
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    auto bytes = whole;
    if (trial % 2 == 0) bytes.resize(static_cast<std::size_t>(static_cast<double>(bytes.size()) * random.uniform()));
    for (int k = 0; k < 3 && !bytes.empty(); ++k)
      bytes[static_cast<std::size_t>(static_cast<double>(bytes.size()) * random.uniform())] =
          static_cast<char>(256 * random.uniform());
    try {
      packing_of(read_gsd_packing(bytes, -1), SolidKind::cube);
    } catch (const ContentError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 150) << "those that were cut, at least";
  EXPECT_THROW(packing_of(read_gsd_packing(whole, -1), SolidKind::octahedron), ContentError);
  // An overflow is reported and the value is not used.
  auto far = read_gsd_packing(whole, -1), huge = far;
  far.bodies[3].position[1] = 3e38;
  EXPECT_THROW(packing_of(far, SolidKind::cube), ContentError);
  for (auto& vertex : huge.types[0].vertices) vertex *= 1e140;
  EXPECT_THROW(packing_of(huge, SolidKind::cube), ContentError);
  EXPECT_THROW(read_gsd_packing(whole, 1), ContentError);
  EXPECT_THROW(read_xyz_packing("", -1), ContentError);
  EXPECT_THROW(read_xyz_packing("2\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=species:S:1:pos:R:3\ncube 0 0 0\n", -1),
               ContentError);
  // A mirrored solid is another solid.
  const std::vector<Vector3d> chiral{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {.9, 1.1, 1.6}};
  std::vector<Vector3d> mirrored;
  for (const Vector3d& v : chiral) mirrored.emplace_back(-v[0], v[1], v[2]);
  const auto solid = Solid::made_of("chiral", chiral);
  EXPECT_TRUE(similarity(*solid, chiral).has_value());
  EXPECT_FALSE(similarity(*solid, mirrored).has_value());
}

Json started(const Json& start, int particles) {
  auto manifest = test::tiny_manifest();
  manifest["name"] = "started";
  manifest["sweep"] = {{"solid", {"octahedron"}}, {"particles", {particles}}};
  manifest["replicates"] = 1;
  manifest["start"] = start;
  return manifest;
}

TEST(Starts, ContinueFromStoredStates) {
  const test::TemporaryDirectory directory;
  auto first = started(nullptr, 48);
  first.erase("start");
  first["protocol"] = {{"final_distance", .02}};
  test::write_text(directory / "first.json", first.dump());
  ASSERT_EQ(test::isojam({"run", "first.json", "-o", "r"}, directory.path()).exit_code, 0);
  const std::string stored = "r/packings/octahedron-N48-r0000.json";
  auto second = started({{"packing", stored}, {"stage", "decompression"}}, 48);
  second["protocol"] = {{"final_distance", .008}};
  test::write_text(directory / "second.json", second.dump());
  EXPECT_EQ(test::violations("manifest", second), "");
  const auto run = test::isojam({"run", "second.json", "-o", "s"}, directory.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = [&](const std::string& where) {
    return Json::parse(read_file(directory / where / "records" / "octahedron-N48-r0000.json"));
  };
  const auto before = record("r"), after = record("s");
  EXPECT_EQ(test::violations("record", after), "");
  EXPECT_LT(test::nearest_of(after).at("delta_phi").get<double>(), .0081);
  EXPECT_EQ(after.at("path").at(0).at("stage"), "decompression");
  EXPECT_EQ(after.at("path").at(0).at("density"), test::nearest_of(before).at("density")) << "to the last bit";
  EXPECT_NEAR(after.at("phi_j").at("phi_j").get<double>(), before.at("phi_j").at("phi_j").get<double>(), .005);
  EXPECT_TRUE(after.at("provenance").at("start").get<std::string>().ends_with(stored));
  EXPECT_FALSE(before.at("provenance").contains("start"));
  // The copy in the results directory is sufficient to repeat it. A file that has changed is reported.
  EXPECT_EQ(test::isojam({"rerun", "s", "octahedron-N48-r0000"}, directory.path()).exit_code, 0);
  EXPECT_EQ(test::isojam({"aggregate", "s"}, directory.path()).exit_code, 0);
  auto packing = Json::parse(read_file(directory / stored));
  std::filesystem::rename(directory / stored, directory / "gone.json");
  EXPECT_EQ(test::isojam({"aggregate", "s"}, directory.path()).exit_code, 0) << "needs the records alone";
  EXPECT_EQ(test::isojam({"rerun", "s", "octahedron-N48-r0000"}, directory.path()).exit_code, 65);
}

/// Octahedra on a lattice that do not touch.
Packing octahedra_apart() {
  Packing packing = strained_to(sample(SolidKind::octahedron, 64), .2);
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3i place(i % 4, i / 4 % 4, i / 16);
    packing.poses[i].position = packing.cell.side() / 4 * place.cast<double>();
  }
  return packing;
}

TEST(Starts, AlignedParticlesGiveAWarning) {
  const test::TemporaryDirectory directory;
  Packing packing = octahedra_apart();
  for (const bool aligned : {false, true}) {
    for (Pose& pose : packing.poses) {
      if (aligned) pose.orientation.setIdentity();
    }
    test::write_text(directory / "a.xyz", xyz_file(std::vector{make_frame(packing, std::nullopt)}));
    const auto manifest = started({{"packing", "a.xyz"}}, 64).dump();
    std::string all;
    for (const auto& warning : warnings_of(parse_manifest(manifest, (directory / "m.json").string()))) all += warning;
    EXPECT_EQ(all.find("the packing is ordered: its orientational order S is 1.00") != std::string::npos, aligned)
        << all;
  }
}

TEST(Starts, InvalidStartsAreRejectedAtTheirPlace) {
  const test::TemporaryDirectory directory;
  const Packing packing = octahedra_apart();
  const std::vector<ExportFrame> frames{make_frame(packing, std::nullopt)};
  test::write_text(directory / "a.gsd", gsd_file(frames));
  test::write_text(directory / "a.xyz", xyz_file(frames));
  Packing deep = packing;
  deep.poses[1].position = deep.poses[0].position;
  test::write_text(directory / "deep.xyz", xyz_file(std::vector{make_frame(deep, std::nullopt)}));
  const auto said = [&](const Json& manifest) { return test::refusal(manifest, (directory / "m.json").string()); };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "wanted: " << part << "\nsaid: " << text;
  };
  EXPECT_EQ(said(started({{"packing", "a.gsd"}, {"density", .25}}, 64)), "");
  expect(said(started({{"packing", "deep.xyz"}}, 64)), "particles 0 and 1 overlap by");
  expect(said(started({{"packing", "none.gsd"}}, 64)), "/start/packing");
  expect(said(started({{"packing", "a.xyz"}}, 65)),
         "the packing has 64 particles instead of 65; set /sweep/particles to [64]");
  expect(said(started({{"packing", {"a.xyz", "m.json"}}}, 64)), "/start/packing/1");
  expect(said(started({{"packing", "a.xyz"}, {"density", .97}}, 64)), "max_density");
  expect(said(started({{"packing", "a.xyz"}, {"stage", "later"}}, 64)), "/start/stage");
  auto many = started({{"packing", "a.xyz"}}, 64);
  many["replicates"] = 2;
  expect(said(many), "too few files (1) for 2 replicates");
  for (const std::string file : {"a.gsd", "a.xyz"})
    expect(said(started({{"packing", file}, {"frame", 3}}, 64)),
           file + ": the file has 1 frame, but /start/frame is 3; set it to 0");
  test::write_text(directory / "hello.gsd", "hello\n");
  expect(
      said(started({{"packing", "hello.gsd"}}, 64)),
      "hello.gsd:1: \"hello\" does not begin a packing in GSD, extended XYZ or the JSON of isojam; save the packing");
  test::write_text(directory / "own.json", "{\"schema\": \"x\", \"checksum\": \"0123456789abcdef\"}");
  const auto own = said(started({{"packing", "own.json"}}, 64));
  expect(own,
         "own.json: /checksum: the file is damaged: its content does not match its checksum; write the file again, "
         "or use another file");
  EXPECT_EQ(own.find("own.json"), own.rfind("own.json")) << own;
  ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
  for (const std::string path : {"pipe", "/dev/zero"})
    expect(said(started({{"packing", path}}, 64)), "is a pipe or a device, not a file");
  many = started({{"packing", "a.xyz"}}, 64);
  many["sweep"]["solid"] = {"octahedron", "cube"};
  expect(said(many), "one entry in /sweep/solid");
  many["sweep"]["solid"] = {"cube"};
  many["replicates"] = 1;
  expect(said(many), "particles of type \"octahedron\" do not match cube");
}

}  // namespace
}  // namespace isojam
