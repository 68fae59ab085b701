// Conversions at the door between the public (Eigen) and the inner vector types.
#pragma once

#include "math/quaternion.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI::detail {

inline Vec to_inner(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 to_public(Vec v) { return {v.x, v.y, v.z}; }
inline Rotation to_inner(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Quat to_public(Rotation q) { return {q.w, q.x, q.y, q.z}; }
inline PosVec to_inner_position(const Pos3& p) { return {p.x(), p.y(), p.z()}; }
inline Pos3 to_public_position(PosVec p) { return {p.x, p.y, p.z}; }

}  // namespace plumb::inline PLUMB_ABI::detail
