#include "record/travel.h"

#include <algorithm>

#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr std::size_t kStrayShare = 20;  // one in so many, at each end of an axis
// The first view is kept while all is within so many radii of its centre: it looks below that, so
// that what is poured out of a height stays in it.
constexpr double kKeptRadii = 2.2;
// A place so many times as large as the bodies together is no longer seen from outside.
constexpr double kTogether = 3;
// A view that follows shows so many radii of the bodies together.
constexpr double kFollowedRadii = 1.5;

}  // namespace

Travel::Travel() : middle_("world/middle") {
  middle_.add_column<float>("Points3D:positions", 3);
  middle_.add_column<float>("Points3D:radii");
}

void Travel::add(const Frame& frame) {
  for (std::vector<double>& axis : along_) axis.clear();
  for (const BodyState& body : frame.bodies) {
    const Eigen::Vector3d p = body.pose.position.template cast<double>();
    if (body.type == MotionType::Static || !p.allFinite()) continue;
    for (std::size_t k = 0; k < 3; ++k) along_[k].push_back(p[static_cast<Eigen::Index>(k)]);
  }
  if (along_[0].empty()) return;
  Eigen::Vector3d lower, upper;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double>& axis = along_[k];
    const auto strays = static_cast<std::ptrdiff_t>(axis.size() / kStrayShare);
    const auto low = axis.begin() + strays, high = axis.end() - 1 - strays;
    std::nth_element(axis.begin(), low, axis.end());
    lower[static_cast<Eigen::Index>(k)] = *low - first_.body_radius;
    std::nth_element(axis.begin(), high, axis.end());
    upper[static_cast<Eigen::Index>(k)] = *high + first_.body_radius;
  }
  const Eigen::AlignedBox3d box(lower, upper);
  const Eigen::Vector3d middle = box.center();
  if (went_.isEmpty()) first_middle_ = middle;
  went_.extend(box);
  widest_ = std::max(widest_, box.diagonal().norm() / 2);
  auto* position = middle_.column(0).extend<float>(1);
  std::transform(middle.data(), middle.data() + 3, position,
                 [](double x) { return static_cast<float>(x); });
  middle_.column(1).append_one(0.0f);
  middle_.end_row(frame.number, frame.time);
}

Travel::View Travel::view() const {
  if (went_.isEmpty()) return View::AsBegun;
  const Eigen::Vector3d far =
      (went_.min() - first_.center).cwiseAbs().cwiseMax((went_.max() - first_.center).cwiseAbs());
  if (far.norm() <= kKeptRadii * first_.radius) return View::AsBegun;
  return everywhere().radius <= kTogether * widest_ ? View::Wider : View::Following;
}

SceneExtent Travel::everywhere() const {
  SceneExtent extent = first_;
  if (went_.isEmpty()) return extent;
  extent.center = went_.center();
  extent.radius = went_.diagonal().norm() / 2;
  extent.half_height = 0;  // in the middle of what is seen: nothing will fall below it
  return extent;
}

SceneExtent Travel::seen() const {
  SceneExtent extent = everywhere();
  if (view() != View::Following) return extent;
  extent.center = first_middle_;
  extent.radius = kFollowedRadii * widest_;
  return extent;
}

double Travel::lowest() const {
  if (went_.isEmpty()) return 0;
  const Eigen::Vector3d reach = went_.diagonal() / 2;
  return went_.center().dot(first_.up) - reach.dot(first_.up.cwiseAbs());
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
