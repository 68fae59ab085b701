// What the files of the C interface share: the world behind the handle, statuses, and numbers.
#pragma once

#include <memory>
#include <new>
#include <vector>

#include "plumb/integration/plumb_c.h"
#include "plumb/world.h"

struct plumb_world {
  explicit plumb_world(const plumb::WorldSettings& settings) : world(settings) {}

  std::unique_ptr<plumb::JobSystem> jobs;  // outlives the world that uses it
  plumb::PhysicsWorld world;
  std::vector<plumb::BodyState> states;
  const char* message = "";
};

namespace plumb_c {

using plumb::BodyId;
using plumb::ColliderId;
using plumb::Real;

// The numbers of plumb_status are promised to other languages; StatusCode is not.
inline plumb_status code_of(plumb::StatusCode code) {
  switch (code) {
    case plumb::StatusCode::Ok:
      return PLUMB_OK;
    case plumb::StatusCode::StaleHandle:
      return PLUMB_STALE_HANDLE;
    case plumb::StatusCode::NotFinite:
      return PLUMB_NOT_FINITE;
    case plumb::StatusCode::OutOfRange:
      return PLUMB_OUT_OF_RANGE;
    case plumb::StatusCode::BadShape:
      return PLUMB_BAD_SHAPE;
    case plumb::StatusCode::BadMass:
      return PLUMB_BAD_MASS;
    case plumb::StatusCode::WrongMotionType:
      return PLUMB_WRONG_MOTION_TYPE;
    case plumb::StatusCode::CapacityExceeded:
      return PLUMB_CAPACITY_EXCEEDED;
    case plumb::StatusCode::BadSnapshot:
      return PLUMB_BAD_SNAPSHOT;
    case plumb::StatusCode::InsideStep:
      return PLUMB_INSIDE_STEP;
    case plumb::StatusCode::Unreachable:  // no call of this interface says so
      return PLUMB_OUT_OF_RANGE;
  }
  return PLUMB_OUT_OF_RANGE;
}

inline plumb_status fail(plumb_world* world, plumb_status code, const char* message) {
  world->message = message;
  return code;
}

inline plumb_status pass_on(plumb_world* world, const plumb::Status& status) {
  return status.ok() ? PLUMB_OK : fail(world, code_of(status.code), status.message);
}

inline plumb_status null_pointer(plumb_world* world) {
  return fail(world, PLUMB_NULL_POINTER, "an argument is NULL that must not be");
}

// No exception may cross into C; the only one that can come is that of a full memory.
template <class Body>
plumb_status guarded(plumb_world* world, const Body& body) {
  if (!world) return PLUMB_NULL_POINTER;
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(world, PLUMB_OUT_OF_MEMORY, "there is not enough memory");
  }
}

inline plumb::Vec3 vec3(const double* v) {
  return {static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
}
inline plumb::Pos3 pos3(const double* v) {
  return {static_cast<plumb::PosReal>(v[0]), static_cast<plumb::PosReal>(v[1]),
          static_cast<plumb::PosReal>(v[2])};
}
inline plumb::Quat quat(const double* q) {
  return {static_cast<Real>(q[3]), static_cast<Real>(q[0]), static_cast<Real>(q[1]),
          static_cast<Real>(q[2])};
}

template <class T>
void write3(const Eigen::Matrix<T, 3, 1>& from, double* to) {
  for (Eigen::Index k = 0; k < 3; ++k) to[k] = static_cast<double>(from[k]);
}

inline void identity(double* q) {
  q[0] = q[1] = q[2] = 0;
  q[3] = 1;
}

}  // namespace plumb_c
