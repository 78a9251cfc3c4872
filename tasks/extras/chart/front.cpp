#include "tasks/extras/chart/front.hpp"

#include <algorithm>
#include <limits>

namespace isojam {

std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].failed && points[k].seconds && points[k].error) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const ChartPoint &p = points[a], &q = points[b];
    if (p.seconds->median != q.seconds->median) return p.seconds->median < q.seconds->median;
    return p.error->median < q.error->median;
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t k : order) {
    if (points[k].error->median >= least) continue;
    least = points[k].error->median;
    front.push_back(k);
  }
  return front;
}

}  // namespace isojam
