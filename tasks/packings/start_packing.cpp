#include "tasks/packings/start_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

#include "tasks/io/hash.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace {

Packing read_any(const std::string& bytes, StartFile& file, const Mixture& mixture, const TypeNames& types) {
  constexpr std::string_view gsd_magic = "\xDF\x65\xDF\x65\xDF\x65\xDF\x65";
  const auto converted = [&](const ForeignPacking& foreign) {
    return packing_of(foreign, mixture, types, &file.notes);
  };
  if (bytes.starts_with(gsd_magic)) return converted(read_gsd_packing(bytes, file.frame));
  if (!bytes.starts_with('{')) return converted(read_xyz_packing(bytes, file.frame));
  if (!types.empty()) throw ContentError("packings of isojam contain their solids", "remove /start/types");
  try {
    const auto json = parse_sealed(bytes, file.path);
    return read_packing(JsonPlace(json, file.path));
  } catch (const InputError& error) {
    throw ContentError(error.what());
  }
}

}  // namespace

bool are_particles_of(const Packing& packing, const Mixture& mixture) {
  std::vector<Particle> own(packing.solids.particles().begin(), packing.solids.particles().end());
  if (packing.solids.is_uniform()) own.assign(packing.poses.size(), Particle{&packing.solids.only()});
  auto expected = mixture.particles(packing.size());
  const auto key = [](const Particle& p) { return std::tuple(p.kind, p.scale, p.unit->name(), p.unit); };
  const auto before = [&](const Particle& a, const Particle& b) { return key(a) < key(b); };
  std::sort(own.begin(), own.end(), before);
  std::sort(expected.begin(), expected.end(), before);
  return own == expected;
}

void load(StartFile& file, const std::string& bytes, const Mixture& mixture, int n, const TypeNames& types) {
  file.notes.clear();
  auto packing = read_any(bytes, file, mixture, types);
  if (packing.size() != n || !are_particles_of(packing, mixture)) {
    throw ContentError(
        fmt::format("its {} particles do not match {} particles of {}", packing.size(), n, to_string(mixture)));
  }
  file.digest = hex_hash(bytes);
  file.packing = std::make_shared<const Packing>(std::move(packing));
}

}  // namespace isojam
