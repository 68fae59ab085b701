// Joining, placing and checking of mass properties.
//
// The parallel-axis theorem in tensor form [Huygens 1673], [Goldstein 2002, 5.3]: about a point at
// distance d from the centre of mass, I_point = I_cm + m (|d|^2 E - d d^T).
#include "plumb/mass_properties.h"

#include <cmath>

#include "mass/inertia_tensor.h"

namespace plumb::inline PLUMB_ABI {
namespace {

// Entries that mirror each other may differ by this share of the trace: tensors are often typed or
// come through single precision (1.2e-7).
constexpr double kSymmetryTolerance = 1e-6;
// A moment below this share of the largest one is rounding of the tensor's entries (2.2e-16 each,
// summed over many parts), not a moment.
constexpr double kSmallestMomentRatio = 1e-12;
// How far the triangle inequality may be missed: a thin disc has I1 + I2 = I3 exactly, and single
// precision rounds each moment by 1.2e-7.
constexpr double kTriangleTolerance = 1e-6;

}  // namespace

MassProperties MassProperties::plus(const MassProperties& other) const {
  MassProperties sum;
  sum.mass = mass + other.mass;
  if (sum.mass == 0) return sum;
  // Written with the distance of the two centres, nothing cancels far from the origin.
  const Eigen::Vector3d apart = other.center - center;
  sum.center = center + (other.mass / sum.mass) * apart;
  const double reduced_mass = mass * (other.mass / sum.mass);
  sum.I_Bcm_B = I_Bcm_B + other.I_Bcm_B + detail::point_inertia(reduced_mass, apart);
  return sum;
}

MassProperties MassProperties::placed(const Eigen::Vector3d& p_AB,
                                      const Eigen::Quaterniond& R_AB) const {
  const Eigen::Matrix3d R = R_AB.normalized().toRotationMatrix();
  MassProperties moved;
  moved.mass = mass;
  moved.center = p_AB + R * center;
  const Eigen::Matrix3d turned = R * I_Bcm_B * R.transpose();
  moved.I_Bcm_B = 0.5 * (turned + turned.transpose());  // rounding leaves it symmetric
  return moved;
}

Eigen::Matrix3d MassProperties::inertia_about(const Eigen::Vector3d& p_B) const {
  return I_Bcm_B + detail::point_inertia(mass, p_B - center);
}

MassProperties MassProperties::scaled_to_mass(double new_mass) const {
  MassProperties scaled = *this;
  scaled.mass = new_mass;
  if (mass != 0) scaled.I_Bcm_B *= new_mass / mass;
  return scaled;
}

Status check(const MassProperties& properties) {
  if (!std::isfinite(properties.mass)) {
    return {StatusCode::NotFinite, "mass is NaN or infinite; it must be a finite number of kg > 0"};
  }
  if (!properties.center.allFinite()) {
    return {StatusCode::NotFinite, "centre of mass is NaN or infinite; it must be finite [m]"};
  }
  if (!properties.I_Bcm_B.allFinite()) {
    return {StatusCode::NotFinite, "inertia tensor holds a NaN or an infinity; give finite kg m^2"};
  }
  if (properties.mass <= 0) {
    return {StatusCode::BadMass, "mass is zero or negative; it must be a number of kg > 0"};
  }
  const Eigen::Matrix3d& I = properties.I_Bcm_B;
  const double scale = I.cwiseAbs().maxCoeff();
  if ((I - I.transpose()).cwiseAbs().maxCoeff() > kSymmetryTolerance * scale) {
    return {StatusCode::BadMass, "inertia tensor is not symmetric; I_xy must equal I_yx and so on"};
  }
  const Eigen::Vector3d moments = properties.principal().moments;
  if (!(moments[0] > kSmallestMomentRatio * moments[2])) {
    return {StatusCode::BadMass,
            "inertia tensor is singular or not positive; every principal moment must be > 0, so "
            "give a thin rod or a point some thickness"};
  }
  if (moments[0] + moments[1] < (1 - kTriangleTolerance) * moments[2]) {
    return {StatusCode::BadMass,
            "principal moments break the triangle inequality I1 + I2 >= I3, which the moments of "
            "every body obey; check the entries and their units [kg m^2]"};
  }
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
