// Invariant: the certificate calls a mesh solid exactly if it bounds a solid, says what is wrong if
// it does not, and names a remedy that works; nothing is repaired unless repair is asked to.
#include "plumb/assets/certificate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "plumb/assets/mass.h"
#include "plumb/assets/repair.h"
#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets;

bool has_fault(const MeshCertificate& certificate, const std::string& words) {
  return std::any_of(certificate.findings.begin(), certificate.findings.end(),
                     [&](const Finding& finding) {
                       return finding.kind == Finding::Kind::Fault &&
                              finding.text.find(words) != std::string::npos;
                     });
}

void expect_solid_refuses(const TriangleMesh& mesh) {
  const Result<MeshMass> mass = mass_of_mesh(mesh);
  EXPECT_FALSE(mass.ok());
  EXPECT_NE(mass.error().find("remedy"), std::string::npos) << mass.error();
}

// --- Good meshes -------------------------------------------------------------------------------

TEST(Certificate, BoxIsASolidOfGenusZero) {
  const MeshCertificate c = certify(box_mesh({1, 2, 3}));
  EXPECT_TRUE(c.solid) << c.fault_text();
  EXPECT_TRUE(c.closed && c.consistently_oriented && c.manifold && c.orientable);
  EXPECT_EQ(c.euler_characteristic, 2);
  EXPECT_EQ(c.genus, 0);
  EXPECT_EQ(c.components, 1u);
  EXPECT_EQ(c.edges, 18u);
  EXPECT_EQ(c.embedding, Embedding::Clean);
  EXPECT_EQ(c.winding_min, 0);
  EXPECT_EQ(c.winding_max, 1);
  EXPECT_NEAR(c.area, 88, 1e-12);
  EXPECT_NEAR(c.signed_volume, 48, 1e-12);
}

TEST(Certificate, TorusHasOneHandle) {
  const MeshCertificate c = certify(torus_mesh(1, 0.3, 12));
  EXPECT_TRUE(c.solid) << c.fault_text();
  EXPECT_EQ(c.euler_characteristic, 0);
  EXPECT_EQ(c.genus, 1);
}

// Flat regions, shared edges and coordinates that doubles cannot hold must not look like crossings,
// wherever and however the mesh stands.
TEST(Certificate, TurnedMeshesStayClean) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    const Vector3d offset = 1000 * Vector3d(any(random), any(random), any(random));
    for (TriangleMesh mesh : {l_beam_mesh(0.6, 0.12, 0.15, 0.8, 0.2), torus_mesh(1, 0.3, 8),
                              cylinder_mesh(1, 0.01, 12)}) {
      for (Vector3d& v : mesh.vertices) v = turn * v + offset;
      const MeshCertificate c = certify(mesh);
      EXPECT_TRUE(c.solid) << mesh.name << ": " << c.fault_text();
      EXPECT_EQ(c.embedding, Embedding::Clean) << mesh.name;
    }
  }
}

TEST(Certificate, TwoSeparateBodiesAreOneSolid) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  join(mesh, box_mesh({1, 1, 1}, {5, 0, 0}));
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.solid) << c.fault_text();
  EXPECT_EQ(c.components, 2u);
  EXPECT_EQ(c.genus, 0);
}

// Stacked boxes share a piece of plane; they touch, and the volume is counted right.
TEST(Certificate, TouchingBoxesAreASolid) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  join(mesh, box_mesh({1, 1, 1}, {0.5, 2, 0.25}));
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.solid) << c.fault_text();
  EXPECT_EQ(c.embedding, Embedding::Touching);
  EXPECT_GT(c.touching_pairs, 0u);
}

// --- The seven bad meshes ----------------------------------------------------------------------

TEST(BadMesh, ZeroAreaFacesAreCountedAndHarmless) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles.push_back({3, 3, 5});  // a repeated corner
  MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.degenerate_faces, 1u);
  EXPECT_TRUE(c.solid) << c.fault_text();  // its sides cancel

  // A flat face hanging on an edge opens the surface; repair takes it away.
  mesh = box_mesh({1, 1, 1});
  mesh.vertices.push_back(0.5 * mesh.vertices[0] + 0.5 * mesh.vertices[1]);
  mesh.triangles.push_back({0, 8, 1});
  c = certify(mesh);
  EXPECT_EQ(c.degenerate_faces, 1u);
  EXPECT_TRUE(has_fault(c, "open"));
  const Result<Repaired> repaired = repair(mesh);
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(repaired->dropped_degenerate, 1u);
  EXPECT_TRUE(certify(repaired->mesh).solid);
}

