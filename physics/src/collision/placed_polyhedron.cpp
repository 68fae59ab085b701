#include "collision/placed_polyhedron.h"

#include "collision/box_view.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Edge = PlacedPolyhedron::Edge;

constexpr std::array<Edge, 12> make_box_edges() {
  std::array<Edge, 12> edges{};
  for (std::uint32_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v0 = static_cast<std::uint32_t>(kBoxTables.face_vertices[k][i]);
      const auto v1 = static_cast<std::uint32_t>(kBoxTables.face_vertices[k][(i + 1) % 4]);
      Edge& edge = edges[static_cast<std::size_t>(kBoxTables.face_edges[k][i])];
      if (v0 < v1) {
        edge.v0 = v0;
        edge.v1 = v1;
        edge.face_a = k;
      } else {
        edge.face_b = k;
      }
    }
  }
  return edges;
}
constexpr std::array<Edge, 12> kBoxEdges = make_box_edges();

}  // namespace

void PlacedPolyhedron::place_box(const CollisionShape& shape, const NumMatrix& R, NumVec t) {
  hull_ = nullptr;
  edges_ = kBoxEdges.data();
  vertex_count_ = 8;
  face_count_ = 6;
  edge_count_ = 12;
  const NumVec half = to_num(shape.half);
  const BoxView box{t,
                    {{R.row0.x, R.row1.x, R.row2.x},
                     {R.row0.y, R.row1.y, R.row2.y},
                     {R.row0.z, R.row1.z, R.row2.z}},
                    half};
  centre_ = t;
  inner_radius_ = std::min(half.x, std::min(half.y, half.z));
  outer_radius_ = length(half);
  for (int i = 0; i < 8; ++i) set_vertex(i, box.vertex(i));
  for (int k = 0; k < 6; ++k) {
    const NumVec normal = (k % 2 == 0 ? Num(1) : Num(-1)) * box.axes[k / 2];
    set_face(k, normal, dot(normal, t) + component(half, k / 2));
  }
}

void PlacedPolyhedron::begin_hull(const CollisionShape& shape) {
  hull_ = shape.hull;
  vertex_count_ = static_cast<int>(hull_->vertices().size());
  face_count_ = static_cast<int>(hull_->face_count());
  edge_count_ = static_cast<int>(hull_->edges().size());
  edges_ = hull_->edges().data();
  inner_radius_ = static_cast<Num>(hull_->inner_radius());
  outer_radius_ = static_cast<Num>(hull_->outer_radius());
}

void PlacedPolyhedron::fill_up() {
  for (int i = vertex_count_; i < filled_up(vertex_count_); ++i) set_vertex(i, vertex(0));
  for (int k = face_count_; k < filled_up(face_count_); ++k)
    set_face(k, {0, 0, 0}, std::numeric_limits<Num>::max());
}

PlacedPolyhedron::PlacedPolyhedron(const CollisionShape& shape, const NumMatrix& R, NumVec t) {
  if (shape.type == ShapeType::Box) {
    place_box(shape, R, t);
  } else {
    begin_hull(shape);
    centre_ = R * to_num(hull_->interior_point()) + t;
    const Vec3* vertices = hull_->vertices().data();
    for (int i = 0; i < vertex_count_; ++i) set_vertex(i, R * to_num(vertices[i]) + t);
    const Vec3* normals = hull_->face_normals().data();
    const Real* offsets = hull_->face_offsets().data();
    for (int k = 0; k < face_count_; ++k) {
      const NumVec normal = R * to_num(normals[k]);
      set_face(k, normal, static_cast<Num>(offsets[k]) + dot(normal, t));
    }
  }
  fill_up();
}

PlacedPolyhedron::PlacedPolyhedron(const CollisionShape& shape) {
  if (shape.type == ShapeType::Box) {
    place_box(shape, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
  } else {
    begin_hull(shape);
    centre_ = to_num(hull_->interior_point());
    const Vec3* vertices = hull_->vertices().data();
    for (int i = 0; i < vertex_count_; ++i) set_vertex(i, to_num(vertices[i]));
    const Vec3* normals = hull_->face_normals().data();
    const Real* offsets = hull_->face_offsets().data();
    for (int k = 0; k < face_count_; ++k)
      set_face(k, to_num(normals[k]), static_cast<Num>(offsets[k]));
  }
  fill_up();
}

int PlacedPolyhedron::face_facing(NumVec d) const {
  const auto farthest = static_cast<std::uint32_t>(support_index(d));
  std::uint32_t facing = 0;
  Num best = Num(-2);
  for (int i = 0; i < edge_count_; ++i) {
    const Edge& e = edges_[i];
    if (e.v0 != farthest && e.v1 != farthest) continue;
    for (const std::uint32_t k : {e.face_a, e.face_b}) {
      const Num along = dot(normal(k), d);
      if (along > best) best = along, facing = k;
    }
  }
  return static_cast<int>(facing);
}

void PlacedPolyhedron::faces_facing(NumVec d, int (&out)[2]) const {
  const auto farthest = static_cast<std::uint32_t>(support_index(d));
  out[0] = out[1] = 0;
  Num least = std::numeric_limits<Num>::infinity();
  for (int i = 0; i < edge_count_; ++i) {
    const Edge& e = edges_[i];
    if (e.v0 != farthest && e.v1 != farthest) continue;
    const NumVec along = vertex(e.v1) - vertex(e.v0);
    const Num drop = std::abs(dot(along, d)) / length(along);
    if (drop < least) {
      least = drop;
      out[0] = static_cast<int>(e.face_a);
      out[1] = static_cast<int>(e.face_b);
    }
  }
}

Num PlacedPolyhedron::room_within(int face, NumVec point) const {
  const auto k = static_cast<std::size_t>(face);
  const NumVec n = normal(face);
  const std::size_t count = hull_ == nullptr ? 4 : hull_->face(k).size();
  const auto corner = [&](std::size_t i) {
    return hull_ == nullptr ? vertex(kBoxTables.face_vertices[k][i]) : vertex(hull_->face(k)[i]);
  };
  Num room = std::numeric_limits<Num>::infinity();
  NumVec from = corner(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const NumVec to = corner(i), side = to - from;
    room = std::min(room, dot(cross(n, side), point - from) / length(side));
    from = to;
  }
  return room;
}

void PlacedPolyhedron::face(int index, FacePolygon& out) const {
  const auto k = static_cast<std::size_t>(index);
  out.name = face_name(index);
  out.normal = normal(index);
  out.offset = offsets_[index];
  if (hull_ == nullptr) {
    out.count = 4;
    for (std::size_t i = 0; i < 4; ++i) {
      const int vertex = kBoxTables.face_vertices[k][i];
      out.points[i] = this->vertex(vertex);
      out.vertex_names[i] = vertex_name(vertex);
      out.edge_names[i] = edge_name(kBoxTables.face_edges[k][i]);
    }
    return;
  }
  const std::span<const std::uint32_t> loop = hull_->face(k), edges = hull_->face_edges(k);
  out.count = static_cast<int>(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    out.points[i] = vertex(loop[i]);
    out.vertex_names[i] = vertex_name(static_cast<int>(loop[i]));
    out.edge_names[i] = edge_name(static_cast<int>(edges[i]));
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
