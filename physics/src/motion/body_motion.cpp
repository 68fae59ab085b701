#include "motion/body_motion.h"

#include <cmath>

#include "motion/jacobi_flow.h"
#include "motion/named_integrators.h"
#include "motion/splitting.h"
#include "solver/body_kernel.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// exp(-z) for z >= 0, spelled out so that every system gives the same bits: z = k ln 2 + r, Taylor
// in r.
double exp_of_minus(double z) {
  constexpr double kLn2 = 0.69314718055994530942;
  if (z > 700) return 0;  // below the smallest normal double
  const double k = std::nearbyint(z / kLn2);
  const double r = z - k * kLn2;  // |r| <= 0.35: 16 terms reach 1e-17
  double sum = 1;
  for (int n = 16; n >= 1; --n) sum = 1 - sum * r / n;
  return std::ldexp(sum, -static_cast<int>(k));
}

}  // namespace

DampedMotion damped_motion(Real damping, Real h) {
  const double c = static_cast<double>(damping), step = static_cast<double>(h), z = c * step;
  if (z < 0.5) {
    // (1 - e^-z)/z = sum (-z)^n/(n+1)!, (z - 1 + e^-z)/z^2 = sum (-z)^n/(n+2)!; 14 terms reach
    // 1e-17.
    double gain = 0, lift = 0;
    for (int n = 14; n >= 1; --n) {
      gain = (1 + gain) * (-z / (n + 1));
      lift = (1 + lift) * (-z / (n + 2));
    }
    gain += 1;
    lift = (lift + 1) * 0.5;
    return {static_cast<Real>(1 - z * gain), static_cast<Real>(step * gain),
            static_cast<Real>(step * step * lift)};
  }
  const double decay = exp_of_minus(z), gain = (1 - decay) / c;
  return {static_cast<Real>(decay), static_cast<Real>(gain), static_cast<Real>((step - gain) / c)};
}

Symmetric3<Real> without_locked_axes(const Symmetric3<Real>& m, std::uint32_t locks) {
  const Real x = (locks & 1u) != 0 ? Real(0) : Real(1), y = (locks & 2u) != 0 ? Real(0) : Real(1),
             z = (locks & 4u) != 0 ? Real(0) : Real(1);
  return {x * m.xx, y * m.yy, z * m.zz, x * y * m.xy, x * z * m.xz, y * z * m.yz};
}

Symmetric3<Real> inverse_in_free_axes(const Symmetric3<Real>& inertia, std::uint32_t locks) {
  const bool x = (locks & 1u) == 0, y = (locks & 2u) == 0, z = (locks & 4u) == 0;
  Symmetric3<Real> out{};
  const auto inverse_of = [](Real a) { return a > Real(0) ? Real(1) / a : Real(0); };
  const auto pair = [&](Real a, Real b, Real c, Real& ia, Real& ib, Real& ic) {  // [a c; c b]
    const Real determinant = a * b - c * c;
    if (!(determinant > Real(0))) return;
    ia = b / determinant;
    ib = a / determinant;
    ic = -c / determinant;
  };
  if (x && y) {
    pair(inertia.xx, inertia.yy, inertia.xy, out.xx, out.yy, out.xy);
  } else if (x && z) {
    pair(inertia.xx, inertia.zz, inertia.xz, out.xx, out.zz, out.xz);
  } else if (y && z) {
    pair(inertia.yy, inertia.zz, inertia.yz, out.yy, out.zz, out.yz);
  } else if (x) {
    out.xx = inverse_of(inertia.xx);
  } else if (y) {
    out.yy = inverse_of(inertia.yy);
  } else if (z) {
    out.zz = inverse_of(inertia.zz);
  }
  return out;
}

namespace {

// Methods whose state is w: L in, L out.
void turn_by_velocity(RotationMethod method, const BodyMass& m, Rotation& q, Vec& L, Real h) {
  Vec w = angular_velocity_of(m, q, L);
  if (method == RotationMethod::Book) {
    advance_book(q, w, h);
  } else if (method == RotationMethod::ExplicitGyro) {
    advance_explicit_gyro(q, w, m.moments, m.inverse_moments, h);
  } else if (method == RotationMethod::ImplicitGyro) {
    advance_implicit_gyro(q, w, m.moments, h);
  } else {
    advance_rk4(q, w, m.moments, m.inverse_moments, h);
  }
  L = angular_momentum_of(m, q, w);
}

}  // namespace

void turn_steadily(const BodyMass& m, Rotation& q, Vec& L, Real h) {
  const Vec w = angular_velocity_of(m, q, L);
  q = normalized(from_rotation_vector(h * w) * q);
  L = angular_momentum_of(m, q, w);
}

void turn_freely(RotationMethod method, const BodyMass& m, Rotation& q, Vec& L, Real h) {
  if (m.angular_locks != 0) {  // the locks' torques keep the free part of L, not the tumbling
    q = normalized(from_rotation_vector(h * angular_velocity_of(m, q, L)) * q);
    return;
  }
  switch (method) {
    case RotationMethod::Exact:
      if (!turn_by_one_piece(q, L, m.inverse_moments, h))
        advance_rotation(q, L, m.inverse_moments, h);
      return;
    case RotationMethod::Jacobi:
      advance_jacobi(q, L, m.inverse_moments, h);
      return;
    case RotationMethod::Splitting:
      advance_splitting(q, L, m.inverse_moments, h);
      return;
    case RotationMethod::Splitting4:
      advance_splitting4(q, L, m.inverse_moments, h);
      return;
    case RotationMethod::Book:
    case RotationMethod::ExplicitGyro:
    case RotationMethod::ImplicitGyro:
    case RotationMethod::RK4:
      turn_by_velocity(method, m, q, L, h);
      return;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail

namespace plumb::inline PLUMB_ABI {

const char* name_of(RotationMethod method) {
  switch (method) {
    case RotationMethod::Exact:
      return "Exact";
    case RotationMethod::ImplicitGyro:
      return "ImplicitGyro";
    case RotationMethod::Book:
      return "Book";
    case RotationMethod::ExplicitGyro:
      return "ExplicitGyro";
    case RotationMethod::Splitting:
      return "Splitting";
    case RotationMethod::Splitting4:
      return "Splitting4";
    case RotationMethod::RK4:
      return "RK4";
    case RotationMethod::Jacobi:
      return "Jacobi";
  }
  return "";
}

}  // namespace plumb::inline PLUMB_ABI
