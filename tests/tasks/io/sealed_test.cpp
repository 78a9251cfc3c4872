#include "tasks/io/sealed.hpp"

#include <gtest/gtest.h>

#include "tasks/io/input_error.hpp"
#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace {

Json document() {
  Json json;
  json["schema"] = "made.up.v1";
  json["list"] = {1.5, 2e-300, -0.1};
  json["nested"] = {{"text", "a \"quoted\" checksum"}, {"null", nullptr}};
  return json;
}

bool passes(const std::string& text) {
  try {
    parse_sealed(text, "file");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(SealedJson, GivesTheDocumentBack) {
  auto read = parse_sealed(sealed(document()), "file");
  EXPECT_EQ(read.at("checksum").get<std::string>().size(), 16u);
  read.erase("checksum");
  EXPECT_EQ(read, document());
  EXPECT_EQ(sealed(read), sealed(document()));
}

TEST(SealedJson, RejectsEveryChangedByteAndEveryCut) {
  const auto whole = sealed(document());
  ASSERT_TRUE(passes(whole));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int bit : {1, 32, 128}) {
      auto changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ bit);
      EXPECT_FALSE(passes(changed)) << "byte " << i << ", bit " << bit;
    }
    EXPECT_FALSE(passes(whole.substr(0, i))) << "cut after " << i;
    EXPECT_FALSE(passes(whole.substr(0, i) + whole.substr(i + 1))) << "without byte " << i;
    EXPECT_FALSE(passes(whole.substr(0, i) + " " + whole.substr(i))) << "a blank before byte " << i;
  }
  EXPECT_FALSE(passes(pretty(document()))) << "never sealed";
  EXPECT_FALSE(passes(""));
}

Packing made_up_packing() {
  RandomStream random{11, 5};
  auto packing = random_packing(platonic(SolidKind::tetrahedron), 70, 0.3, random);
  for (auto& pose : packing.poses) {
    for (int c = 0; c < 3; ++c) pose.position_low[c] = 1e-18 * random.normal();
    for (int c = 0; c < 4; ++c) pose.orientation_low[c] = 1e-18 * random.normal();
  }
  packing.poses[0].position[0] = -3 * packing.cell.side();
  packing.poses[1].position_low[2] = -0.0;
  return packing;
}

/// A packing in a cell whose shape has relaxed, and a packing in a cube whose side has a low part.
std::vector<Packing> in_other_cells() {
  DoubleDoubleMatrix skew, stretch;
  skew.high << 1.02, .07, -.03, .01, .98, .05, 0, -.02, 1.01;
  skew.low(1, 2) = 3e-19;
  stretch.high *= 1.01;
  stretch.low.diagonal().setConstant(1e-17);
  return {deformed(made_up_packing(), skew), deformed(made_up_packing(), stretch)};
}

void expect_survival(const Packing& packing) {
  const auto text = sealed({{"schema", "made.up.v1"}, {"packing", to_json(packing)}});
  const auto read = parse_sealed(text, "file");
  const auto again = read_packing(JsonPlace(read, "file").at("packing"));
  EXPECT_TRUE(again.solids == packing.solids);
  EXPECT_TRUE(again.cell == packing.cell);
  EXPECT_EQ(again.cell.is_cube(), packing.cell.is_cube());
  ASSERT_EQ(again.size(), packing.size());
  for (int i = 0; i < packing.size(); ++i)
    EXPECT_TRUE(again.poses[static_cast<std::size_t>(i)] == packing.poses[static_cast<std::size_t>(i)]) << i;
}

TEST(PackingJson, IsReadWithTheSameBits) {
  expect_survival(made_up_packing());
  for (const auto& packing : in_other_cells()) expect_survival(packing);
}

/// Checks the place of each error. It is the wrong value, or the whole cell, which is checked as one.
void expect_refusals(const Json& good, const std::vector<std::pair<std::string, Json>>& wrong) {
  for (const auto& [pointer, value] : wrong) {
    auto bad = good;
    bad[Json::json_pointer(pointer)] = value;
    try {
      read_packing(JsonPlace(bad, "file"));
      FAIL() << pointer << ": " << value;
    } catch (const InputError& error) {
      const auto& said = error.details().pointer;
      EXPECT_TRUE(pointer.starts_with(said) || said.starts_with(pointer)) << pointer << ": " << error.what();
    }
  }
}

TEST(PackingJson, RejectsInvalidPackings) {
  const auto good = to_json(made_up_packing());
  const std::vector<std::pair<std::string, Json>> wrong{{"/solid", "sphere"},         {"/side", 0.5},
                                                        {"/side", nullptr},           {"/positions", Json::array()},
                                                        {"/positions_low/3", 7},      {"/positions/3/1", "x"},
                                                        {"/positions/3", {1, 2}},     {"/orientations/0", {1, 0, 0}},
                                                        {"/orientations", {{1}}},     {"/orientations/5", {0, 0, 0, 0}},
                                                        {"/orientations_low", "none"}};
  expect_refusals(good, wrong);
}

}  // namespace
}  // namespace isojam