TEST(BadMesh, DuplicateVerticesCountAsOnePlace) {
  TriangleMesh soup;
  const TriangleMesh box = box_mesh({1, 1, 1});
  for (const Triangle& t : box.triangles) {
    const auto base = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(box.vertices[v]);
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  const MeshCertificate c = certify(soup);
  EXPECT_EQ(c.duplicate_vertices, 28u);
  EXPECT_EQ(c.surface_vertices, 8u);
  EXPECT_TRUE(c.solid) << c.fault_text();

  // Vertices that only nearly meet leave cracks; the certificate names a weld that closes them.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  for (Vector3d& v : soup.vertices) v += Vector3d(noise(random), noise(random), noise(random));
  const MeshCertificate cracked = certify(soup);
  EXPECT_FALSE(cracked.closed);
  EXPECT_NE(cracked.fault_text().find("weld_tolerance"), std::string::npos) << cracked.fault_text();
  const Result<Repaired> welded = repair(soup, {.weld_tolerance = 1e-6});
  ASSERT_TRUE(welded.ok());
  EXPECT_EQ(welded->welded_vertices, 28u);
  EXPECT_TRUE(certify(welded->mesh).solid) << certify(welded->mesh).fault_text();
}

TEST(BadMesh, NotANumberIsAFault) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = box_mesh({1, 1, 1});
    mesh.vertices[5].y() = bad;
    const MeshCertificate c = certify(mesh);
    EXPECT_EQ(c.non_finite_vertices, 1u);
    EXPECT_TRUE(has_fault(c, "not finite"));
    EXPECT_FALSE(c.solid);
    EXPECT_TRUE(c.bounds.size().allFinite());
    expect_solid_refuses(mesh);
    for (const MassMethod method : {MassMethod::Shell, MassMethod::Hull, MassMethod::Voxel}) {
      EXPECT_FALSE(mass_of_mesh(mesh, {.method = method, .shell_thickness = 0.1}).ok());
    }
    EXPECT_FALSE(repair(mesh).ok());
  }
}

TEST(BadMesh, IndexBeyondTheArrayIsAFault) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles[3][1] = 1000;
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.out_of_range_triangles, 1u);
  EXPECT_FALSE(c.solid);
  expect_solid_refuses(mesh);
  EXPECT_FALSE(repair(mesh).ok());
}

TEST(BadMesh, OpenSurfaceIsAFault) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.boundary_edges, 3u);
  EXPECT_FALSE(c.closed);
  EXPECT_FALSE(c.genus.has_value());
  EXPECT_TRUE(has_fault(c, "open"));
  expect_solid_refuses(mesh);
}

TEST(BadMesh, InsideOutIsAFaultThatRepairTurns) {
  const TriangleMesh mesh = flipped(torus_mesh(1, 0.3, 10));
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.inside_out);
  EXPECT_LT(c.signed_volume, 0);
  EXPECT_TRUE(has_fault(c, "inside out"));
  expect_solid_refuses(mesh);
  const Result<Repaired> repaired = repair(mesh, {.orient = true});
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(repaired->flipped_faces, mesh.triangles.size());
  EXPECT_TRUE(certify(repaired->mesh).solid);
}

TEST(BadMesh, DisagreeingFacesAreAFaultThatRepairTurns) {
  TriangleMesh mesh = sphere_mesh(1, 8);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.closed);
  EXPECT_FALSE(c.consistently_oriented);
  EXPECT_TRUE(c.orientable);
  expect_solid_refuses(mesh);
  EXPECT_FALSE(mass_of_mesh(mesh, {.method = MassMethod::Voxel}).ok());
  const Result<Repaired> repaired = repair(mesh, {.orient = true});
  ASSERT_TRUE(repaired.ok());
  EXPECT_TRUE(certify(repaired->mesh).solid);
}

TEST(BadMesh, NonManifoldEdgeIsSeen) {
  // Two boxes that share one edge: crowded, yet the boundary of a body.
  TriangleMesh mesh = box_mesh({1, 1, 1});
  join(mesh, box_mesh({1, 1, 1}, {2, 2, 0}));
  MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.non_manifold_edges, 1u);
  EXPECT_FALSE(c.manifold);
  EXPECT_FALSE(c.genus.has_value());
  EXPECT_TRUE(c.solid) << c.fault_text();
  EXPECT_NEAR(c.signed_volume, 16, 1e-12);

  // A fin on an edge is not part of any body.
  mesh = box_mesh({1, 1, 1});
  mesh.vertices.push_back({3, 3, 3});
  mesh.triangles.push_back({3, 7, 8});
  c = certify(mesh);
  EXPECT_EQ(c.non_manifold_edges, 1u);
  EXPECT_FALSE(c.solid);
  expect_solid_refuses(mesh);
}

