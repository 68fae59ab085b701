// Pareto front, order of convergence, and the two questions.
#include <algorithm>
#include <cmath>

#include "accuracy/lab.h"

namespace plumb::accuracy {

void mark_pareto(std::vector<CellResult>& cells) {
  for (CellResult& cell : cells) {
    cell.pareto = std::isfinite(cell.error) &&
                  std::none_of(cells.begin(), cells.end(), [&](const auto& other) {
                    return other.error <= cell.error && other.cost <= cell.cost &&
                           (other.error < cell.error || other.cost < cell.cost);
                  });
  }
}

// Points that count: error at least 10 times the smallest of the series or of the reference
// (round-off has no order), at most a third of the size of the motion (beyond it errors saturate),
// and from there on to shorter steps only.
OrderFit fit_order(const CaseResult& result, const std::vector<CurvePoint>& points) {
  OrderFit fit;
  double least = 1e300;
  for (const CurvePoint& point : points) least = std::min(least, point.error);
  const double floor =
      std::max({10 * least * 1e-3, 10 * result.reference_spread, 1e-11 * result.info->scale});
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const CurvePoint& point : points) {
    if (!(point.error > floor) || point.error > result.info->scale / 3) continue;
    const double a = std::log(point.dt), b = std::log(point.error);
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
    yy += b * b;
  }
  fit.points = static_cast<int>(n);
  if (n < 3) return fit;
  const double sxx = n * xx - x * x, sxy = n * xy - x * y, syy = n * yy - y * y;
  fit.order = sxy / sxx;
  fit.found = sxy > 0 && sxy * sxy >= 0.9 * sxx * syy;
  return fit;
}

OrderFit fit_order(const CaseResult& result, std::size_t series) {
  std::vector<CurvePoint> points;
  for (const CellResult& cell : result.cells)
    if (cell.series == series) points.push_back({cell.knobs.dt, cell.error, cell.cost});
  OrderFit fit = fit_order(result, points);
  fit.series = series;
  return fit;
}

const CellResult* cheapest(const CaseResult& result, double error) {
  const CellResult* best = nullptr;
  for (const CellResult& cell : result.cells)
    if (cell.error <= error && (best == nullptr || cell.cost < best->cost)) best = &cell;
  return best;
}

const CellResult* most_accurate(const CaseResult& result, double cost) {
  const CellResult* best = nullptr;
  for (const CellResult& cell : result.cells)
    if (cell.cost <= cost && (best == nullptr || cell.error < best->error)) best = &cell;
  return best;
}

}  // namespace plumb::accuracy
