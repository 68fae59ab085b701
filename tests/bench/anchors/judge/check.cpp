#include "bench/anchors/judge/check.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plumb::anchors {
namespace {

double worst_gap(const Scene& scene, const std::vector<BodyState>& bodies) {
  double worst = 0;
  for (const BallJoint& joint : scene.joints) {
    const auto place = [&](int i, const Vector3d& at) -> Vector3d {
      if (i < 0) return at;
      const BodyState& body = bodies[static_cast<std::size_t>(i)];
      return body.position + body.orientation * at;
    };
    const double gap = (place(joint.a, joint.at_a) - place(joint.b, joint.at_b)).norm();
    worst = gap > worst || std::isnan(gap) ? gap : worst;
  }
  return worst;
}

std::uint64_t hash_of(const std::vector<BodyState>& bodies) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
  };
  for (const BodyState& body : bodies) {
    for (int k = 0; k < 3; ++k) add(body.position[k]);
    for (int k = 0; k < 4; ++k) add(body.orientation.coeffs()[k]);
  }
  return hash;
}

}  // namespace

double energy_of(const Scene& scene, const std::vector<BodyState>& bodies) {
  double sum = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& made = scene.bodies[i];
    const BodyState& body = bodies[i];
    const Vector3d spin = body.orientation.conjugate() * body.spin;  // in body axes
    sum += 0.5 * made.mass * body.velocity.squaredNorm() +
           0.5 * spin.dot(made.inertia.cwiseProduct(spin)) -
           made.mass * scene.gravity.dot(body.position);
  }
  return sum;
}

Checker::Checker(const Scene& scene)
    : scene_(scene), watches_(scene.counts_flips || scene.watches_energy || !scene.joints.empty()) {
  std::vector<BodyState> bodies;
  for (const Body& body : scene.bodies)
    bodies.push_back({body.position, body.orientation, body.velocity, body.spin});
  energy_ = energy_of(scene, bodies);
}

void Checker::after_step(const std::vector<BodyState>& bodies) {
  if (!watches_) return;
  ++steps_;
  quality_.joint_gap = std::max(quality_.joint_gap, worst_gap(scene_, bodies));
  if (scene_.watches_energy) {
    const double error = energy_of(scene_, bodies) / energy_ - 1;
    quality_.energy_rise = std::max(quality_.energy_rise, error);
    square_sum_ += error * error;
  }
  if (scene_.counts_flips) {
    // From well up to well down or back: what wobbles about the middle has not turned over.
    const double up = (bodies[0].orientation * Vector3d::UnitY()).y();
    if (std::abs(up) > 0.5 && up * last_up_ < 0) ++quality_.flips;
    if (std::abs(up) > 0.5) last_up_ = up;
  }
}

Quality Checker::finish(const std::vector<BodyState>& bodies) {
  for (const BodyState& body : bodies) {
    const bool inside = body.orientation.coeffs().allFinite() &&
                        (body.position.array() >= scene_.lower.array()).all() &&
                        (body.position.array() <= scene_.upper.array()).all();
    if (!inside) ++quality_.escaped;
    quality_.mean_speed += body.velocity.norm() / static_cast<double>(bodies.size());
  }
  if (scene_.collide) {
    quality_.penetration = worst_penetration(scene_, bodies);
    quality_.under_mesh = depth_under_mesh(scene_, bodies);
  }
  if (scene_.top >= 0) {
    const auto top = static_cast<std::size_t>(scene_.top);
    const Vector3d way = bodies[top].position - scene_.bodies[top].position;
    quality_.top_up = way.y();
    quality_.top_sideways = std::hypot(way.x(), way.z());
  }
  quality_.energy_change = energy_of(scene_, bodies) / energy_ - 1;
  if (steps_ > 0) quality_.energy_rms = std::sqrt(square_sum_ / steps_);
  quality_.hash = hash_of(bodies);
  return quality_;
}

}  // namespace plumb::anchors
