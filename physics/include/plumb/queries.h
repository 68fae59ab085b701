// What can be asked about the shapes of a world between two steps: rays, moving shapes, overlaps,
// nearest points; one at a time or many at once.
//
// Held by every query:
//   - it changes nothing, keeps nothing in the world, and may run on any number of threads at once;
//   - colliders are seen where their bodies stand now, also when the bodies sleep;
//   - the answer does not depend on the order of creation of other things, on threads, or on how
//     the world came to be (a restored one answers with the same bits): lists are ordered by
//     fraction or distance, then by collider; of equals the smaller collider id is the nearest;
//   - numbers that are not finite, and shapes that check_shape() would refuse, find nothing.
#pragma once

#include <cstdint>

#include "plumb/ids.h"
#include "plumb/math.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {

class PhysicsWorld;

// Which colliders a query sees.
struct QueryFilter {
  std::uint32_t layers = 0xffffffffu;  // those whose own layers hold a bit of these
  BodyId ignore{};                     // not those of this body: the one that asks
  bool sensors = false;                // sensors too
  // Asked last, of what is left: false leaves the collider out. Called on the thread that runs the
  // query, possibly for colliders that turn out not to be hit; must give the same answer every
  // time.
  bool (*accept)(const PhysicsWorld& world, ColliderId collider, void* context) = nullptr;
  void* context = nullptr;
};

// A straight line from origin to origin + translation. Of length zero it finds what holds the
// origin.
struct Ray {
  Pos3 origin = Pos3::Zero();       // [m] world
  Vec3 translation = Vec3::Zero();  // [m]
};

// collider is null where nothing was hit (in batches).
struct RayHitResult {
  ColliderId collider;
  BodyId body;
  Pos3 point = Pos3::Zero();    // [m] world
  Vec3 normal = Vec3::UnitY();  // unit, outward; -direction for a ray that starts inside
  Real fraction = 0;  // 0..1 along the ray; 0 for one that starts inside or on the surface
};

// A shape that moves in a straight line and turns steadily about its own origin meanwhile.
struct ShapeCast {
  Shape shape = Sphere{};           // anything but a half-space
  Pose start{};                     // of the shape
  Vec3 translation = Vec3::Zero();  // [m]
  Vec3 rotation = Vec3::Zero();     // [rad] about this axis, world axes; any number of turns
};

struct ShapeHitResult {
  ColliderId collider;
  BodyId body;
  // 0..1: the shape may go so far without overlap. It then stands within a thousandth of the
  // thinner shape's thickness of the other.
  Real fraction = 0;
  Pos3 point = Pos3::Zero();    // [m] world, where they meet
  Vec3 normal = Vec3::UnitY();  // unit, from the collider to the moving shape
  Real separation = 0;          // [m] there; negative where the shape overlaps from the beginning
};

struct ClosestPointResult {
  ColliderId collider;
  BodyId body;
  Real distance = 0;                // [m] negative: the depth, for what is inside
  Pos3 on_collider = Pos3::Zero();  // [m] on its surface
  Pos3 on_query = Pos3::Zero();     // [m] the point itself, or on the shape's surface
  Vec3 normal = Vec3::UnitY();      // unit, from the collider to the point or shape
};

}  // namespace plumb::inline PLUMB_ABI
