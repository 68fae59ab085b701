// Mass properties are integrals, so each is checked against a sum:
//   - every closed form against an exact cubature or the limit of cells, with the order of
//   convergence
//   - joining, placing and the parallel-axis theorem against the particles they stand for
//   - no tensor passes check() that no body can have
#include "plumb/mass_properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "mass/inertia_tensor.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

struct Cloud {
  std::vector<double> masses;
  std::vector<Vector3d> places;
  void add(double mass, const Vector3d& at) {
    masses.push_back(mass);
    places.push_back(at);
  }
  [[nodiscard]] MassProperties properties() const { return inertia_of::particles(masses, places); }
};

// Sums of a few hundred products lose a few of 16 digits.
constexpr double kRounding = 1e-13;
void expect_same(const MassProperties& a, const MassProperties& b, double relative = kRounding) {
  const double size = std::sqrt(b.I_Bcm_B.trace() / b.mass) + b.center.norm();
  EXPECT_NEAR(a.mass, b.mass, relative * b.mass);
  EXPECT_LE((a.center - b.center).norm(), relative * size) << a.center.transpose();
  EXPECT_LE((a.I_Bcm_B - b.I_Bcm_B).norm(), relative * b.I_Bcm_B.norm()) << a.I_Bcm_B << "\n!=\n"
                                                                         << b.I_Bcm_B;
}

Cloud random_cloud(unsigned seed, int count, const Vector3d& around = Vector3d::Zero()) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1), mass(0.1, 2);
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    cloud.add(mass(random), around + Vector3d{place(random), 2 * place(random), 3 * place(random)});
  }
  return cloud;
}

// --- The tensor itself
// ----------------------------------------------------------------------------

TEST(InertiaTensor, IsTheMomentAboutEveryAxis) {
  const Cloud cloud = random_cloud(1, 50);
  const MassProperties body = cloud.properties();
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Vector3d through{normal(random), normal(random), normal(random)};
    double sum = 0;  // of m d^2, d the distance from the line
    for (std::size_t k = 0; k < cloud.masses.size(); ++k) {
      sum += cloud.masses[k] * (cloud.places[k] - through).cross(axis).squaredNorm();
    }
    EXPECT_NEAR(axis.dot(body.inertia_about(through) * axis), sum, kRounding * sum);
  }
}

TEST(InertiaTensor, HasMinusTheProductsOfInertia) {
  const double m = 1.5;
  Cloud cloud;
  cloud.add(m, {1, 1, 0});
  cloud.add(m, {-1, -1, 0});
  double product = 0;
  for (std::size_t k = 0; k < 2; ++k) product += m * cloud.places[k].x() * cloud.places[k].y();
  EXPECT_EQ(product, 2 * m);
  const Matrix3d expected = m * (Matrix3d() << 2, -2, 0, -2, 2, 0, 0, 0, 4).finished();
  EXPECT_EQ(cloud.properties().I_Bcm_B, expected);
}

TEST(InertiaTensor, ProductsVanishOnlyInPrincipalAxesThroughTheCentre) {
  const MassProperties body = random_cloud(3, 40).properties();
  const auto products = [](const Matrix3d& I) {
    return std::max({std::abs(I(0, 1)), std::abs(I(0, 2)), std::abs(I(1, 2))}) / I.trace();
  };
  const Quaterniond to_principal = Quaterniond(body.principal().R_BP).conjugate();
  const MassProperties aligned = body.placed({0, 0, 0}, to_principal);
  EXPECT_LE(products(aligned.I_Bcm_B), 1e-15);
  const Quaterniond tilt(Eigen::AngleAxisd(0.01, Vector3d(1, 1, 1).normalized()));
  EXPECT_GE(products(body.placed({0, 0, 0}, tilt * to_principal).I_Bcm_B), 1e-4);
  EXPECT_GE(products(aligned.inertia_about(aligned.center + Vector3d(0.1, 0.2, 0.3))), 1e-3);
}

TEST(InertiaTensor, OfABoxIsOneThirdOnHalfSides) {
  const MassProperties box = inertia_of::box(6, {1, 2, 3});
  EXPECT_EQ(box.I_Bcm_B, Matrix3d(Vector3d(26, 20, 10).asDiagonal()));  // 6/3 (4+9), (1+9), (1+4)
}

// --- Joining and placing
// -----------------------------------------------------------------------------

