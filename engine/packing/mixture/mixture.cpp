#include "engine/packing/mixture/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/packing/cell/periodic_cell.hpp"

namespace isojam {

namespace {

/// Name of a mixture, such as "octahedron_0.5+octahedronx1.4_0.5".
std::string text_of(const std::vector<MixtureKind>& kinds) {
  std::string text;
  for (const MixtureKind& kind : kinds) {
    const std::string size = kind.sizes.text();
    if (!text.empty()) text += '+';
    text += to_string(kind.solid);
    if (!size.empty()) text.append(1, 'x').append(size);
    text.append(1, '_').append(shortest_text(kind.fraction));
  }
  return text;
}

}  // namespace

Mixture::Mixture(std::vector<MixtureKind> kinds, std::string name) : kinds_(std::move(kinds)), name_(std::move(name)) {
  if (name_.empty()) name_ = is_one_solid() ? std::string(to_string(solid())) : text_of(kinds_);
}

bool Mixture::is_one_solid() const {
  return kinds_.size() == 1 && kinds_.front().sizes.law == SizeLaw::fixed &&
         (name_.empty() || name_ == to_string(solid()));
}

std::vector<int> Mixture::counts(int n) const {
  std::vector<int> counts;
  std::vector<double> rest;
  for (const MixtureKind& kind : kinds_) {
    const double share = kind.fraction * n;
    // If the share is an integer within rounding errors, it is treated as this integer.
    counts.push_back(static_cast<int>(std::floor(share + 1e-9)));
    rest.push_back(share - counts.back());
  }
  std::vector<std::size_t> order(kinds_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rest[a] > rest[b] + 1e-9; });
  int left = n - std::accumulate(counts.begin(), counts.end(), 0);
  for (std::size_t k = 0; left > 0; --left, ++k) ++counts[order[k % order.size()]];
  return counts;
}

std::vector<Particle> Mixture::particles(int n) const {
  const std::vector<int> numbers = counts(n);
  std::vector<Particle> particles;
  double volume = 0;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    for (int m = 0; m < numbers[k]; ++m) {
      const double size = kinds_[k].sizes.of_particle(m, numbers[k]);
      particles.push_back({&*kinds_[k].solid, size, static_cast<int>(k)});
      volume += size * size * size;
    }
  }
  const bool alike = std::all_of(particles.begin(), particles.end(),
                                 [&](const Particle& p) { return p.scale == particles.front().scale; });
  const double unit = nearest::cbrt(n / volume);
  for (Particle& particle : particles) particle.scale = alike ? 1 : particle.scale * unit;
  return particles;
}

std::strong_ordering operator<=>(const Mixture& a, const Mixture& b) {
  if (a.is_one_solid() && b.is_one_solid()) return a.solid() <=> b.solid();
  if (a.is_one_solid() != b.is_one_solid())
    return a.is_one_solid() ? std::strong_ordering::less : std::strong_ordering::greater;
  const auto order =
      std::lexicographical_compare_three_way(a.kinds_.begin(), a.kinds_.end(), b.kinds_.begin(), b.kinds_.end());
  if (std::is_lt(order)) return std::strong_ordering::less;
  if (std::is_gt(order)) return std::strong_ordering::greater;
  return a.name_ <=> b.name_;
}

double widest_diameter(const Mixture& mixture, int n, double grown_by) {
  double widest = 0;
  for (const Particle& particle : mixture.particles(n))
    widest = std::max(widest, (particle.scale + grown_by / particle.unit->inradius()) * particle.unit->diameter());
  return widest;
}

int least_particles(const Mixture& mixture, double density, double grown_by) {
  if (mixture.is_one_solid() && grown_by == 0) return least_particles(*mixture.solid(), density);
  // The sizes depend on n only through rounding and through the outermost quantiles.
  const auto is_legal_for = [&](int n) { return side_at(n, density) > 2 * widest_diameter(mixture, n, grown_by); };
  constexpr int most = 1 << 17;
  int few = 0, enough = 1;
  while (!is_legal_for(enough) && enough < most) few = enough, enough *= 2;
  while (enough - few > 1) {
    const int middle = few + (enough - few) / 2;
    (is_legal_for(middle) ? enough : few) = middle;
  }
  return enough;
}

}  // namespace isojam
