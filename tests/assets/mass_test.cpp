// Invariant: the mass properties of a polyhedron are exact to rounding wherever it stands, those of
// curved bodies converge to the closed forms with order 2, and no method is ever swapped for
// another.
#include "plumb/assets/mass.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets;
using Eigen::Matrix3d;

// Unit density unless said otherwise.
MeshMass must(const TriangleMesh& mesh, MassOptions options = {.density = 1}) {
  const Result<MeshMass> mass = mass_of_mesh(mesh, options);
  EXPECT_TRUE(mass.ok()) << mass.error();
  return mass.ok() ? *mass : MeshMass{};
}

double relative(double value, double wanted) { return std::abs(value - wanted) / std::abs(wanted); }
double relative(const Matrix3d& value, const Matrix3d& wanted) {
  return (value - wanted).norm() / wanted.norm();
}

Matrix3d inertia_from_second(const Matrix3d& second) {
  return second.trace() * Matrix3d::Identity() - second;
}

// --- Tonon's tetrahedron [Tonon 2004] ----------------------------------------------------------

const std::array<Vector3d, 4> kTonon{Vector3d(8.33220, -11.86875, 0.93355),
                                     Vector3d(0.75523, 5, 16.37072),
                                     Vector3d(52.61236, 5, -5.38580), Vector3d(2, 5, 3)};

TriangleMesh tonon_mesh() { return tetrahedron_mesh(kTonon[0], kTonon[1], kTonon[2], kTonon[3]); }

TEST(TononTetrahedron, MatchesThePublishedDigits) {
  const MeshMass mass = must(tonon_mesh());
  // Half a unit in the last digit printed.
  EXPECT_NEAR(mass.volume, 1873.233364216, 5e-10);
  EXPECT_NEAR((mass.center - Vector3d(15.9249475, 0.7828125, 3.7296175)).cwiseAbs().maxCoeff(), 0,
              5e-8);
  const Matrix3d& I = mass.I_Bcm_B;
  EXPECT_NEAR(I(0, 0), 43520.33329, 5e-6);
  EXPECT_NEAR(I(1, 1), 194711.29259, 5e-6);
  EXPECT_NEAR(I(2, 2), 191168.76489, 5e-6);
  EXPECT_NEAR(I(0, 1), -11996.20139, 5e-6);
  EXPECT_NEAR(I(0, 2), 46343.16738, 5e-6);
  EXPECT_NEAR(I(1, 2), -4417.66157, 5e-6);
}

// The corner formula in extended precision, nothing in common with sums over faces:
// second moments about the centre = V / 20 * sum of (v - c)(v - c)^T.
TEST(TononTetrahedron, EqualsTheCornerFormulaTo1e12) {
  using LongVector = Eigen::Matrix<long double, 3, 1>;
  using LongMatrix = Eigen::Matrix<long double, 3, 3>;
  std::array<LongVector, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = kTonon[i].cast<long double>();
  const LongVector center = (v[0] + v[1] + v[2] + v[3]) / 4;
  const long double volume = std::abs((v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0])) / 6;
  LongMatrix second = LongMatrix::Zero();
  for (const LongVector& corner : v)
    second += volume / 20 * (corner - center) * (corner - center).transpose();

  const MeshMass mass = must(tonon_mesh());
  EXPECT_LE(relative(mass.volume, static_cast<double>(volume)), 1e-12);
  EXPECT_LE((mass.center - center.cast<double>()).norm() / center.cast<double>().norm(), 1e-12);
  EXPECT_LE(relative(mass.I_Bcm_B, inertia_from_second(second.cast<double>())), 1e-12);
  EXPECT_LT(mass.error.volume, 1e-12);
}

TEST(TononTetrahedron, Keeps1e9WhenMovedByTenThousandSizes) {
  const MeshMass here = must(tonon_mesh());
  const double size = bounds_of(tonon_mesh()).diagonal();
  for (const Vector3d& direction :
       {Vector3d(1, 0, 0), Vector3d(-1, 1, 1), Vector3d(0.3, -2, 0.7)}) {
    const Vector3d offset = 1e4 * size * direction;
    const MeshMass there = must(translated(tonon_mesh(), offset));
    EXPECT_LE(relative(there.volume, here.volume), 1e-9);
    EXPECT_LE((there.center - offset - here.center).norm() / size, 1e-9);
    EXPECT_LE(relative(there.I_Bcm_B, here.I_Bcm_B), 1e-9);
    // The bound it reports must hold and must not be idle talk.
    EXPECT_LE(relative(there.volume, here.volume), there.error.volume);
    EXPECT_LE((there.center - offset - here.center).norm(), there.error.center);
    EXPECT_LT(there.error.volume, 1e-9);
  }
}

