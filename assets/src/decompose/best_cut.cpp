#include "decompose/best_cut.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Planes that are tried for a piece, fewer where it has so many edges that each of them is dear.
constexpr std::size_t kMostPlanes = 96, kFewestPlanes = 16;
constexpr std::size_t kEdgesTimesPlanes = 1'000'000;
// Halvings of the gap between the best of evenly spaced planes and its neighbours.
constexpr int kRefinements = 2;
// A side smaller than this share of the piece is a splinter that nothing stands on.
constexpr double kSplinter = 1e-4;
// Where no plane gains much, as at the first cut of a ring or of a box with a cavity, what is cut
// along concave edges, evenly and across the narrow way gains later.
constexpr double kConcaveLeft = 0.3;
constexpr double kUnevenness = 0.1;
constexpr double kCutArea = 0.1;

// Round pieces have so many corners that their hulls are the search's whole cost. Those farthest
// along so many directions tell good planes from bad ones; the best are then looked at closely.
constexpr std::size_t kDirections = 96;
constexpr std::size_t kCloseLooks = 4;

struct Trial {
  double score = std::numeric_limits<double>::infinity();
  CutPlane plane;
  double step = 0;  // to the neighbouring planes of the same direction; 0: it has none
  Piece front, back;
  PartHull front_hull, back_hull;
};

// Evenly over half of the sphere, on a spiral.
std::vector<Vector3d> spiral_directions() {
  constexpr std::size_t count = kDirections / 2;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = (static_cast<double>(k) + 0.5) / count, r = std::sqrt(1 - z * z);
    const double angle = golden_angle * static_cast<double>(k);
    directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return directions;
}

// The points that lie farthest along the directions, either way.
std::vector<Vector3d> farthest_of(const std::vector<Vector3d>& points,
                                  const std::vector<Vector3d>& directions) {
  std::vector<bool> chosen(points.size(), false);
  for (const Vector3d& direction : directions) {
    std::size_t lowest = 0, highest = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double along = direction.dot(points[p]);
      if (along < low) {
        low = along;
        lowest = p;
      }
      if (along > high) {
        high = along;
        highest = p;
      }
    }
    chosen[lowest] = chosen[highest] = true;
  }
  std::vector<Vector3d> out;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (chosen[p]) out.push_back(points[p]);
  return out;
}

