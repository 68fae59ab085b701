// Invariant: the contact frame is orthonormal and right-handed for every normal, slanted or along
// an axis, on both sides of the one plane where its formula changes sign.
#include <gtest/gtest.h>

#include "math/vector3.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());

void expect_orthonormal(Vec n) {
  Vec t1, t2;
  tangent_frame(n, t1, t2);
  Eigen::Matrix3d frame;
  frame << oracle::vec(n), oracle::vec(t1), oracle::vec(t2);
  // The unit normal itself is rounded; each entry of the frame takes three roundings more.
  EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            8 * kEps);
  EXPECT_GT(frame.determinant(), 0.5);
}

TEST(TangentFrame, IsOrthonormalForEveryNormal) {
  oracle::Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const oracle::V v = random.direction();
    expect_orthonormal(
        {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())});
  }
  const Real tiny = std::numeric_limits<Real>::min();
  for (int axis = 0; axis < 3; ++axis) {
    for (const Real sign : {Real(1), Real(-1)}) {
      for (const Real aside : {Real(0), tiny, -tiny, Real(1e-4), Real(-1e-4)}) {
        for (int other = 0; other < 3; ++other) {
          Vec n{0, 0, 0};
          set_component(n, other, aside);
          set_component(n, axis, sign);
          expect_orthonormal(normalized_or(n, n));
        }
      }
    }
  }
  expect_orthonormal({Real(0.6), Real(0.8), Real(-0.0)});
  expect_orthonormal({Real(0), Real(-0.0), Real(-1)});
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
