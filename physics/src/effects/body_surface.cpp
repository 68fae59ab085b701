#include "effects/body_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/effect_store.h"
#include "math/arc_tangent.h"
#include "math/eigen_bridge.h"
#include "plumb/compound.h"
#include "plumb/mass_properties.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr int kSides = 24;  // of the panels of round shapes
constexpr int kRings = 6;   // of the panels of a half ball

struct Placement {
  NumVec p;
  NumRotation q;
  [[nodiscard]] NumVec at(NumVec local) const { return p + rotate(q, local); }
};

class SurfaceMaker {
 public:
  explicit SurfaceMaker(BodySurface& out) : out_(out) {}

  void add(const Shape& shape, const Placement& at) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      const double r = static_cast<double>(sphere->radius);
      out_.balls.push_back({at.p, r});
      reach(at.p, r);
    } else if (const auto* box = std::get_if<Box>(&shape)) {
      add_box(shape, *box, at);
    } else if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
      add_hull(shape, *hull, at);
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
      const double h = static_cast<double>(capsule->half_length);
      add_round({{0, -h}, {0, h}}, static_cast<double>(capsule->radius), at);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      const double h = static_cast<double>(cylinder->half_length);
      const double r = static_cast<double>(cylinder->radius);
      add_round({{r, -h}, {r, h}}, static_cast<double>(cylinder->rounding), at);
    } else if (const auto* cone = std::get_if<Cone>(&shape)) {
      const double h = static_cast<double>(cone->half_length);
      const double r = static_cast<double>(cone->radius);
      add_round({{r, -h}, {0, h}}, static_cast<double>(cone->rounding), at);
    } else if (const auto* compound = std::get_if<Compound>(&shape)) {
      for (const CompoundGeometry::Child& child : compound->geometry->children())
        add(child.shape, {at.at(cast<Num>(to_inner(child.pose.position))),
                          at.q * to_num(to_inner(child.pose.orientation))});
    } else if (const auto* mesh = std::get_if<SurfaceMesh>(&shape)) {
      add_mesh(*mesh, at);
    }
  }

  void add_mesh(const SurfaceMesh& mesh, const Placement& at) {
    const std::uint32_t begin = count();
    const NumVec scale = cast<Num>(to_inner(mesh.scale));
    for (std::size_t t = 0; t < mesh.geometry->triangle_count(); ++t) {
      const auto corners = mesh.geometry->triangle(t);
      const auto corner = [&](std::size_t k) {
        return at.at(multiply_each(scale, cast<Num>(to_inner(corners[k]))));
      };
      add_triangle(corner(0), corner(1), corner(2));
    }
    out_.solids.push_back({begin, count(), 1});
  }

 private:
  [[nodiscard]] std::uint32_t count() const {
    return static_cast<std::uint32_t>(out_.triangles.size());
  }
  void reach(NumVec p, double r) { out_.radius = std::max(out_.radius, length(p) + r); }

  void add_panel(NumVec a, NumVec b, NumVec c) {
    const NumVec twice = cross(b - a, c - a);
    const double area = 0.5 * length(twice);
    if (area > 0) out_.panels.push_back({(1.0 / 3) * (a + b + c), (0.5 / area) * twice, area});
  }
  void add_triangle(NumVec a, NumVec b, NumVec c) {
    out_.triangles.push_back({a, b, c});
    add_panel(a, b, c);
    for (const NumVec p : {a, b, c}) reach(p, 0);
  }

  // The triangles' volume against the true one of the shape with its rounded edges.
  void close_solid(std::uint32_t begin, const Shape& shape) {
    double volume = 0;
    for (std::uint32_t i = begin; i < count(); ++i) {
      const SurfaceTriangle& t = out_.triangles[i];
      volume += dot(t.a, cross(t.b, t.c)) / 6;
    }
    const ShapeMass exact = mass_of(shape, 1.0);
    const bool known = exact.status.ok() && volume > 0;
    out_.solids.push_back({begin, count(), known ? exact.properties.mass / volume : 1});
  }

  void add_box(const Shape& shape, const Box& box, const Placement& at) {
    const std::uint32_t begin = count();
    const double grown = static_cast<double>(box.rounding);
    const NumVec h = cast<Num>(to_inner(box.half_extents)) + NumVec{grown, grown, grown};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        NumVec n{0, 0, 0}, u{0, 0, 0}, v{0, 0, 0};
        set_component(n, axis, side * component(h, axis));
        set_component(u, (axis + 1) % 3, component(h, (axis + 1) % 3));
        set_component(v, (axis + 2) % 3, side * component(h, (axis + 2) % 3));
        const NumVec p = at.at(n - u - v), q = at.at(n + u - v), r = at.at(n + u + v),
                     s = at.at(n - u + v);
        add_triangle(p, q, r);
        add_triangle(p, r, s);
      }
    }
    close_solid(begin, shape);
  }

  // A rounded hull is stretched from its middle so that its faces lie where the rounding ends.
  void add_hull(const Shape& shape, const ConvexHull& hull, const Placement& at) {
    const std::uint32_t begin = count();
    const HullGeometry& g = *hull.geometry;
    const NumVec middle = cast<Num>(to_inner(g.interior_point()));
    const double inner = static_cast<double>(g.inner_radius());
    const double stretch = inner > 0 ? 1 + static_cast<double>(hull.rounding) / inner : 1;
    const auto corner = [&](std::uint32_t i) {
      const NumVec v = cast<Num>(to_inner(g.vertices()[i]));
      return at.at(middle + stretch * (v - middle));
    };
    for (std::size_t f = 0; f < g.face_count(); ++f) {
      const std::span<const std::uint32_t> face = g.face(f);
      for (std::size_t k = 2; k < face.size(); ++k)
        add_triangle(corner(face[0]), corner(face[k - 1]), corner(face[k]));
    }
    close_solid(begin, shape);
  }

  struct End {
    double r, y;
  };
  void add_round(const End (&ends)[2], double rounding, const Placement& at) {
    SurfaceRound round;
    round.center = at.p;
    round.axis = rotate(at.q, NumVec{0, 1, 0});
    round.rounding = rounding;
    for (int k = 0; k < 2; ++k) {
      round.profile[k].r = ends[k].r;
      round.profile[k].y = ends[k].y;
      reach(at.at({0, ends[k].y, 0}), ends[k].r + rounding);
    }
    out_.rounds.push_back(round);
    // The profile from the lower pole to the upper one, turned about the axis.
    std::vector<End> line{{0, ends[0].y - rounding}};
    const double slope = arc_tangent(ends[0].r - ends[1].r, ends[1].y - ends[0].y);
    const int steps = rounding > 0 ? kRings : 0;
    const auto arc = [&](const End& end, double from, double to) {
      for (int k = 0; k <= steps; ++k) {
        const double t = steps > 0 ? from + (to - from) * k / steps : 0;
        double s, c;
        sin_cos(t, s, c);
        line.push_back({end.r + rounding * c, end.y + rounding * s});
      }
    };
    arc(ends[0], -0.5 * std::numbers::pi, slope);
    arc(ends[1], slope, 0.5 * std::numbers::pi);
    line.push_back({0, ends[1].y + rounding});
    for (std::size_t k = 0; k + 1 < line.size(); ++k) turn_about(line[k], line[k + 1], at);
  }
  void turn_about(const End& lower, const End& upper, const Placement& at) {
    const auto corner = [&](const End& e, int side) {
      double s, c;
      sin_cos(2 * std::numbers::pi * (side % kSides) / kSides, s, c);
      return at.at({e.r * c, e.y, -e.r * s});
    };
    for (int side = 0; side < kSides; ++side) {
      const NumVec a = corner(lower, side), b = corner(lower, side + 1),
                   c = corner(upper, side + 1), d = corner(upper, side);
      add_panel(a, b, c);
      add_panel(a, c, d);
    }
  }

  BodySurface& out_;
};

}  // namespace

