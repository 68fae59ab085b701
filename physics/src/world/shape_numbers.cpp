#include "world/shape_numbers.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct ToNumbers {
  ShapeNumbers& s;
  const Shape& shape;
  HullList& hulls;
  GeometryTable& geometries;

  void set(Real a, Real b = 0, Real c = 0, Real d = 0) const {
    s.n[0] = static_cast<double>(a), s.n[1] = static_cast<double>(b);
    s.n[2] = static_cast<double>(c), s.n[3] = static_cast<double>(d);
  }
  void operator()(const Sphere& x) const { set(x.radius); }
  void operator()(const Box& x) const {
    set(x.half_extents.x(), x.half_extents.y(), x.half_extents.z(), x.rounding);
  }
  void operator()(const Capsule& x) const { set(x.half_length, x.radius); }
  void operator()(const ConvexHull& x) const {
    set(x.rounding);
    std::size_t k = 0;
    while (k < hulls.size() && hulls[k] != x.geometry) ++k;
    if (k == hulls.size()) hulls.push_back(x.geometry);
    s.hull = static_cast<std::uint32_t>(k);
  }
  void operator()(const HalfSpace& x) const {
    set(x.normal.x(), x.normal.y(), x.normal.z(), x.offset);
  }
  void operator()(const SurfaceMesh&) const { s.hull = geometries.add(shape, s.n); }
  void operator()(const Heightfield&) const { s.hull = geometries.add(shape, s.n); }
  void operator()(const Compound&) const { s.hull = geometries.add(shape, s.n); }
  void operator()(const Cylinder& x) const { set(x.half_length, x.radius, x.rounding); }
  void operator()(const Cone& x) const { set(x.half_length, x.radius, x.rounding); }
};

}  // namespace

ShapeNumbers numbers_of(const Shape& shape, HullList& hulls, GeometryTable& geometries) {
  ShapeNumbers s;
  s.type = static_cast<std::uint32_t>(shape.index());
  std::visit(ToNumbers{s, shape, hulls, geometries}, shape);
  return s;
}

bool shape_from(const ShapeNumbers& s, const HullList& hulls, const GeometryTable& geometries,
                Shape& out) {
  const auto real = [&](int i) { return static_cast<Real>(s.n[i]); };
  switch (s.type) {
    case 0:
      out = Sphere{real(0)};
      return true;
    case 1:
      out = Box{Vec3(real(0), real(1), real(2)), real(3)};
      return true;
    case 2:
      out = Capsule{real(0), real(1)};
      return true;
    case 3:
      if (s.hull >= hulls.size()) return false;
      out = ConvexHull{hulls[s.hull], real(0)};
      return true;
    case 4:
      out = HalfSpace{Vec3(real(0), real(1), real(2)), real(3)};
      return true;
    case 8:
      out = Cylinder{real(0), real(1), real(2)};
      return true;
    case 9:
      out = Cone{real(0), real(1), real(2)};
      return true;
    default:
      return geometries.take(s.hull, s.type, s.n, out);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