// --- Bodies with flat faces: exact -------------------------------------------------------------

TEST(PolyhedronMass, BoxHasItsClosedForm) {
  const Vector3d half(0.5, 1, 2), center(3, -2, 1);
  const MeshMass mass = must(box_mesh(half, center), {.density = 7});
  const double m = 7 * 8 * half.prod();
  EXPECT_LE(relative(mass.mass, m), 1e-14);
  EXPECT_LE((mass.center - center).norm(), 1e-14);
  const Vector3d s = half.cwiseProduct(half) / 3;
  const Matrix3d wanted = (m * Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y())).asDiagonal();
  EXPECT_LE(relative(mass.I_Bcm_B, wanted), 1e-14);
  EXPECT_EQ(mass.R_BP.cwiseAbs().sum(),
            3);  // three entries of +-1: no noise spins the axes of a box
}

TEST(PolyhedronMass, LBeamIsTheSumOfItsTwoBoxes) {
  const double w = 0.6, f = 0.12, l = 0.15, h = 0.8, d = 0.2;
  struct Part {
    Vector3d half, center;
  };
  const std::array<Part, 2> parts{{{{w / 2, f / 2, d / 2}, {w / 2, f / 2, 0}},
                                   {{l / 2, (h - f) / 2, d / 2}, {l / 2, f + (h - f) / 2, 0}}}};
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  for (const Part& p : parts) {
    volume += 8 * p.half.prod();
    first += 8 * p.half.prod() * p.center;
  }
  const Vector3d center = first / volume;
  Matrix3d second = Matrix3d::Zero();
  for (const Part& p : parts) {
    const double v = 8 * p.half.prod();
    second += v * Matrix3d((p.half.cwiseProduct(p.half) / 3).asDiagonal());
    second += v * (p.center - center) * (p.center - center).transpose();
  }
  const MeshMass mass = must(l_beam_mesh(w, f, l, h, d));
  EXPECT_LE(relative(mass.volume, volume), 1e-14);
  EXPECT_LE((mass.center - center).norm(), 1e-15);
  EXPECT_LE(relative(mass.I_Bcm_B, inertia_from_second(second)), 1e-13);
  EXPECT_GT(std::abs(mass.I_Bcm_B(0, 1)),
            0.1 * mass.I_Bcm_B(0, 0));  // products of inertia are there
  // The axes returned diagonalise the tensor and are a rotation.
  const Matrix3d diagonal = mass.R_BP.transpose() * mass.I_Bcm_B * mass.R_BP;
  EXPECT_LE((diagonal - Matrix3d(mass.principal_moments.asDiagonal())).norm() / diagonal.norm(),
            1e-14);
  EXPECT_NEAR(mass.R_BP.determinant(), 1, 1e-14);
}

// A cavity is a component that faces inwards; it takes its mass away exactly.
TEST(PolyhedronMass, CavityIsTakenOff) {
  const Vector3d outer(0.5, 0.4, 0.3), inner(0.2, 0.1, 0.15), at(0.1, -0.2, 0.05);
  TriangleMesh mesh = box_mesh(outer);
  join(mesh, flipped(box_mesh(inner, at)));
  const MeshCertificate certificate = certify(mesh);
  EXPECT_TRUE(certificate.solid) << certificate.fault_text();
  EXPECT_EQ(certificate.cavities, 1u);

  const double V = 8 * outer.prod(), v = 8 * inner.prod();
  const Vector3d center = -v * at / (V - v);
  Matrix3d second = V * Matrix3d((outer.cwiseProduct(outer) / 3).asDiagonal()) -
                    v * Matrix3d((inner.cwiseProduct(inner) / 3).asDiagonal()) -
                    v * at * at.transpose();
  second -= (V - v) * center * center.transpose();
  const MeshMass mass = must(mesh);
  EXPECT_LE(relative(mass.volume, V - v), 1e-14);
  EXPECT_LE((mass.center - center).norm(), 1e-15);
  EXPECT_LE(relative(mass.I_Bcm_B, inertia_from_second(second)), 1e-13);
}

TEST(PolyhedronMass, TotalMassOverridesDensity) {
  const MeshMass mass = must(box_mesh({1, 1, 1}), {.density = 3, .total_mass = 16});
  EXPECT_LE(relative(mass.mass, 16), 1e-15);
  EXPECT_LE(relative(mass.density, 2), 1e-14);
}

// --- Curved bodies: order 2 --------------------------------------------------------------------

struct CurvedCase {
  const char* name;
  std::function<TriangleMesh(std::uint32_t)> mesh;
  double volume;
  Vector3d center;
  Vector3d moments;  // about the centre along x, y, z, unit density
};

class CurvedBody : public testing::TestWithParam<int> {};

