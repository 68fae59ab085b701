// Collision shapes. Every shape is given in its collider's frame.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "plumb/heightfield.h"
#include "plumb/math.h"
#include "plumb/status.h"
#include "plumb/triangle_mesh.h"

namespace plumb::inline PLUMB_ABI {

struct Sphere {
  Real radius = Real(0.5);  // [m] > 0
};

// Rounding: box, cylinder, cone and hull may be grown by a ball of radius `rounding`, as a capsule
// is a segment grown by its radius. The other sizes name the sharp core; the ball is added outside
// of it, so that the total size is larger by `rounding` on every side (a Box{(1, 1, 1), 0.1}
// reaches from -1.1 to 1.1 m). 0: sharp edges. All answers are those of the grown shape, exactly.

struct Box {
  Vec3 half_extents = Vec3::Constant(Real(0.5));  // [m] > 0 each, of the core
  Real rounding = Real(0);                        // [m] >= 0, added outside
};

// A segment along the local y axis, from -half_length to +half_length, grown by a radius.
struct Capsule {
  Real half_length = Real(0.5);  // [m] > 0
  Real radius = Real(0.25);      // [m] > 0
};

// A solid cylinder about the local y axis, its flat ends in the planes y = -half_length and
// y = +half_length. Truly round: it has no corners.
struct Cylinder {
  Real half_length = Real(0.5);  // [m] > 0, of the core
  Real radius = Real(0.5);       // [m] > 0, of the core
  Real rounding = Real(0);       // [m] >= 0, added outside
};

// A solid cone about the local y axis. The origin lies on the axis, midway between base and apex:
// the base disc is in the plane y = -half_length, the apex at (0, +half_length, 0). The height is
// 2 half_length; the centre of mass (without rounding) at (0, -half_length / 2, 0).
struct Cone {
  Real half_length = Real(0.5);  // [m] > 0, of the core
  Real radius = Real(0.5);       // [m] > 0, of the core's base
  Real rounding = Real(0);       // [m] >= 0, added outside
};

// Everything with normal . x <= offset is solid. Only for static bodies.
struct HalfSpace {
  Vec3 normal = Vec3::UnitY();  // outward, any length > 0
  Real offset = Real(0);        // [m]
};

// A closed convex polyhedron: vertices and outward polygon faces, checked once when it is made,
// then shared by any number of colliders. Hulls of points are built by plumb::assets.
class HullGeometry {
 public:
  struct Edge {
    std::uint32_t v0, v1;  // vertices; face_a has the edge as v0 -> v1
    std::uint32_t face_a, face_b;
  };

  // vertices: [m] finite, each used by at least three faces. face_sizes[k] vertices of
  // face k stand one after the other in face_vertices, counter-clockwise seen from outside.
  // Coplanarity and convexity are accepted to 1e-3 of the hull's smallest width.
  struct Result {
    std::shared_ptr<const HullGeometry> hull;
    Status status;
  };
  static Result create(std::span<const Vec3> vertices, std::span<const std::uint32_t> face_sizes,
                       std::span<const std::uint32_t> face_vertices);
  // The same hull stretched along its axes by factors > 0 [-].
  [[nodiscard]] Result scaled(const Vec3& factors) const;

  [[nodiscard]] const std::vector<Vec3>& vertices() const { return vertices_; }
  [[nodiscard]] std::size_t face_count() const { return face_normals_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> face(std::size_t k) const {
    return std::span(face_vertices_)
        .subspan(face_starts_[k], face_starts_[k + 1] - face_starts_[k]);
  }
  // The edges of a face: the k-th joins its k-th vertex to the next.
  [[nodiscard]] std::span<const std::uint32_t> face_edges(std::size_t k) const {
    return std::span(face_edges_).subspan(face_starts_[k], face_starts_[k + 1] - face_starts_[k]);
  }
  [[nodiscard]] const std::vector<Vec3>& face_normals() const {
    return face_normals_;
  }  // outward, unit
  [[nodiscard]] const std::vector<Real>& face_offsets() const { return face_offsets_; }  // [m]
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] const Vec3& interior_point() const { return interior_point_; }  // [m] centroid
  [[nodiscard]] Real inner_radius() const {
    return inner_radius_;
  }  // [m] distance centroid to nearest face
  [[nodiscard]] Real outer_radius() const {
    return outer_radius_;
  }  // [m] distance centroid to farthest vertex

 private:
  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> face_starts_, face_vertices_, face_edges_;
  std::vector<Vec3> face_normals_;
  std::vector<Real> face_offsets_;
  std::vector<Edge> edges_;
  Vec3 interior_point_ = Vec3::Zero();
  Real inner_radius_ = 0, outer_radius_ = 0;
};

struct ConvexHull {
  std::shared_ptr<const HullGeometry> geometry;
  Real rounding = Real(0);  // [m] >= 0, added outside
};

// A surface, not a solid: what is behind it is not pushed out but near the surface. Only for static
// and kinematic bodies.
struct SurfaceMesh {
  std::shared_ptr<const TriangleMeshGeometry> geometry;
  Vec3 scale = Vec3::Ones();  // [-] > 0 each, along the mesh's own axes
};

struct Heightfield {
  std::shared_ptr<const HeightfieldGeometry> geometry;
};

// Several convex shapes as one (plumb/compound.h).
class CompoundGeometry;
struct Compound {
  std::shared_ptr<const CompoundGeometry> geometry;
};

// Recordings and snapshots name a shape by its place in this list: new ones go to the end.
using Shape = std::variant<Sphere, Box, Capsule, ConvexHull, HalfSpace, SurfaceMesh, Heightfield,
                           Compound, Cylinder, Cone>;

}  // namespace plumb::inline PLUMB_ABI
