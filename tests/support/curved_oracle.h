// Answers about any convex shape, cylinders, cones and rounded ones among them, in double precision
// and from the definitions: how far it reaches along a direction, how far a point is from it, and
// the most room of two shapes along any direction by looking along all of them. Shares no code with
// the narrowphase.
#pragma once

#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI::oracle {

class Body {
 public:
  Body(const detail::CollisionShape& shape, const detail::Transform& x)
      : shape_(shape), R_(rotation_of(x).toRotationMatrix()), p_(vec(x.p)) {
    radius_ = static_cast<double>(shape.radius);
    r_ = static_cast<double>(shape.half.x);
    h_ = static_cast<double>(shape.half.y);
    u_ = R_.col(1);
    if (!round() && shape.type != detail::ShapeType::HalfSpace) solid_ = solid_of(shape, x);
    if (shape.type == detail::ShapeType::HalfSpace) {
      normal_ = (R_ * vec(shape.normal)).normalized();
      offset_ = static_cast<double>(shape.offset) + normal_.dot(p_);
    }
  }

  [[nodiscard]] bool round() const { return cylinder() || cone(); }
  [[nodiscard]] bool half_space() const { return shape_.type == detail::ShapeType::HalfSpace; }
  [[nodiscard]] const V& plane() const { return normal_; }
  [[nodiscard]] const V& middle() const { return p_; }

  // The largest n . x over the shape (finite shapes).
  [[nodiscard]] double reach(const V& n) const {
    if (round()) {
      const double c = n.dot(u_), aside = r_ * (n - c * u_).norm();
      const double core = cylinder() ? h_ * std::abs(c) + aside : std::max(h_ * c, aside - h_ * c);
      return n.dot(p_) + core + radius_;
    }
    double far = -std::numeric_limits<double>::infinity();
    for (const V& v : solid_.vertices) far = std::max(far, n.dot(v));
    return far + radius_;
  }
  // Distance of a point from the surface, negative inside.
  [[nodiscard]] double distance(const V& point) const {
    if (half_space()) return normal_.dot(point) - offset_;
    if (!round()) return signed_distance(point, solid_);
    const double y = u_.dot(point - p_), r = (point - p_ - y * u_).norm();
    std::vector<Eigen::Vector2d> profile = {{0, -h_}, {r_, -h_}};
    if (cylinder()) profile.emplace_back(r_, h_);
    profile.emplace_back(0, h_);
    const Eigen::Vector2d q(r, y);
    double near = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const Eigen::Vector2d a = profile[i], d = profile[i + 1] - a;
      const double t = std::clamp((q - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      near = std::min(near, (a + t * d - q).norm());
      inside = inside && d.x() * (q.y() - a.y()) - d.y() * (q.x() - a.x()) >= 0;
    }
    return (inside ? -near : near) - radius_;
  }

  // Directions perpendicular to flat faces, and lines of directions (great circles about a vector)
  // across which the reach has a bend: the best direction often lies on one.
  void add_special(std::vector<V>& faces, std::vector<V>& bends) const {
    if (round()) {
      faces.push_back(u_);
      bends.push_back(u_);
    }
    for (const V& n : solid_.normals) faces.push_back(n);
    for (const auto& [i, k] : solid_.edges) {
      const V d = (solid_.vertices[static_cast<std::size_t>(k)] -
                   solid_.vertices[static_cast<std::size_t>(i)])
                      .normalized();
      const bool known = std::any_of(bends.begin(), bends.end(),
                                     [&d](const V& e) { return e.cross(d).norm() < 1e-9; });
      if (!known) bends.push_back(d);
    }
  }
  // The directions perpendicular to a cone's side.
  [[nodiscard]] bool cone() const { return shape_.type == detail::ShapeType::Cone; }
  [[nodiscard]] V side_normal(double angle) const {
    const V radial = std::cos(angle) * R_.col(0) + std::sin(angle) * R_.col(2);
    return (2 * h_ * radial + r_ * u_).normalized();
  }

 private:
  [[nodiscard]] bool cylinder() const { return shape_.type == detail::ShapeType::Cylinder; }

  const detail::CollisionShape& shape_;
  Eigen::Matrix3d R_;
  V p_, u_, normal_ = V::UnitY();
  double radius_, r_, h_, offset_ = 0;
  Solid solid_;
};

inline double room_along(const Body& a, const Body& b, const V& n) {
  if (a.half_space()) return a.distance(V::Zero()) - b.reach(-n);  // only along its own normal
  return -b.reach(-n) - a.reach(n);
}

// The most room of two finite shapes in any direction: their distance, or minus their depth of
// overlap. Looks along thousands of directions and along every bend, then closes in on the best
// ones. What it finds is never more than the truth, and less by at most about 1e-7 of the sizes.
class Search {
 public:
  Search(const Body& a, const Body& b) : a_(a), b_(b) {}