std::vector<CurvedCase> curved_cases() {
  const double r = 0.7, h = 1.3, R = 0.9, a = 0.25;
  const Vector3d e(0.5, 0.8, 1.1);
  const double sphere = 4 * kPi / 3 * r * r * r, cylinder = kPi * r * r * h, cone = cylinder / 3;
  const double torus = 2 * kPi * kPi * R * a * a, ellipsoid = 4 * kPi / 3 * e.prod();
  const double inner = 0.4, hole = 4 * kPi / 3 * inner * inner * inner;
  const double shell_moment = 0.4 * (sphere * r * r - hole * inner * inner);
  return {
      {"sphere", [=](std::uint32_t n) { return sphere_mesh(r, n); }, sphere, Vector3d::Zero(),
       Vector3d::Constant(0.4 * sphere * r * r)},
      {"ellipsoid", [=](std::uint32_t n) { return ellipsoid_mesh(e, n); }, ellipsoid,
       Vector3d::Zero(),
       ellipsoid / 5 *
           Vector3d(e.y() * e.y() + e.z() * e.z(), e.x() * e.x() + e.z() * e.z(),
                    e.x() * e.x() + e.y() * e.y())},
      {"cylinder", [=](std::uint32_t n) { return cylinder_mesh(r, h, n); }, cylinder,
       Vector3d::Zero(),
       cylinder * Vector3d(r * r / 4 + h * h / 12, r * r / 2, r * r / 4 + h * h / 12)},
      {"cone", [=](std::uint32_t n) { return cone_mesh(r, h, n); }, cone, Vector3d(0, h / 4, 0),
       cone * Vector3d(3 * r * r / 20 + 3 * h * h / 80, 3 * r * r / 10,
                       3 * r * r / 20 + 3 * h * h / 80)},
      {"torus", [=](std::uint32_t n) { return torus_mesh(R, a, n); }, torus, Vector3d::Zero(),
       torus *
           Vector3d(5 * a * a / 8 + R * R / 2, 3 * a * a / 4 + R * R, 5 * a * a / 8 + R * R / 2)},
      {"hollow sphere",
       [=](std::uint32_t n) {
         TriangleMesh mesh = sphere_mesh(r, n);
         join(mesh, flipped(sphere_mesh(inner, n)));
         return mesh;
       },
       sphere - hole, Vector3d::Zero(), Vector3d::Constant(shell_moment)},
  };
}