TEST(MassPropertiesSums, JoinPlaceAndScaleAsTheirParticlesDo) {
  const Vector3d shift{4, -5, 6};
  const Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 3).normalized()));
  const Cloud a = random_cloud(4, 30), b = random_cloud(5, 20, {3, 1, -2});
  Cloud both = a, moved, heavier;
  for (std::size_t k = 0; k < b.masses.size(); ++k) both.add(b.masses[k], b.places[k]);
  for (std::size_t k = 0; k < a.masses.size(); ++k)
    moved.add(a.masses[k], shift + turn * a.places[k]);
  for (std::size_t k = 0; k < a.masses.size(); ++k) heavier.add(3 * a.masses[k], a.places[k]);
  expect_same(a.properties().plus(b.properties()), both.properties());
  expect_same(a.properties().placed(shift, turn), moved.properties());
  expect_same(a.properties().scaled_to_mass(3 * a.properties().mass), heavier.properties());
  expect_same(a.properties().plus(MassProperties{}), a.properties());
  expect_same(MassProperties{}.plus(a.properties()), a.properties());
  expect_same(inertia_of::point(2, {1, 2, 3}).plus(inertia_of::point(1, {-1, 0, 2})), [] {
    Cloud c;
    c.add(2, {1, 2, 3});
    c.add(1, {-1, 0, 2});
    return c.properties();
  }());
}

TEST(MassPropertiesSums, ParallelAxisTheorem) {
  const Cloud cloud = random_cloud(6, 30);
  const Vector3d about{2, -3, 5};
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t k = 0; k < cloud.masses.size(); ++k) {
    sum += detail::point_inertia(cloud.masses[k], cloud.places[k] - about);
  }
  const Matrix3d I = cloud.properties().inertia_about(about);
  EXPECT_LE((I - sum).norm(), kRounding * sum.norm());
}

TEST(MassPropertiesSums, LoseNothingFarFromTheOrigin) {
  const Vector3d far{1e7, -1e7, 1e7};  // places there are rounded by 2e-9 m
  expect_same(random_cloud(7, 30, far).properties().placed(-far, Quaterniond::Identity()),
              random_cloud(7, 30).properties(), 1e-8);
}

// --- Closed forms
// --------------------------------------------------------------------------------------

// Cells with the exact mass at the middle: the sum converges to the body as the square of the cell.
// x, y, z run over (0, 1); `at` maps them into the body, `density` is the volume of a cell there
// (any factor). Two resolutions must differ from the closed form by a ratio of 4 (second order),
// and Richardson's combination of them must agree with it.
struct Cells {
  std::function<Vector3d(double, double, double)> at;
  std::function<double(double, double, double)> density;
};
MassProperties sum_of_cells(const Cells& cells, int n, double mass) {
  Cloud cloud;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const double x = (i + 0.5) / n, y = (j + 0.5) / n, z = (k + 0.5) / n;
        cloud.add(cells.density(x, y, z), cells.at(x, y, z));
      }
    }
  }
  return cloud.properties().scaled_to_mass(mass);
}
void expect_limit(const MassProperties& closed, const Cells& cells) {
  const MassProperties coarse = sum_of_cells(cells, 16, closed.mass);
  const MassProperties fine = sum_of_cells(cells, 32, closed.mass);
  const double scale = closed.I_Bcm_B.norm();
  const double coarse_error = (coarse.I_Bcm_B - closed.I_Bcm_B).norm() / scale;
  const double fine_error = (fine.I_Bcm_B - closed.I_Bcm_B).norm() / scale;
  if (coarse_error > 1e-12) {
    EXPECT_NEAR(coarse_error / fine_error, 4, 0.1) << closed.I_Bcm_B;
  }
  // What is left is fourth order: (1/16)^4 = 1.5e-5 on the coarse cells, less a factor of about 10.
  const Matrix3d limit = (4 * fine.I_Bcm_B - coarse.I_Bcm_B) / 3;
  EXPECT_LE((limit - closed.I_Bcm_B).norm(), 1e-5 * scale) << limit << "\n!=\n" << closed.I_Bcm_B;
  const Vector3d center = (4 * fine.center - coarse.center) / 3;
  EXPECT_LE((center - closed.center).norm(), 1e-5 * std::sqrt(scale / closed.mass));
}
Vector3d around_y(double radius, double angle, double y) {
  return {radius * std::cos(2 * kPi * angle), y, radius * std::sin(2 * kPi * angle)};
}
// From the volume of (0,1)^3 into the unit ball: radius r, height cos, angle.
Vector3d in_ball(double r, double height, double angle) {
  const double c = 2 * height - 1;
  return r * around_y(std::sqrt(1 - c * c), angle, c);
}