  double most_room(int directions, int along_bends) {
    std::vector<V> faces, bends;
    a_.add_special(faces, bends);
    b_.add_special(faces, bends);
    for (const V& n : faces) {
      consider(n);
      consider(-n);
    }
    for (std::size_t i = 0; i < bends.size(); ++i) {
      for (std::size_t k = i + 1; k < bends.size(); ++k) {
        const V c = bends[i].cross(bends[k]);
        if (c.norm() < 1e-9) continue;
        consider(c.normalized());
        consider(-c.normalized());
      }
    }
    const double pi = std::acos(-1.0);
    for (const V& e : bends) {
      const V s = e.unitOrthogonal(), t = e.cross(s);
      along_line(along_bends, [&](double x) -> V { return std::cos(x) * s + std::sin(x) * t; });
    }
    for (const Body* body : {&a_, &b_}) {
      if (!body->cone()) continue;
      const double sign = body == &a_ ? 1 : -1;
      along_line(along_bends, [&](double x) -> V { return sign * body->side_normal(x); });
    }
    // A spiral of directions, evenly spread.
    for (int i = 0; i < directions; ++i) {
      const double z = 1 - (2 * i + 1.0) / directions, turn = pi * (1 + std::sqrt(5.0)) * i;
      const double r = std::sqrt(1 - z * z);
      consider(V(r * std::cos(turn), r * std::sin(turn), z));
    }
    std::sort(seen_.begin(), seen_.end(),
              [](const Seen& a, const Seen& b) { return a.room > b.room; });
    // From the best of each valley.
    std::vector<V> starts;
    for (const Seen& s : seen_) {
      if (starts.size() == 8) break;
      const bool near = std::any_of(starts.begin(), starts.end(),
                                    [&s](const V& n) { return n.dot(s.n) > 0.985; });
      if (near) continue;
      starts.push_back(s.n);
      climb(s.n, 4 / std::sqrt(directions + 1.0));
    }
    return best_;
  }

 private:
  struct Seen {
    double room;
    V n;
  };
  double room(const V& n) const { return room_along(a_, b_, n); }
  double consider(const V& n) {
    const double r = room(n);
    best_ = std::max(best_, r);
    if (seen_.size() < 4096) seen_.push_back({r, n});
    return r;
  }
  template <class Line>
  void along_line(int count, const Line& line) {
    const double step = 2 * std::acos(-1.0) / count;
    double best = -std::numeric_limits<double>::infinity(), at = 0;
    for (int i = 0; i < count; ++i) {
      const double r = room(line(step * i));
      if (r > best) best = r, at = step * i;
    }
    double low = at - step, high = at + step;  // golden section
    const double g = (std::sqrt(5.0) - 1) / 2;
    for (int i = 0; i < 50; ++i) {
      const double x = high - g * (high - low), y = low + g * (high - low);
      if (room(line(x)) > room(line(y))) {
        high = y;
      } else {
        low = x;
      }
    }
    best_ = std::max(best_, room(line((low + high) / 2)));
    seen_.push_back({best, line(at)});
  }
  void climb(V n, double step) {
    double here = room(n);
    for (int steps = 0; steps < 100 && step > 1e-8; ++steps) {
      const V s = n.unitOrthogonal(), t = n.cross(s);
      V better = n;
      for (int i = 0; i < 8; ++i) {
        const double angle = std::acos(-1.0) / 4 * i;
        const V m = (n + step * (std::cos(angle) * s + std::sin(angle) * t)).normalized();
        if (const double r = room(m); r > here) here = r, better = m;
      }
      if (better == n) step /= 2;
      n = better;
    }
    best_ = std::max(best_, here);
  }

  const Body& a_;
  const Body& b_;
  double best_ = -std::numeric_limits<double>::infinity();
  std::vector<Seen> seen_;
};

}  // namespace plumb::inline PLUMB_ABI::oracle