TEST(BadMesh, NonManifoldVertexIsSeen) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  join(mesh, box_mesh({1, 1, 1}, {2, 2, 2}));
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.non_manifold_vertices, 1u);
  EXPECT_EQ(c.non_manifold_edges, 0u);
  EXPECT_TRUE(c.solid) << c.fault_text();
}

TEST(BadMesh, SelfCrossingIsAFault) {
  TriangleMesh mesh = sphere_mesh(1, 10);
  join(mesh, translated(sphere_mesh(1, 10), {0.813, 0.3, 0.1}));
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.embedding, Embedding::Crossing);
  EXPECT_GT(c.crossing_pairs, 10u);
  EXPECT_FALSE(c.crossing_examples.empty());
  EXPECT_TRUE(has_fault(c, "through each other"));
  expect_solid_refuses(mesh);
}

// One surface that runs through itself: the Lawson-like figure of eight, swept round.
TEST(BadMesh, FigureOfEightCrossesItself) {
  TriangleMesh mesh = sphere_mesh(1, 16);
  for (Vector3d& v : mesh.vertices)
    v.x() += 1.4 * v.y() * v.y() * (v.x() > 0 ? -1 : 1) * std::abs(v.x());
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.closed);
  EXPECT_EQ(c.embedding, Embedding::Crossing);
  EXPECT_FALSE(c.solid);
}

// Boxes on a grid cross without any edge running through the inside of a face; the winding number
// still sees the overlap.
TEST(BadMesh, OverlapOfAlignedBoxesIsAFault) {
  for (const Vector3d& offset :
       {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 0, 0.5), Vector3d(1, 1, 1)}) {
    TriangleMesh mesh = box_mesh({1, 1, 1});
    join(mesh, box_mesh({1, 1, 1}, offset));
    const MeshCertificate c = certify(mesh);
    EXPECT_FALSE(c.solid) << offset.transpose();
    EXPECT_EQ(c.winding_max, 2) << offset.transpose();
  }
}

TEST(BadMesh, BodyInsideABodyIsAFault) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  join(mesh, box_mesh({0.2, 0.2, 0.2}));
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.embedding, Embedding::Clean);
  EXPECT_EQ(c.winding_max, 2);
  EXPECT_TRUE(has_fault(c, "contain each other"));
  const Result<Repaired> repaired =
      repair(mesh, {.orient = true});  // named as making a cavity of it
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(certify(repaired->mesh).cavities, 1u);
}

TEST(BadMesh, DuplicateFacesAreFoundAndDropped) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles.push_back({mesh.triangles[0][1], mesh.triangles[0][2], mesh.triangles[0][0]});
  const MeshCertificate c = certify(mesh);
  EXPECT_EQ(c.duplicate_faces, 1u);
  EXPECT_FALSE(c.solid);
  const Result<Repaired> repaired = repair(mesh);
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(repaired->dropped_duplicate, 1u);
  EXPECT_TRUE(certify(repaired->mesh).solid);
}

TEST(BadMesh, MoebiusStripIsNotOrientable) {
  TriangleMesh mesh;
  constexpr std::uint32_t n = 24;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * kPi * k / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(angle / 2);
      mesh.vertices.emplace_back(r * std::cos(angle), side * std::sin(angle / 2),
                                 r * std::sin(angle));
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const bool last = k + 1 == n;
    const std::uint32_t a = 2 * k, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  const MeshCertificate certificate = certify(mesh);
  EXPECT_FALSE(certificate.orientable);
  EXPECT_FALSE(certificate.solid);
}

TEST(BadMesh, FlatClosedSurfaceEnclosesNothing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  const MeshCertificate c = certify(mesh);
  EXPECT_TRUE(c.closed);
  EXPECT_TRUE(has_fault(c, "no volume"));
  EXPECT_FALSE(certify(TriangleMesh{}).solid);
}

// A soup of triangles that all overlap must not take for ever: the count stops at its limit.
TEST(BadMesh, CountOfCrossingsStopsAtItsLimit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  TriangleMesh soup;
  for (std::uint32_t k = 0; k < 3000; ++k) {
    for (int i = 0; i < 3; ++i) soup.vertices.emplace_back(any(random), any(random), any(random));
    soup.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const MeshCertificate c = certify(soup, {.max_crossing_pairs = 1000});
  EXPECT_EQ(c.crossing_pairs, 1000u);
  EXPECT_FALSE(c.crossing_count_complete);
}

}  // namespace
}  // namespace plumb::test
