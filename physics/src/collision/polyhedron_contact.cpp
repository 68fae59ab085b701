#include "collision/polyhedron_contact.h"

namespace plumb::inline PLUMB_ABI::detail {

SegmentParameters line_parameters(const Segment& a, const Segment& b) {
  const NumVec da = a.end - a.start, db = b.end - b.start, r = a.start - b.start;
  const NumVec across = cross(da, db);
  const Num squared = dot(across, across);
  if (!(squared > Num(0))) return {Num(0.5), Num(0.5)};
  return {dot(cross(db, r), across) / squared, dot(cross(da, r), across) / squared};
}

bool edges_cross(const ContactAxis& axis) {
  const SegmentParameters at = line_parameters(axis.edge_a, axis.edge_b);
  const auto within = [](Num t) { return t >= -kAttained && t <= Num(1) + kAttained; };
  return within(at.a) && within(at.b);
}

ContactPoint edge_contact(const ContactAxis& axis) {
  const SegmentParameters at = line_parameters(axis.edge_a, axis.edge_b);
  const NumVec on_a = point_at(axis.edge_a, std::clamp(at.a, Num(0), Num(1)));
  const NumVec on_b = point_at(axis.edge_b, std::clamp(at.b, Num(0), Num(1)));
  return {Num(0.5) * (on_a + on_b), axis.separation, pair_name(axis.name_a, axis.name_b)};
}

}  // namespace plumb::inline PLUMB_ABI::detail