TEST_P(CurvedBody, ConvergesWithOrderTwo) {
  const CurvedCase body = curved_cases()[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(body.name);
  double last_volume = 0, last_inertia = 0;
  for (const std::uint32_t n : {8u, 16u, 32u, 64u}) {
    const MeshMass mass = must(body.mesh(n));
    const double volume = relative(mass.volume, body.volume);
    const double inertia = (mass.I_Bcm_B.diagonal() - body.moments).norm() / body.moments.norm();
    EXPECT_LE((mass.center - body.center).norm(), 1e-13);
    EXPECT_LE(
        std::abs(mass.I_Bcm_B(0, 1)) + std::abs(mass.I_Bcm_B(0, 2)) + std::abs(mass.I_Bcm_B(1, 2)),
        1e-13 * mass.I_Bcm_B.trace());
    if (last_volume > 0) {
      // Halving the facets divides the error by 4; from n = 8 on the next term is below 4 percent
      // of the order.
      EXPECT_NEAR(std::log2(last_volume / volume), 2, 0.08);
      EXPECT_NEAR(std::log2(last_inertia / inertia), 2, 0.08);
    }
    last_volume = volume;
    last_inertia = inertia;
  }
  EXPECT_LT(last_volume, 3e-3);  // n = 64: pi^2 / (6 n^2) per curved direction, a few of them
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, CurvedBody, testing::Range(0, 6));

// --- Methods by name ---------------------------------------------------------------------------

TEST(MassMethods, SolidOfAnOpenMeshIsAnErrorThatNamesTheRemedy) {
  TriangleMesh open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  const Result<MeshMass> mass = mass_of_mesh(open, {.method = MassMethod::Solid});
  ASSERT_FALSE(mass.ok());
  EXPECT_NE(mass.error().find("open"), std::string::npos) << mass.error();
  for (const char* method : {"shell", "voxel", "hull"}) {
    EXPECT_NE(mass.error().find(method), std::string::npos) << mass.error();
  }
}

TEST(MassMethods, ShellOfASphereTendsToTheThinSphere) {
  const double r = 0.5, t = 0.002;
  const MeshMass mass =
      must(sphere_mesh(r, 96), {.method = MassMethod::Shell, .density = 100, .shell_thickness = t});
  // The thick-walled sphere from r - t/2 to r + t/2; facets of n = 96 cost about pi^2/(3 n^2) =
  // 4e-4.
  const auto power = [](double x, int n) { return std::pow(x, n); };
  const double outer = r + t / 2, inner = r - t / 2;
  const double m = 100 * 4 * kPi / 3 * (power(outer, 3) - power(inner, 3));
  const double moment = 100 * 8 * kPi / 15 * (power(outer, 5) - power(inner, 5));
  EXPECT_LE(relative(mass.mass, m), 1e-3);
  EXPECT_LE(relative(mass.principal_moments[1], moment), 1e-3);
  EXPECT_EQ(mass.method, MassMethod::Shell);
}

// Whatever way a sheet is cut, a plate of thickness t has the moments of a box.
TEST(MassMethods, ShellOfAPlateIsABox) {
  TriangleMesh plate;
  plate.name = "plate";
  plate.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
  plate.triangles = {{0, 2, 1}, {0, 3, 2}};
  const double t = 0.1;
  const MeshMass mass =
      must(plate, {.method = MassMethod::Shell, .density = 5, .shell_thickness = t});
  const double m = 5 * 2 * t;
  EXPECT_LE(relative(mass.mass, m), 1e-14);
  const Vector3d wanted = m / 12 * Vector3d(t * t + 1, 4 + 1, 4 + t * t);
  EXPECT_LE((mass.I_Bcm_B.diagonal() - wanted).norm(), 1e-14);
  EXPECT_LE((mass.center - Vector3d(1, 0, 0.5)).norm(), 1e-15);
}

TEST(MassMethods, HullFillsTheNotch) {
  // The hull of the L: its rectangle less the triangle between foot and leg.
  const MeshMass mass =
      must(l_beam_mesh(4, 1, 1, 3, 2), {.method = MassMethod::Hull, .density = 1});
  EXPECT_LE(relative(mass.volume, 2 * (12 - 0.5 * 3 * 2)), 1e-12);
}

TEST(MassMethods, VoxelHoldsItsErrorBoundOnAnOpenBox) {
  TriangleMesh crate =
      box_mesh({0.5, 0.5, 0.5});  // with a small hole: one corner of a face missing
  crate.vertices.push_back({0.5, 0.45, 0.45});
  const Triangle cut = crate.triangles.back();  // corners 1, 7, 5 on the side x = 0.5
  crate.triangles.back() = {cut[0], cut[1], 8};
  crate.triangles.push_back({cut[0], 8, cut[2]});
  const MeshMass mass = must(crate, {.method = MassMethod::Voxel, .density = 1});
  EXPECT_FALSE(certify(crate).closed);
  EXPECT_NEAR(mass.volume, 1,
              mass.error.volume + 0.01);  // the hole lets 1 percent of the volume go
  EXPECT_LE(mass.error.volume, 0.05);
}

TEST(MassMethods, VoxelCountsOverlapsOnceAndSaysHowWell) {
  TriangleMesh pair = box_mesh({0.5, 0.5, 0.5});
  join(pair, box_mesh({0.5, 0.5, 0.5}, {0.3, 0.2, 0.1}));
  ASSERT_FALSE(mass_of_mesh(pair).ok());  // solid refuses: it would count the overlap twice
  const MeshMass mass = must(pair, {.method = MassMethod::Voxel, .density = 1});
  const double wanted = 2 - 0.7 * 0.8 * 0.9;
  EXPECT_LE(relative(mass.volume, wanted), mass.error.volume);
  EXPECT_LE(mass.error.volume, 0.05);
}

TEST(MassMethods, BadOptionsAreRefused) {
  const TriangleMesh box = box_mesh({1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(mass_of_mesh(box, {.density = 0}).ok());
  EXPECT_FALSE(mass_of_mesh(box, {.density = -1}).ok());
  EXPECT_FALSE(mass_of_mesh(box, {.density = nan}).ok());
  EXPECT_FALSE(mass_of_mesh(box, {.total_mass = -1}).ok());
  EXPECT_FALSE(mass_of_mesh(box, {.method = MassMethod::Shell}).ok());
  EXPECT_FALSE(mass_of_mesh(box, {.method = MassMethod::Voxel, .voxel_resolution = 2}).ok());
  EXPECT_FALSE(mass_of_mesh(TriangleMesh{}).ok());
}

TEST(MassMethods, NamesGoThereAndBack) {
  for (const MassMethod method :
       {MassMethod::Solid, MassMethod::Shell, MassMethod::Hull, MassMethod::Voxel}) {
    const Result<MassMethod> back = mass_method_from(name_of(method));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(*back, method);
  }
  EXPECT_FALSE(mass_method_from("guess").ok());
}

}  // namespace
}  // namespace plumb::test
