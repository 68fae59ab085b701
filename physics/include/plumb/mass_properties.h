// Mass, centre of mass and inertia of bodies: closed forms, sums, the parallel-axis theorem.
//
// Conventions: the inertia tensor has the minus signs in it, I = integral (|r|^2 E - r r^T) dm, so
// I_xy = -integral x y dm. Named I_Bcm_B: about the centre of mass, in axes B.
#pragma once

#include <array>
#include <span>

#include "plumb/math.h"
#include "plumb/shapes.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

struct MassProperties {
  double mass = 0;                                    // [kg] > 0
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // [m] centre of mass, in B
  Eigen::Matrix3d I_Bcm_B = Eigen::Matrix3d::Zero();  // [kg m^2] about the centre, axes B

  // Mass properties of this body and another one rigidly joined to it, both given in B.
  [[nodiscard]] MassProperties plus(const MassProperties& other) const;
  // The same body seen from frame A, with B placed in A.
  [[nodiscard]] MassProperties placed(const Eigen::Vector3d& p_AB,
                                      const Eigen::Quaterniond& R_AB) const;
  // Inertia about another point of B (parallel-axis theorem), axes B.
  [[nodiscard]] Eigen::Matrix3d inertia_about(const Eigen::Vector3d& p_B) const;
  // Same shape and density distribution with another total mass.
  [[nodiscard]] MassProperties scaled_to_mass(double mass) const;
  // Moments ascending [kg m^2], axes as the columns of a rotation R_BP.
  struct Principal {
    Eigen::Vector3d moments;
    Eigen::Matrix3d R_BP;
  };
  [[nodiscard]] Principal principal() const;
};

// Whether a body with these properties can exist: finite, mass > 0, tensor symmetric, positive, and
// its principal moments obey the triangle inequality I1 + I2 >= I3 (to 1e-6 relative).
Status check(const MassProperties& properties);

// Bodies of uniform density, centred at the origin unless said; mass in kg, lengths in m, all > 0.
// Formulas: any table of moments of inertia; each is checked by a test against sums over particles.
namespace inertia_of {
MassProperties point(double mass, const Eigen::Vector3d& at);
MassProperties particles(std::span<const double> masses,
                         std::span<const Eigen::Vector3d> positions);
MassProperties solid_sphere(double mass, double radius);
MassProperties hollow_sphere(double mass, double radius);  // thin shell
MassProperties ellipsoid(double mass, const Eigen::Vector3d& semi_axes);
MassProperties box(double mass, const Eigen::Vector3d& half_extents);
MassProperties rod(double mass, double length);                      // thin, along y
MassProperties disc(double mass, double radius);                     // thin, axis y
MassProperties plate(double mass, double width_x, double width_z);   // thin, normal y
MassProperties cylinder(double mass, double radius, double height);  // axis y
MassProperties tube(double mass, double inner_radius, double outer_radius,
                    double height);  // axis y
MassProperties cone(double mass, double radius,
                    double height);  // axis y, base at y = 0, apex at +height
MassProperties capsule(double mass, double radius, double half_length);     // axis y
MassProperties torus(double mass, double ring_radius, double tube_radius);  // axis y
MassProperties tetrahedron(double mass, const std::array<Eigen::Vector3d, 4>& corners);
MassProperties octahedron(double mass, double edge);  // regular
}  // namespace inertia_of

// Of a collision shape filled with a uniform density [kg/m^3] > 0. A half-space has none
// (BadShape).
struct ShapeMass {
  MassProperties properties;
  Status status;
};
ShapeMass mass_of(const Shape& shape, double density);

}  // namespace plumb::inline PLUMB_ABI