void make_surface(const WorldState& world, std::uint32_t body, BodySurface& out) {
  SurfaceMaker maker(out);
  for (const std::uint32_t slot : world.bodies.info[body].colliders) {
    const ColliderInfo& collider = world.colliders.info[slot];
    if (collider.component.is_sensor) continue;
    maker.add(collider.component.shape,
              {cast<Num>(collider.in_body.p), to_num(collider.in_body.q)});
  }
}

const BodySurface& surface_of(WorldState& world, std::uint32_t body) {
  EffectStore& store = *world.effects;
  if (store.surfaces.size() <= body) store.surfaces.resize(world.bodies.info.size());
  if (store.surfaces[body] == nullptr) {
    auto made = std::make_shared<BodySurface>();
    make_surface(world, body, *made);
    store.surfaces[body] = std::move(made);
  }
  return *store.surfaces[body];
}

void make_surface(const Shape& shape, NumVec center_B, NumRotation R_BP, BodySurface& out) {
  SurfaceMaker maker(out);
  maker.add(shape, {inverse_rotate(R_BP, -center_B), conjugate(R_BP)});
}

const BodySurface& hull_of(WorldState& world, std::uint32_t effect, const SurfaceMesh& mesh,
                           std::uint32_t body) {
  EffectStore& store = *world.effects;
  if (store.hulls.size() <= effect) store.hulls.resize(store.info.size());
  if (store.hulls[effect] == nullptr) {
    const BodyInfo& info = world.bodies.info[body];
    auto made = std::make_shared<BodySurface>();
    make_surface(mesh, cast<Num>(info.center_B), to_num(info.R_BP), *made);
    store.hulls[effect] = std::move(made);
  }
  return *store.hulls[effect];
}

double shown_area(const BodySurface& surface, NumRotation q, NumVec direction) {
  const NumVec d = inverse_rotate(q, direction);
  double area = 0;
  for (const SurfacePanel& panel : surface.panels)
    area += std::max(0.0, dot(panel.normal, d)) * panel.area;
  for (const SurfaceBall& ball : surface.balls)
    area += std::numbers::pi * ball.radius * ball.radius;
  return area;
}

}  // namespace plumb::inline PLUMB_ABI::detail