// The frame's axes, and those along which the piece is long and short.
std::vector<Vector3d> directions_of(const Piece& piece) {
  std::vector<Vector3d> directions{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  double length = 0;
  Vector3d mean = Vector3d::Zero();
  for (const Piece::Edge& edge : piece.edges) {
    const Vector3d &a = piece.points[edge.from], &b = piece.points[edge.to];
    length += (b - a).norm();
    mean += 0.5 * (b - a).norm() * (a + b);
  }
  if (!(length > 0)) return directions;
  mean /= length;
  Matrix3d spread = Matrix3d::Zero();
  for (const Piece::Edge& edge : piece.edges) {
    const Vector3d d = 0.5 * (piece.points[edge.from] + piece.points[edge.to]) - mean;
    spread += (piece.points[edge.to] - piece.points[edge.from]).norm() * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(spread);
  constexpr double kSame = 0.999;  // cosine
  for (int k = 3; k-- > 0;) {
    const Vector3d axis = axes.eigenvectors().col(k);
    if (axis.cwiseAbs().maxCoeff() < kSame) directions.push_back(axis);
  }
  return directions;
}

double depth_of(const std::vector<ConcaveEdge>& edges) {
  double depth = 0;
  for (const ConcaveEdge& edge : edges) depth += (edge.b - edge.a).norm() * edge.angle;
  return depth;
}

class Search {
 public:
  Search(const Node& node, double on_plane)
      : node_(node),
        on_plane_(on_plane),
        whole_depth_(depth_of(node.concave)),
        spiral_(spiral_directions()) {}

  std::optional<BestCut> run() {
    std::vector<Trial> trials = glances();
    const std::size_t close_looks = std::min(kCloseLooks, trials.size());
    std::partial_sort(trials.begin(), trials.begin() + static_cast<std::ptrdiff_t>(close_looks),
                      trials.end(),
                      [](const Trial& a, const Trial& b) { return a.score < b.score; });
    for (std::size_t k = 0; k < close_looks; ++k) look_closely(trials[k].plane, trials[k].step);
    for (int k = 0; k < kRefinements && best_.step > 0; ++k) {
      const CutPlane middle = best_.plane;
      const double step = 0.5 * best_.step;
      look_closely({middle.normal, middle.offset - step}, step);
      look_closely({middle.normal, middle.offset + step}, step);
      best_.step = step;
    }
    if (!std::isfinite(best_.score)) return std::nullopt;
    BestCut cut;
    cut.front = {std::move(best_.front), in_front(node_.concave, best_.plane, on_plane_),
                 std::move(best_.front_hull)};
    cut.back = {std::move(best_.back), in_front(node_.concave, best_.plane.flipped(), on_plane_),
                std::move(best_.back_hull)};
    return cut;
  }

 private:
  // Planes through concave edges, and evenly spaced ones across the piece's directions, with their
  // scores by few points; without pieces and hulls.
  std::vector<Trial> glances() {
    std::vector<Trial> trials;
    const std::size_t planes =
        std::clamp(kEdgesTimesPlanes / node_.piece.edges.size(), kFewestPlanes, kMostPlanes);
    for (const CutPlane& plane : planes_through(node_.concave, planes / 2))
      glance(plane, 0, trials);
    const std::vector<Vector3d> directions = directions_of(node_.piece);
    const std::size_t count = std::max<std::size_t>((planes - planes / 2) / directions.size(), 3);
    for (const Vector3d& direction : directions) {
      double lower = std::numeric_limits<double>::infinity(), upper = -lower;
      for (const Vector3d& corner : node_.hull.corners) {
        lower = std::min(lower, direction.dot(corner));
        upper = std::max(upper, direction.dot(corner));
      }
      const double step = (upper - lower) / static_cast<double>(count + 1);
      for (std::size_t k = 1; k <= count; ++k)
        glance({direction, lower + step * static_cast<double>(k)}, step, trials);
    }
    return trials;
  }

  void glance(const CutPlane& plane, double step, std::vector<Trial>& trials) const {
    const Trial trial = scored(plane, step, true, std::numeric_limits<double>::infinity());
    if (std::isfinite(trial.score)) trials.push_back({trial.score, plane, step, {}, {}, {}, {}});
  }

  void look_closely(const CutPlane& plane, double step) {
    Trial trial = scored(plane, step, false, best_.score);
    if (trial.score < best_.score) best_ = std::move(trial);
  }

  // Infinite if it does not stay below `limit`.
  [[nodiscard]] Trial scored(const CutPlane& plane, double step, bool few_points,
                             double limit) const {
    Trial trial;
    Piece front = in_front(node_.piece, plane, on_plane_);
    Piece back = in_front(node_.piece, plane.flipped(), on_plane_);
    const double whole = node_.piece.volume, size = std::cbrt(node_.hull.volume);
    if (!(front.volume > kSplinter * whole && back.volume > kSplinter * whole)) return trial;
    double score = kUnevenness * std::abs(front.volume - back.volume) / whole +
                   kCutArea * front.cap_area / (size * size);
    if (whole_depth_ > 0)
      score += kConcaveLeft / whole_depth_ *
               (depth_of(in_front(node_.concave, plane, on_plane_)) +
                depth_of(in_front(node_.concave, plane.flipped(), on_plane_)));
    const auto add_hull = [&](const Piece& side, PartHull& hull) {
      if (!(score < limit)) return false;
      std::vector<Vector3d> points = points_of(side);
      if (few_points && points.size() > kDirections) points = farthest_of(points, spiral_);
      std::optional<PartHull> made = part_hull(points);
      if (!made) return false;
      score += (made->volume - side.volume) / node_.excess();
      hull = std::move(*made);
      return score < limit;
    };
    if (!add_hull(front, trial.front_hull) || !add_hull(back, trial.back_hull)) return trial;
    trial.score = score;
    trial.plane = plane;
    trial.step = step;
    trial.front = std::move(front);
    trial.back = std::move(back);
    return trial;
  }

  const Node& node_;
  double on_plane_;
  double whole_depth_;
  std::vector<Vector3d> spiral_;
  Trial best_;
};

}  // namespace

std::optional<BestCut> best_cut(const Node& node, double on_plane) {
  return Search(node, on_plane).run();
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