TEST(ClosedForms, BallsAndShells) {
  const auto r_squared = [](double r, double, double) { return r * r; };
  const auto uniform = [](double, double, double) { return 1.0; };
  expect_limit(
      inertia_of::solid_sphere(3, 2),
      {[](double r, double y, double a) -> Vector3d { return 2 * in_ball(r, y, a); }, r_squared});
  expect_limit(
      inertia_of::hollow_sphere(3, 2),
      {[](double, double y, double a) -> Vector3d { return 2 * in_ball(1, y, a); }, uniform});
  expect_limit(inertia_of::ellipsoid(3, {1, 2, 3}),
               {[](double r, double y, double a) -> Vector3d {
                  return in_ball(r, y, a).cwiseProduct(Vector3d(1, 2, 3));
                },
                r_squared});
}

TEST(ClosedForms, BoxesRodsAndPlates) {
  const auto uniform = [](double, double, double) { return 1.0; };
  expect_limit(inertia_of::box(3, {1, 2, 3}), {[](double x, double y, double z) -> Vector3d {
                                                 return {2 * x - 1, 4 * y - 2, 6 * z - 3};
                                               },
                                               uniform});
  expect_limit(inertia_of::rod(3, 2), {[](double, double y, double) -> Vector3d {
                                         return {0, 2 * y - 1, 0};
                                       },
                                       uniform});
  expect_limit(inertia_of::plate(3, 2, 5), {[](double x, double, double z) -> Vector3d {
                                              return {2 * x - 1, 0, 5 * z - 2.5};
                                            },
                                            uniform});
}

TEST(ClosedForms, BodiesOfRevolution) {
  const auto r_once = [](double r, double, double) { return r; };
  expect_limit(inertia_of::disc(3, 2),
               {[](double r, double a, double) { return around_y(2 * r, a, 0); }, r_once});
  expect_limit(
      inertia_of::cylinder(3, 2, 5),
      {[](double r, double a, double y) { return around_y(2 * r, a, 5 * y - 2.5); }, r_once});
  expect_limit(inertia_of::tube(3, 1, 2, 5),
               {[](double r, double a, double y) { return around_y(1 + r, a, 5 * y - 2.5); },
                [](double r, double, double) { return 1 + r; }});
  // The base at y = 0, the point at y = 5.
  expect_limit(inertia_of::cone(3, 2, 5),
               {[](double r, double a, double y) { return around_y(2 * r * (1 - y), a, 5 * y); },
                [](double r, double, double y) { return r * (1 - y) * (1 - y); }});
  expect_limit(inertia_of::torus(3, 4, 1),
               {[](double s, double a, double b) {
                  return around_y(4 + s * std::cos(2 * kPi * b), a, s * std::sin(2 * kPi * b));
                },
                [](double s, double, double b) { return s * (4 + s * std::cos(2 * kPi * b)); }});
}

TEST(ClosedForms, CapsuleIsACylinderWithTwoHalfBalls) {
  const double radius = 0.5, half_length = 1.5;
  const double core = kPi * radius * radius * 2 * half_length,
               balls = 4.0 / 3 * kPi * std::pow(radius, 3);
  // Half a ball has half the tensor of a ball about the ball's centre, and its own centre at 3/8 r.
  MassProperties half = inertia_of::solid_sphere(balls, radius).scaled_to_mass(balls / 2);
  half.I_Bcm_B -= detail::point_inertia(balls / 2, {0, 3.0 / 8 * radius, 0});
  MassProperties top = half, bottom = half;
  top.center = {0, half_length + 3.0 / 8 * radius, 0};
  bottom.center = -top.center;
  const MassProperties whole =
      inertia_of::cylinder(core, radius, 2 * half_length).plus(top).plus(bottom);
  expect_same(inertia_of::capsule(core + balls, radius, half_length), whole);
}

