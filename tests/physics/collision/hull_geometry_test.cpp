// Invariant: HullGeometry::create takes exactly the closed convex polyhedra, says what is wrong
// with everything else, and what it derives (planes, edges, centroid, radii) is that of the
// polyhedron.
#include <gtest/gtest.h>

#include <cstring>

#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

constexpr Real kEps = std::numeric_limits<Real>::epsilon();

struct Input {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> sizes, loops;
  [[nodiscard]] HullGeometry::Result create() const {
    return HullGeometry::create(vertices, sizes, loops);
  }
};

Input cube(Real half, Vec3 centre = Vec3::Zero()) {
  Input in;
  for (int i = 0; i < 8; ++i) {
    in.vertices.push_back(
        centre + half * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  }
  in.sizes.assign(6, 4);
  in.loops = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  return in;
}

void expect_refused(const Input& in, const char* part_of_message) {
  const HullGeometry::Result result = in.create();
  EXPECT_EQ(result.hull, nullptr);
  EXPECT_FALSE(result.status.ok());
  EXPECT_NE(std::strstr(result.status.message, part_of_message), nullptr) << result.status.message;
}

TEST(HullGeometry, ACubeHasItsPlanesEdgesAndRadii) {
  for (const Real half : {Real(1e-3), Real(1), Real(1e4)}) {
    const Vec3 centre(3 * half, -2 * half, half);
    const auto result = cube(half, centre).create();
    ASSERT_TRUE(result.status.ok()) << result.status.message;
    const HullGeometry& hull = *result.hull;
    EXPECT_EQ(hull.face_count(), 6U);
    EXPECT_EQ(hull.edges().size(), 12U);
    EXPECT_LT((hull.interior_point() - centre).norm(), 8 * kEps * half);
    EXPECT_NEAR(hull.inner_radius(), half, 8 * kEps * half);  // coordinates are 4 half out
    EXPECT_NEAR(hull.outer_radius(), std::sqrt(Real(3)) * half, 8 * kEps * half);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(hull.face_normals()[k].norm(), Real(1), 2 * kEps);
      for (const std::uint32_t v : hull.face(k)) {
        EXPECT_NEAR(hull.face_normals()[k].dot(hull.vertices()[v]), hull.face_offsets()[k],
                    8 * kEps * half);
      }
      // Each side of a face is the edge that its place in the list names.
      for (std::size_t i = 0; i < 4; ++i) {
        const HullGeometry::Edge& e = hull.edges()[hull.face_edges(k)[i]];
        const std::uint32_t a = hull.face(k)[i], b = hull.face(k)[(i + 1) % 4];
        EXPECT_TRUE((e.face_a == k && e.v0 == a && e.v1 == b) ||
                    (e.face_b == k && e.v0 == b && e.v1 == a));
      }
    }
  }
}

TEST(HullGeometry, CentroidOfATetrahedronIsTheMeanOfItsCorners) {
  Input in;
  in.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)};
  in.sizes.assign(4, 3);
  in.loops = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const auto result = in.create();
  ASSERT_TRUE(result.status.ok()) << result.status.message;
  EXPECT_LT((result.hull->interior_point() - Vec3(Real(0.25), Real(0.5), Real(0.75))).norm(),
            4 * kEps);
}

TEST(HullGeometry, UnevenFacesAreTakenToAThousandthOfTheWidthAndHeldByTheirPlanes) {
  Input in = cube(1);
  in.vertices[7] += Vec3(Real(5e-4), Real(5e-4), Real(5e-4));
  const auto result = in.create();
  ASSERT_TRUE(result.status.ok()) << result.status.message;
  for (std::size_t k = 0; k < 6; ++k) {
    for (const Vec3& v : in.vertices) {
      EXPECT_LE(result.hull->face_normals()[k].dot(v), result.hull->face_offsets()[k] + 4 * kEps);
    }
  }
  in.vertices[7] += Vec3(Real(0.02), Real(0.02), Real(0.02));
  expect_refused(in, "convex");
}

TEST(HullGeometry, EverythingElseIsRefusedWithAReason) {
  Input in = cube(1);
  in.vertices[3].x() = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_EQ(in.create().status.code, StatusCode::NotFinite);
  in = cube(1);
  in.loops[5] = 99;
  expect_refused(in, "does not exist");
  in = cube(1);
  in.sizes.pop_back();
  expect_refused(in, "add up");
  in = cube(1);  // open
  in.sizes.pop_back();
  in.loops.resize(20);
  expect_refused(in, "exactly two faces");
  in = cube(1);  // one face turned over
  std::reverse(in.loops.begin(), in.loops.begin() + 4);
  expect_refused(in, "opposite directions");
  in = cube(1);  // inside out
  for (int k = 0; k < 6; ++k) std::reverse(in.loops.begin() + 4 * k, in.loops.begin() + 4 * k + 4);
  expect_refused(in, "counter-clockwise");
  in = cube(1);  // flat
  for (Vec3& v : in.vertices) v.y() = 0;
  EXPECT_FALSE(in.create().status.ok());
  in = cube(1);  // an unused vertex
  in.vertices.push_back(Vec3::Zero());
  expect_refused(in, "at least three faces");
  in = cube(1);  // two cubes in one
  const Input other = cube(1, Vec3(5, 0, 0));
  for (const Vec3& v : other.vertices) in.vertices.push_back(v);
  for (const std::uint32_t v : other.loops) in.loops.push_back(v + 8);
  in.sizes.assign(12, 4);
  expect_refused(in, "one closed surface");
  in = cube(1);  // pushed in at a corner
  in.vertices[7] = Vec3(Real(0.2), Real(0.2), Real(0.2));
  expect_refused(in, "convex");
  expect_refused({}, "at least 4");
}

TEST(HullGeometry, TooManyCornersAreRefusedAndTheLimitIsNot) {
  EXPECT_NE(oracle::prism(detail::kMaxFaceVertices, 1, 1), nullptr);
  EXPECT_EQ(oracle::prism(detail::kMaxFaceVertices + 1, 1, 1), nullptr);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
