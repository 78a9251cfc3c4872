#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam::test {
namespace {

using Pointer = Json::json_pointer;

std::string with(const std::string& pointer, const Json& value) {
  auto manifest = good_manifest();
  manifest[Pointer(pointer)] = value;
  return manifest.dump();
}

std::string without(const std::string& key) {
  auto manifest = good_manifest();
  manifest.erase(key);
  return manifest.dump();
}

/// Text of the valid manifest in which `from` is replaced by `to`.
std::string replaced(const std::string& from, const std::string& to) {
  auto text = good_manifest().dump();
  return text.replace(text.find(from), from.size(), to);
}

/// A manifest with a value that is not allowed at its place. A schema can detect this.
BadManifest set(const std::string& name, const std::string& at, const Json& value, const std::string& says,
                const std::string& pointer = "") {
  return {name, with(at, value), pointer.empty() ? at : pointer, says, true};
}

/// Invalid keys and values outside of the sweep; a schema rejects them.
std::vector<BadManifest> malformed() {
  return {
      set("unknown key", "/replicate", 4, "did you mean \"replicates\"?"),
      set("unknown key with odd letters", "/a~1b~0c", 4, "unknown key"),
      set("minimiser key in the protocol", "/protocol/method", "lbfgs", "did you mean \"/minimiser/method\"?"),
      set("renamed key", "/protocol/consolidation_step", 0.01, "did you mean \"compression_step\"?"),
      set("another, swept", "/sweep/consolidation_evaluations", {50}, "did you mean \"compression_evaluations\"?"),
      set("removed key", "/protocol/consolidation", "hasty",
          "the key was removed; use \"compression_evaluations\": 50"),
      set("another, swept", "/sweep/event_resolution", {0, 0.02}, "the key was removed; use a smaller"),
      set("another, of the minimiser", "/minimiser/history", 20, "the key was removed; delete it"),
      set("name leaves the directory", "/name", "../x", "letters, digits"),
      {"no name", without("name"), "/name", "missing", true},
      set("seed is beyond 2^64", "/seed", 1e30, "an integer from 0"),
      set("too many replicates", "/replicates", 1000001, "an integer from 1 to 1000000"),
      set("replicates as a text", "/replicates", "many",
          "\"many\" is not accepted; expected an integer from 1 to 1000000, or {"),
      {"a goal without a maximum", with("/replicates", {{"min", 2}, {"quantity", "Z"}, {"half_width", 1}}),
       "/replicates/max", "missing", true},
      {"a goal with a typing error", with("/replicates", {{"min", 2}, {"max", 4}, {"quantity", "Z"}, {"halfwidth", 1}}),
       "/replicates/halfwidth", "did you mean \"half_width\"?", true},
      {"a goal of one replicate", with("/replicates", {{"min", 1}, {"max", 4}, {"quantity", "Z"}, {"half_width", 1}}),
       "/replicates/min", "an integer from 2 to 1000000", true},
      {"a goal of no width", with("/replicates", {{"min", 2}, {"max", 4}, {"quantity", "Z"}, {"half_width", 0}}),
       "/replicates/half_width", "a number in (0", true},
      set("misspelt control", "/protocol/control", "preasure", "did you mean \"pressure\"?"),
      set("misspelt measure", "/measure", {"contact"}, "did you mean \"contacts\"?", "/measure/0"),
      set("measure given twice", "/measure", {"contacts", "contacts"}, "given twice", "/measure/1"),
      {"root is a list", "[1]", "", "an object with the keys", true},
  };
}

/// Bases with which no row can be compared.
std::vector<BadManifest> malformed_base() {
  return {
      set("misspelt parameter of the base", "/base/step_fracton", 0.35, "did you mean \"step_fraction\"?"),
      set("a removed key in the base", "/base/history", 20, "the key was removed; delete it"),
      set("a solid as the base", "/base/solid", "cube", "unknown key; expected one of \"initial_density\""),
      set("a base beyond the range", "/base/step_fraction", 1.5, "a number in (0, 1)"),
      set("a base of the wrong type", "/base/step_fraction", {0.35}, "a list is not accepted"),
      set("a base of an unknown method", "/base/method", "newtom", "did you mean \"newton\"?"),
      set("a base that names nothing", "/base", Json::object(), "one or more swept parameters"),
      set("a base that is a list", "/base", {"step_fraction"}, "an object with the keys"),
  };
}

/// Shears that a schema rejects.
std::vector<BadManifest> malformed_shear() {
  return {
      set("misspelt key of shear", "/shear", {{"stp", 0.1}}, "did you mean \"step\"?", "/shear/stp"),
      set("shear of no kind", "/shear", {{"mode", "torsion"}}, "\"pure\", \"simple\"", "/shear/mode"),
  };
}

/// Invalid settings of cohesion.
std::vector<BadManifest> wrong_cohesion() {
  const auto cohesive = [](const std::string& at, const Json& value) {
    auto manifest = good_manifest();
    manifest["protocol"]["cohesion"] = {{"strength", 1e-4}, {"until", "end"}};
    manifest[Pointer(at)] = value;
    return manifest.dump();
  };
  const Json hexagonal{{"solid", {"prism6"}}, {"particles", {200}}};
  const Json goal{{"min", 8}, {"max", 9}, {"quantity", "phi_j"}, {"half_width", 1}};
  return {
      set("misspelt key of cohesion", "/protocol/cohesion/strenght", 1e-4, "did you mean \"strength\"?"),
      set("cohesion until nothing", "/protocol/cohesion/until", "jamming", "\"decompression\", \"end\""),
      set("cohesion of one solid", "/protocol/by_solid", {{"dodecahedron", {{"cohesion", {{"strength", 1e-4}}}}}},
          "did you mean \"/protocol/cohesion\"?", "/protocol/by_solid/dodecahedron/cohesion"),
      set("swept key of cohesion without its object", "/sweep/strength", {1e-4}, "unknown key"),
      {"cohesion of solids that cannot grow", cohesive("/sweep", hexagonal), "/sweep/solid/0",
       "cohesion is not possible for prism6", false},
      {"cohesion before relaxation", cohesive("/protocol/target_before_relaxation", true),
       "/protocol/target_before_relaxation", "set target_before_relaxation to false", false},
      {"cohesion and modes", cohesive("/measure", {"contacts", "modes"}), "/measure/1",
       "the measure modes is not possible at zero pressure", false},
      {"cohesion and a goal of phi_j", cohesive("/replicates", goal), "/replicates/quantity", "use \"phi_0\"", false},
      {"cohesion in a small cell", cohesive("/protocol/cohesion/range", 0.9), "/sweep/particles/0",
       "with cohesion of range 0.9; use at least", false},
  };
}

/// Values in the sweep that a schema rejects.
std::vector<BadManifest> malformed_sweep() {
  return {
      set("misspelt sweep key", "/sweep/particle", Json{64}, "did you mean \"particles\"?"),
      {"unknown solid", with("/sweep/solid", {"octahedra"}), "/sweep/solid/0", "did you mean \"octahedron\"?", false},
      set("solid whose name is none", "/sweep/solid", {"8-hedron"}, "unknown solid", "/sweep/solid/0"),
      set("solid defined in no way", "/solids", {{"a", {{"ball", 1}}}}, "unknown key", "/solids/a/ball"),
      set("box without a height", "/solids", {{"a", {{"box", {1, 2}}}}}, "a list of 3", "/solids/a/box"),
      set("solid is a number", "/sweep/solid", {8}, "\"tetrahedron\", \"cube\"", "/sweep/solid/0"),
      set("solid is no list", "/sweep/solid", "cube", "a list"),
      set("no solid", "/sweep/solid", Json::array(), "the list is empty"),
      set("solid given twice", "/sweep/solid", {"cube", "cube"}, "given twice", "/sweep/solid/1"),
      set("particles given twice", "/sweep/particles", {64, 32, 64}, "given twice", "/sweep/particles/2"),
      set("no particles", "/sweep/particles", Json::array(), "the list is empty"),
      set("a fraction of a particle", "/sweep/particles", {64.5}, "an integer", "/sweep/particles/0"),
      set("swept value given twice", "/sweep/target_energy", {1e-5, 0.00001}, "twice", "/sweep/target_energy/1"),
      set("swept list is empty", "/sweep/method", Json::array(), "a list of 1 or more"),
      set("sweep is a list", "/sweep", Json::array(), "an object"),
  };
}

/// Manifests that violate conditions between several values.
std::vector<BadManifest> inconsistent() {
  auto crowded = good_manifest();
  crowded["sweep"]["max_density"] = {0.8, 2.0};
  crowded["sweep"]["particles"] = {64, 30};
  auto both = good_manifest();
  both["sweep"]["target_energy"] = {1e-5};
  both["protocol"]["target_energy"] = 1e-5;
  auto beside = good_manifest();
  beside["sweep"]["step_fraction"] = {0.35, 0.2};
  auto unswept = beside;
  beside["base"] = {{"step_fraction", 0.3}};
  unswept["base"] = {{"step_fraction", 0.35}, {"longest_step", 0.05}};
  auto many = good_manifest();
  many["replicates"] = 1000000;
  for (int n = 1; n <= 101; ++n) many["sweep"]["max_steps"].push_back(n);
  return {
      {"too few particles", with("/sweep/particles", {64, 5}), "/sweep/particles/1", "use at least", false},
      {"a shear that ends before its step", with("/shear", {{"step", 0.1}, {"until", 0.05}}), "/shear/until",
       "until 0.05 is less than step 0.1", false},
      {"too few at a swept density", crowded.dump(), "/sweep/particles/1", "max_density 2", false},
      {"swept and fixed", both.dump(), "/protocol/target_energy", "set it either here or in /sweep/target_energy",
       false},
      {"starts above its limit", with("/protocol/initial_density", 0.95), "/protocol/initial_density",
       "is not below max_density 0.93", false},
      {"fewer at most than at least",
       with("/replicates", {{"min", 5}, {"max", 4}, {"quantity", "Z"}, {"half_width", 1}}), "/replicates/max",
       "an integer from 5 to 1000000", false},
      {"a goal of no quantity", with("/replicates", {{"min", 2}, {"max", 4}, {"quantity", "phi_i"}, {"half_width", 1}}),
       "/replicates/quantity", "did you mean \"phi_j\"?", true},
      {"a goal that is not measured",
       with("/replicates", {{"min", 2}, {"max", 4}, {"quantity", "omega_l"}, {"half_width", 1}}),
       "/replicates/quantity", "add \"modes\" to /measure", false},
      {"a base that is not swept over", beside.dump(), "/base/step_fraction",
       "0.3 is not a swept value; expected one of 0.2, 0.35", false},
      {"a base of a parameter that is not swept", unswept.dump(), "/base/longest_step",
       "the parameter is not swept; expected \"step_fraction\"", false},
      {"a base where nothing is swept", with("/base", {{"method", "newton"}}), "/base/method",
       "the parameter is not swept; remove the base", false},
      {"a million replicates", many.dump(), "/sweep", "at most 1000000", false},
      {"one beyond 2^53", with("/seed", 9007199254740993), "/seed", "is not accepted", false},
  };
}

/// Texts that are not JSON, or whose meaning JSON leaves open.
std::vector<BadManifest> unreadable() {
  const auto good = good_manifest().dump();
  return {
      {"empty", "", "", "the file is empty", false},
      {"prose", "hello", "", ":1:1: not valid JSON", false},
      {"truncated", good.substr(0, good.size() / 2), "", "not valid JSON", false},
      {"second line", "{\n  \"name\": ,\n}", "/name", ":2:11: ", false},
      {"two documents", good + good, "", "not valid JSON", false},
      {"not a number", replaced("\"seed\":7", "\"seed\":NaN"), "/seed", "not valid JSON", false},
      {"beyond double", replaced("\"seed\":7", "\"seed\":1e400"), "/seed", "1e400 is too large", false},
      {"duplicate key", replaced("\"seed\":7", "\"seed\":7,\"seed\":8"), "/seed", "duplicate key", false},
      {"deep", std::string(100000, '['), "", "nested too deeply; expected at most 16 levels", false},
      {"not UTF-8", replaced("tiny", "t\xff"), "/name", "the text is not valid UTF-8; save", false},
      {"NUL", replaced("tiny", std::string("t\0y", 3)), "/name", "not valid JSON", false},
  };
}

}  // namespace

Json good_manifest() {
  return Json::parse(R"({"name":"tiny","seed":7,"sweep":{"solid":["dodecahedron"],"particles":[64]},"replicates":2})");
}

std::vector<BadManifest> bad_manifests() {
  auto all = malformed();
  for (const auto& more :
       {malformed_base(), malformed_shear(), wrong_cohesion(), malformed_sweep(), inconsistent(), unreadable()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace isojam::test