TEST(ClosedForms, TetrahedronOfTonon) {
  const std::array<Vector3d, 4> corners{Vector3d{8.33220, -11.86875, 0.93355},
                                        Vector3d{0.75523, 5, 16.37072},
                                        Vector3d{52.61236, 5, -5.38580}, Vector3d{2, 5, 3}};
  const double volume = 1873.23336421646541667;  // unit density; this and below in exact fractions
  const MassProperties body = inertia_of::tetrahedron(volume, corners);
  MassProperties expected;
  expected.mass = volume;
  expected.center = {15.9249475, 0.7828125, 3.7296175};
  const double xy = -11996.2013932340791941, xz = 46343.1673813943943977,
               yz = -4417.66156968561495388;
  expected.I_Bcm_B << 43520.3332853933017927, xy, xz, xy, 194711.292590793605594, yz, xz, yz,
      191168.764886077925454;
  expect_same(body, expected, 1e-14);
  // Moved by 1e4 sizes, the corners themselves are rounded by 1e4 * 1e-16 of the size.
  const Vector3d far{5e5, -5e5, 5e5};
  std::array<Vector3d, 4> moved = corners;
  for (Vector3d& corner : moved) corner += far;
  expect_same(inertia_of::tetrahedron(volume, moved).placed(-far, Quaterniond::Identity()),
              expected, 1e-11);
}

TEST(ClosedForms, OctahedronIsEightTetrahedra) {
  const double edge = 2, reach = edge / std::numbers::sqrt2;
  MassProperties sum;
  for (int corner = 0; corner < 8; ++corner) {
    const double sx = (corner & 1) != 0 ? 1 : -1, sy = (corner & 2) != 0 ? 1 : -1,
                 sz = (corner & 4) != 0 ? 1 : -1;
    sum = sum.plus(
        inertia_of::tetrahedron(0.5, {Vector3d::Zero(), Vector3d{sx * reach, 0, 0},
                                      Vector3d{0, sy * reach, 0}, Vector3d{0, 0, sz * reach}}));
  }
  const MassProperties closed = inertia_of::octahedron(4, edge);
  EXPECT_LE(sum.center.norm(), 1e-15);
  EXPECT_LE((sum.I_Bcm_B - closed.I_Bcm_B).norm(), kRounding * closed.I_Bcm_B.norm());
}

// --- Principal axes
// --------------------------------------------------------------------------------------

void expect_principal(const Matrix3d& I, double relative) {
  MassProperties body;
  body.mass = 1;
  body.I_Bcm_B = I;
  const MassProperties::Principal p = body.principal();
  EXPECT_LE(p.moments[0], p.moments[1]);
  EXPECT_LE(p.moments[1], p.moments[2]);
  EXPECT_LE((p.R_BP.transpose() * p.R_BP - Matrix3d::Identity()).norm(), 4e-15);
  EXPECT_NEAR(p.R_BP.determinant(), 1, 4e-15);
  const Matrix3d back = p.R_BP * p.moments.asDiagonal() * p.R_BP.transpose();
  EXPECT_LE((back - I).norm(), relative * I.norm());
}

TEST(PrincipalAxes, LeaveADiagonalTensorAsItIs) {
  for (const Vector3d& d :
       {Vector3d{1, 2, 3}, Vector3d{1, 1, 2}, Vector3d{1, 2, 2}, Vector3d{5, 5, 5}}) {
    MassProperties body;
    body.I_Bcm_B = d.asDiagonal();
    EXPECT_EQ(body.principal().moments, d);
    EXPECT_EQ(body.principal().R_BP, Matrix3d::Identity());
  }
  std::array<double, 3> d{1.1, 2.2, 3.3};
  do {  // other orders: axes exchanged, no rounding, right-handed
    MassProperties body;
    body.I_Bcm_B = Vector3d(d[0], d[1], d[2]).asDiagonal();
    const MassProperties::Principal p = body.principal();
    EXPECT_EQ(p.moments, Vector3d(1.1, 2.2, 3.3));
    EXPECT_EQ(p.R_BP.determinant(), 1);
    EXPECT_EQ(p.R_BP.cwiseAbs().rowwise().sum(), Vector3d(1, 1, 1));
    EXPECT_EQ(p.R_BP * p.moments.asDiagonal() * p.R_BP.transpose(), body.I_Bcm_B);
  } while (std::next_permutation(d.begin(), d.end()));
}

