#include "collision/convex_core.h"

namespace plumb::inline PLUMB_ABI::detail {

ConvexCore::ConvexCore(const Placed& placed, const PlacedPolyhedron* polyhedron)
    : shape_(placed.shape),
      polyhedron_(polyhedron),
      p_(placed.p),
      half_(to_num(placed.shape.half)),
      rows_(to_matrix(placed.q)) {
  axis_ = {rows_.row0.y, rows_.row1.y, rows_.row2.y};
  centre_ = p_;
  const Num rounding = static_cast<Num>(shape_.radius);
  if (polyhedron_ != nullptr) {
    centre_ = polyhedron_->centre();
    outer_ = polyhedron_->outer_radius();
    thin_ = polyhedron_->inner_radius() + rounding;
    return;
  }
  outer_ = std::sqrt(half_.x * half_.x + half_.y * half_.y);
  thin_ = rounding;
  if (shape_.type == ShapeType::Cylinder) thin_ += std::min(half_.x, half_.y);
  if (shape_.type == ShapeType::Cone) {
    const Num inner = cone_inner_radius(half_);
    thin_ += inner;
    centre_ = p_ + (inner - half_.y) * axis_;
    const Num below = inner, above = Num(2) * half_.y - inner;
    outer_ = std::max(above, std::sqrt(below * below + half_.x * half_.x));
  }
}

void ConvexCore::feature_facing(NumVec n, FacePolygon& polygon, SupportFeature& out) const {
  out = {};
  out.out = n;
  if (polyhedron_ != nullptr) {
    const int face = polyhedron_->face_facing(n);
    if (dot(polyhedron_->normal(face), n) < kSteepFace) {
      out.name = vertex_name(polyhedron_->support_index(n));
      return;
    }
    polyhedron_->face(face, polygon);
    out.kind = SupportFeature::Kind::Polygon;
    out.name = polygon.name;
    out.normal = polygon.normal;
    out.offset = polygon.offset;
    out.polygon = &polygon;
    return;
  }
  if (is_curved(shape_.type)) {
    round_feature(n, out);
    return;
  }
  if (!(half_.y > Num(0))) return;
  out.kind = SupportFeature::Kind::Segment;
  out.name = face_name(0);
  out.segment = {p_ - half_.y * axis_, p_ + half_.y * axis_};
  out.ends[0] = vertex_name(0);
  out.ends[1] = vertex_name(1);
  out.bend = shape_.radius;
}

void ConvexCore::round_feature(NumVec n, SupportFeature& out) const {
  const Num along = dot(n, axis_);
  const NumVec aside = n - along * axis_;
  const NumVec spoke{rows_.row0.x, rows_.row1.x, rows_.row2.x};
  // Along the axis no generator is farther out than another, and what is left of n is rounding.
  const bool end_on = !(length_squared(aside) > kParallelSine * kParallelSine);
  const NumVec radial = end_on ? spoke : normalized_or(aside, spoke);
  const Num across = dot(n, radial);
  const bool cone = shape_.type == ShapeType::Cone;
  // How well the side (at its best generator) and the flat end look along n.
  Num side = across, end = std::abs(along);
  if (cone) {
    const Num height = Num(2) * half_.y;
    side = (height * across + half_.x * along) / std::sqrt(height * height + half_.x * half_.x);
    end = -along;
  }
  if (end >= side) {
    const Num up = along < Num(0) ? Num(-1) : Num(1);
    out.kind = SupportFeature::Kind::Disc;
    out.name = face_name(up < Num(0) ? 0 : 1);
    out.normal = up * axis_;
    out.centre = p_ + (up * half_.y) * axis_;
    out.offset = dot(out.normal, out.centre);
    out.radius = half_.x;
    out.spoke = spoke;
    return;
  }
  const NumVec base = p_ - half_.y * axis_ + half_.x * radial;
  out.kind = SupportFeature::Kind::Segment;
  out.name = face_name(kSideFace);
  out.segment = {base, cone ? p_ + half_.y * axis_ : base + (Num(2) * half_.y) * axis_};
  out.ends[0] = vertex_name(kGeneratorVertex);
  out.ends[1] = vertex_name(kGeneratorVertex + 1);
  if (!cone) out.bend = half_.x + static_cast<Num>(shape_.radius);
}

}  // namespace plumb::inline PLUMB_ABI::detail