TEST(PrincipalAxes, AreFoundForRandomRepeatedAndThinBodies) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    Vector3d d{1 + std::abs(normal(random)), 1 + std::abs(normal(random)), 1};
    d[2] = d[0] + 0.5 * d[1];
    if (i % 4 == 1) d[1] = d[0];
    if (i % 4 == 2) d = Vector3d{1, 1, 1 + std::pow(10.0, -(i % 17))};
    if (i % 4 == 3) d = Vector3d{std::pow(10.0, -(i % 13)), 1, 1};
    d *= std::pow(10.0, i % 25 - 12);
    const Matrix3d R = Quaterniond(normal(random), normal(random), normal(random), normal(random))
                           .normalized()
                           .toRotationMatrix();
    const Matrix3d I = R * d.asDiagonal() * R.transpose();
    expect_principal(0.5 * (I + I.transpose()), 1e-14);
  }
}

TEST(PrincipalAxes, DoNotTurnACubeForItsRounding) {
  MassProperties body;
  body.I_Bcm_B = Matrix3d::Identity();
  body.I_Bcm_B(0, 1) = body.I_Bcm_B(1, 0) = 1e-16;
  EXPECT_EQ(body.principal().R_BP, Matrix3d::Identity());
}

// --- What no body can have
// -----------------------------------------------------------------------------------

TEST(Check, AcceptsEveryRealBody) {
  for (const MassProperties& body :
       {inertia_of::solid_sphere(1, 1), inertia_of::box(1e-9, {1e-3, 1e-3, 1e-3}),
        inertia_of::disc(2, 1), inertia_of::cylinder(1e9, 1e4, 1e4),
        inertia_of::capsule(1, 0.01, 2), inertia_of::plate(1, 2, 3),
        random_cloud(9, 20).properties()}) {
    EXPECT_TRUE(check(body).ok()) << check(body).message;
  }
}

TEST(Check, RefusesMassThatIsNone) {
  const double inf = std::numeric_limits<double>::infinity(),
               nan = std::numeric_limits<double>::quiet_NaN();
  MassProperties body = inertia_of::solid_sphere(1, 1);
  for (const double mass : {0.0, -1.0}) {
    body.mass = mass;
    EXPECT_EQ(check(body).code, StatusCode::BadMass);
    EXPECT_NE(std::string(check(body).message).find("mass"), std::string::npos);
  }
  for (const double mass : {inf, -inf, nan}) {
    body.mass = mass;
    EXPECT_EQ(check(body).code, StatusCode::NotFinite);
  }
  body = inertia_of::solid_sphere(1, 1);
  body.center.y() = nan;
  EXPECT_EQ(check(body).code, StatusCode::NotFinite);
  EXPECT_NE(std::string(check(body).message).find("centre"), std::string::npos);
  body = inertia_of::solid_sphere(1, 1);
  body.I_Bcm_B(2, 1) = inf;
  EXPECT_EQ(check(body).code, StatusCode::NotFinite);
}

TEST(Check, RefusesInertiaThatIsNone) {
  const auto message = [](const Matrix3d& I) {
    MassProperties body;
    body.mass = 1;
    body.I_Bcm_B = I;
    const Status status = check(body);
    EXPECT_TRUE(status.ok() || status.code == StatusCode::BadMass);
    return std::string(status.message);
  };
  const auto diagonal = [](double x, double y, double z) {
    return Matrix3d(Vector3d(x, y, z).asDiagonal());
  };
  EXPECT_NE(message(Matrix3d::Zero()).find("singular"), std::string::npos);
  EXPECT_NE(message(diagonal(1, 1, 0)).find("singular"), std::string::npos);
  EXPECT_NE(message(diagonal(1, 1, -1)).find("singular"), std::string::npos);
  EXPECT_NE(message(diagonal(1, 1, 2.1)).find("triangle"), std::string::npos);
  EXPECT_EQ(message(diagonal(1, 1, 2)), "");
  EXPECT_NE(message((Matrix3d() << 2, 1, 0, 0, 2, 0, 0, 0, 2).finished()).find("symmetric"),
            std::string::npos);
  // A rod that is not along an axis: singular but for rounding.
  Cloud rod;
  for (int i = -5; i <= 5; ++i) rod.add(1, i * Vector3d(0.1, 0.37, -0.23));
  EXPECT_NE(message(rod.properties().I_Bcm_B).find("singular"), std::string::npos);
}

// --- Shapes
// -------------------------------------------------------------------------------------------------

constexpr double kReal = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());

HullGeometry::Result box_hull(const Vec3& half, const Vec3& at) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i) {
    v.push_back(at + Vec3((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                          (i & 4) != 0 ? half.z() : -half.z()));
  }
  const std::vector<std::uint32_t> sizes(6, 4),
      faces{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  return HullGeometry::create(v, sizes, faces);
}

TEST(MassOfShape, MatchesTheClosedForms) {
  const double density = 1000;
  const ShapeMass ball = mass_of(Sphere{Real(0.5)}, density);
  ASSERT_TRUE(ball.status.ok()) << ball.status.message;
  expect_same(ball.properties, inertia_of::solid_sphere(density * kPi / 6, 0.5));
  const ShapeMass box = mass_of(Box{Vec3(1, 2, 3)}, density);
  ASSERT_TRUE(box.status.ok()) << box.status.message;
  expect_same(box.properties, inertia_of::box(density * 48, {1, 2, 3}));
  const ShapeMass capsule = mass_of(Capsule{Real(1.5), Real(0.5)}, density);
  ASSERT_TRUE(capsule.status.ok()) << capsule.status.message;
  expect_same(capsule.properties,
              inertia_of::capsule(density * kPi * (0.25 * 3 + 0.5 / 3), 0.5, 1.5));
}

TEST(MassOfShape, OfAHullIsExactAtAndAwayFromItsOrigin) {
  for (const Vec3& at :
       {Vec3(0, 0, 0), Vec3(3, -4, 5), Vec3(1024, -2048, 4096)}) {  // exact in float
    const HullGeometry::Result made = box_hull(Vec3(1, 2, 3), at);
    ASSERT_TRUE(made.status.ok()) << made.status.message;
    const ShapeMass hull = mass_of(ConvexHull{made.hull}, 10);
    ASSERT_TRUE(hull.status.ok()) << hull.status.message;
    MassProperties expected = inertia_of::box(480, {1, 2, 3});
    expected.center = at.cast<double>();
    expect_same(hull.properties, expected);
  }
}

TEST(MassOfShape, OfATetrahedronHullMatchesTonon) {
  const std::vector<Vec3> v{Vec3(Real(8.33220), Real(-11.86875), Real(0.93355)),
                            Vec3(Real(0.75523), 5, Real(16.37072)),
                            Vec3(Real(52.61236), 5, Real(-5.38580)), Vec3(2, 5, 3)};
  // Outward for one sense of the four corners; turned over for the other.
  std::vector<std::uint32_t> faces{0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3};
  if ((v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0]) > 0) {
    for (std::size_t f = 0; f < faces.size(); f += 3) std::swap(faces[f + 1], faces[f + 2]);
  }
  const HullGeometry::Result made =
      HullGeometry::create(v, std::vector<std::uint32_t>(4, 3), faces);
  ASSERT_TRUE(made.status.ok()) << made.status.message;
  const ShapeMass hull = mass_of(ConvexHull{made.hull}, 1);
  ASSERT_TRUE(hull.status.ok()) << hull.status.message;
  std::array<Vector3d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = v[k].cast<double>();
  expect_same(hull.properties, inertia_of::tetrahedron(hull.properties.mass, corners), 1e-12);
  EXPECT_NEAR(hull.properties.mass, 1873.23336421646541667, kReal * 1873);
}

TEST(MassOfShape, RefusesWhatHasNoMass) {
  EXPECT_EQ(mass_of(HalfSpace{}, 1).status.code, StatusCode::BadShape);
  EXPECT_EQ(mass_of(Sphere{}, 0).status.code, StatusCode::OutOfRange);
  EXPECT_EQ(mass_of(Sphere{}, -1).status.code, StatusCode::OutOfRange);
  EXPECT_EQ(mass_of(Sphere{}, std::numeric_limits<double>::infinity()).status.code,
            StatusCode::NotFinite);
  EXPECT_EQ(mass_of(Sphere{}, std::numeric_limits<double>::quiet_NaN()).status.code,
            StatusCode::NotFinite);
  EXPECT_FALSE(mass_of(Sphere{Real(0)}, 1).status.ok());
  EXPECT_FALSE(mass_of(Box{Vec3(1, -1, 1)}, 1).status.ok());
  EXPECT_FALSE(mass_of(ConvexHull{}, 1).status.ok());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
