#include "world/inner_edges.h"

#include <algorithm>
#include <tuple>

#include "collision/core_distance.h"
#include "collision/core_support.h"
#include "collision/surface/composite_shape.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A point this near to a neighbour lies on it, and what stands out by less lies flush [slops].
constexpr Real kFlushSlops = Real(0.5);

// One side of a contact: a convex piece of what is rigid, as the other side's body meets it.
struct Touch {
  std::uint32_t mover;  // body slot
  std::uint32_t rigid;  // body slot; kNone: all that is static
  std::uint32_t contact;
  bool of_b;  // the piece is B's
};

struct Piece {
  const CollisionShape* shape = nullptr;
  PosVec x{0, 0, 0};  // [m] in the world
  NumRotation q;
};

bool is_static(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Static;
}

bool may_have_neighbours(const WorldState& world, const ColliderInfo& c) {
  if (is_surface(c.shape.type) || c.shape.type == ShapeType::HalfSpace) return false;
  return is_static(world, c.body) || c.shape.type == ShapeType::Compound ||
         world.bodies.info[c.body].colliders.size() > 1;
}

bool is_dynamic(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Dynamic;
}

Piece piece_of(const WorldState& world, const Touch& touch) {
  const Contact& contact = world.contacts[touch.contact];
  const Pair& pair = world.pairs[contact.pair];
  const ColliderInfo& c = world.colliders.info[touch.of_b ? pair.collider_b() : pair.collider_a()];
  const BodyPose& body = world.bodies.pose[world.bodies.info[c.body].dense];
  Transform placed = c.in_body;
  Piece piece{&c.shape, body.x, to_placement({{0, 0, 0}, body.q}).q};
  if (c.shape.type == ShapeType::Compound) {  // children are numbered as in collide_parts.cpp
    const std::size_t child = touch.of_b ? contact.part & 0xffffu : contact.part >> 16;
    if (child >= c.shape.compound->children.size()) return {};
    piece.shape = &c.shape.compound->children[child].shape;
    placed = placed * c.shape.compound->children[child].placed;
  }
  const Placement at = to_placement(placed);
  piece.x += cast<PosReal>(rotate(piece.q, at.p));
  piece.q = normalized(piece.q * at.q);
  return piece;
}

bool same(const Piece& a, const Piece& b) {
  return a.shape == b.shape && length_squared(a.x - b.x) == PosReal(0);
}

NumVec outward_of(const WorldState& world, const Touch& touch) {
  const Vec n = world.contacts[touch.contact].manifold.normal;
  return to_num(touch.of_b ? -n : n);
}

// For the points of a contact: visit(whether it lies on the neighbour, whether the neighbour stands
// out beyond it along `outward`), until that returns false.
template <class Visit>
void visit_points(const WorldState& world, const Touch& touch, NumVec outward,
                  const Piece& neighbour, Visit&& visit) {
  const Contact& contact = world.contacts[touch.contact];
  const Pair& pair = world.pairs[contact.pair];
  const Num flush = static_cast<Num>(kFlushSlops * pair.slop);
  const std::uint32_t seen_from = pair.relative_to_b ? pair.body_b : pair.body_a;
  const PosVec origin = world.bodies.pose[world.bodies.info[seen_from].dense].x;
  const NumVec normal = outward_of(world, touch);
  const NumRotation back = conjugate(neighbour.q);
  const NumVec n = rotate(back, outward);
  const NumVec farthest = core_support(*neighbour.shape, n);
  const Num radius = static_cast<Num>(neighbour.shape->radius);
  const Num reach = dot(farthest, n) + radius;
  const NumVec advance = touch.of_b ? to_num(contact.advance) : NumVec{0, 0, 0};
  for (int i = 0; i < contact.manifold.count; ++i) {
    const ManifoldPoint& at = contact.manifold.points[i];
    const Num gap = static_cast<Num>(at.separation - contact.advanced_gap);
    const NumVec on_piece = to_num(at.position) - advance - (Num(0.5) * gap) * normal;
    const NumVec p = rotate(back, cast<Num>(origin - neighbour.x) + on_piece);
    const bool lies_on = distance_to_core(*neighbour.shape, p).distance - radius <= flush;
    if (!visit(lies_on, reach - dot(n, p) > flush)) return;
  }
}

// Whether all points of a contact lie on a neighbour that stands out beyond their plane.
bool is_hidden(const WorldState& world, const Touch& touch, const Piece& neighbour) {
  bool hidden = true;
  visit_points(world, touch, outward_of(world, touch), neighbour, [&](bool lies_on, bool beyond) {
    hidden = lies_on && beyond;
    return hidden;
  });
  return hidden;
}

// Whether a point of a contact lies on a neighbour that does not stand out along `outward`.
bool is_continued(const WorldState& world, const Touch& touch, NumVec outward,
                  const Piece& neighbour) {
  bool continued = false;
  visit_points(world, touch, outward, neighbour, [&](bool lies_on, bool beyond) {
    continued = lies_on && !beyond;
    return !continued;
  });
  return continued;
}

// The unit normal of the piece's face that looks most along a direction; zero if it has no faces.
NumVec face_along(const Piece& piece, NumVec outward) {
  const NumVec d = rotate(conjugate(piece.q), outward);
  NumVec best{0, 0, 0};
  if (piece.shape->type == ShapeType::Box) {
    const NumVec m = absolute(d);
    const int axis = m.x >= m.y ? (m.x >= m.z ? 0 : 2) : (m.y >= m.z ? 1 : 2);
    set_component(best, axis, component(d, axis) < Num(0) ? Num(-1) : Num(1));
  } else if (piece.shape->type == ShapeType::Hull) {
    for (const Vec3& normal : piece.shape->hull->face_normals())
      if (dot(to_num(normal), d) > dot(best, d)) best = to_num(normal);
    best = normalized_or(best, {0, 0, 0});
  }
  return rotate(piece.q, best);
}

void set_normal(Contact& contact, Vec normal) {
  const Real advanced_gap = -dot(normal, contact.advance);
  for (int i = 0; i < contact.manifold.count; ++i)
    contact.manifold.points[i].separation += advanced_gap - contact.advanced_gap;
  contact.advanced_gap = advanced_gap;
  contact.manifold.normal = normal;
}

// Gives the contacts of a side that lies along a face with flush neighbours the face's normal. A
// side lies along a face if it leaves it by no more than the margin in which points are made, over
// the smaller of the two: what rests there rocks by less.
void follow_faces(WorldState& world, std::span<const Touch> group, std::span<const Piece> pieces) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Touch& touch = group[i];
    // What yields follows what does not.
    if (touch.rigid != kNone && !is_dynamic(world, touch.mover)) continue;
    if (pieces[i].shape == nullptr) continue;
    Contact& contact = world.contacts[touch.contact];
    const NumVec outward = outward_of(world, touch);
    const NumVec face = face_along(pieces[i], outward);
    const Vec normal = cast<Real>(touch.of_b ? -face : face);
    if (length_squared(normal - contact.manifold.normal) == Real(0)) continue;
    const Num size = Num(2) * static_cast<Num>(std::min(bounding_radius(*pieces[i].shape),
                                                        world.bodies.extent[touch.mover].radius));
    const Num margin = static_cast<Num>(tolerance::kMarginSlops * world.pairs[contact.pair].slop);
    const bool along = dot(face, outward) > Num(0) && length(cross(face, outward)) * size <= margin;
    if (!along) continue;
    const auto continues = [&](const Piece& neighbour) {
      return neighbour.shape != nullptr && !same(pieces[i], neighbour) &&
             is_continued(world, touch, face, neighbour);
    };
    if (std::any_of(pieces.begin(), pieces.end(), continues)) set_normal(contact, normal);
  }
}

// Which colliders of a touching pair may have flush neighbours.
constexpr std::uint8_t kOfA = 1, kOfB = 2;
std::uint8_t neighboured_sides(const WorldState& world, const Pair& pair) {
  if (pair.contact_count == 0 || pair.on_surface) return 0;
  return static_cast<std::uint8_t>(
      (world.colliders.has_neighbours[pair.collider_a()] != 0 ? kOfA : 0) |
      (world.colliders.has_neighbours[pair.collider_b()] != 0 ? kOfB : 0));
}

void list_touches(WorldState& world, StepList<Touch>& touches) {
  const auto count = static_cast<std::uint32_t>(world.pairs.size());
  StepList<std::uint8_t> sides(count, 0, &world.memory);
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) sides[i] = neighboured_sides(world, world.pairs[i]);
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    if (sides[i] == 0) continue;
    const Pair& pair = world.pairs[i];
    const auto list = [&](std::uint32_t piece, std::uint32_t mover, std::uint32_t k, bool of_b) {
      touches.push_back({mover, is_static(world, piece) ? kNone : piece, k, of_b});
    };
    for (std::uint32_t k = pair.first_contact; k < pair.first_contact + pair.contact_count; ++k) {
      if ((sides[i] & kOfA) != 0) list(pair.body_a, pair.body_b, k, false);
      if ((sides[i] & kOfB) != 0) list(pair.body_b, pair.body_a, k, true);
    }
  }
}

// The touches of one body with one rigid whole: which of them a neighbour hides.
void find_hidden(const WorldState& world, std::span<const Touch> group,
                 std::span<const Piece> pieces, StepList<std::uint8_t>& hidden) {
  const std::size_t count = group.size();
  const auto hides = [&](std::size_t j, std::size_t i) {  // j's piece the contact i
    return pieces[i].shape != nullptr && pieces[j].shape != nullptr &&
           !same(pieces[i], pieces[j]) && is_hidden(world, group[i], pieces[j]);
  };
  StepList<std::uint8_t> doubtful(count, 0, hidden.get_allocator());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count && doubtful[i] == 0; ++j) doubtful[i] = hides(j, i) ? 1 : 0;
  // One that is hidden may hide the next, so long as the last of the chain stays: neither is in
  // doubt then.
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count && doubtful[i] != 0; ++j) {
        if (doubtful[j] != 0 || !hides(j, i)) continue;
        hidden[group[i].contact] = 1;
        doubtful[i] = 0;
        more = true;
      }
  }
}

void take_out(WorldState& world, const StepList<std::uint8_t>& hidden) {
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    Pair& pair = world.pairs[i];
    const std::uint32_t begin = pair.first_contact, end = begin + pair.contact_count;
    pair.first_contact = kept;
    for (std::uint32_t k = begin; k < end; ++k)
      if (hidden[k] == 0) world.contacts[kept++] = world.contacts[k];
    pair.contact_count = kept - pair.first_contact;
    // Those that stay may not be told anew without those that went: a neighbour may let them back.
    if (pair.contact_count < end - begin)
      for (Contact& contact : contacts_of(pair, world.contacts)) contact.kept.margin = Real(-1);
    if (begin != end) pair.touching = pair.contact_count > 0;
  }
  world.contacts.resize(kept);
}

}  // namespace

void note_neighbours(WorldState& world, std::uint32_t body) {
  for (const std::uint32_t slot : world.bodies.info[body].colliders)
    world.colliders.has_neighbours[slot] =
        may_have_neighbours(world, world.colliders.info[slot]) ? 1 : 0;
}

void drop_hidden_contacts(WorldState& world) {
  StepList<Touch> touches(&world.memory);
  list_touches(world, touches);
  if (touches.empty()) return;
  const auto whole = [](const Touch& t) { return std::pair(t.mover, t.rigid); };
  const auto before = [](const Touch& a, const Touch& b) {
    return std::tuple(a.mover, a.rigid, a.contact, a.of_b) <
           std::tuple(b.mover, b.rigid, b.contact, b.of_b);
  };
  if (!std::is_sorted(touches.begin(), touches.end(), before))
    std::sort(touches.begin(), touches.end(), before);
  StepList<std::uint8_t> hidden(world.contacts.size(), 0, &world.memory);
  StepList<Piece> pieces(&world.memory);
  for (std::size_t begin = 0, end; begin < touches.size(); begin = end) {
    for (end = begin + 1; end < touches.size() && whole(touches[end]) == whole(touches[begin]);)
      ++end;
    if (end - begin == 1) continue;
    const std::span<const Touch> group = std::span(touches).subspan(begin, end - begin);
    pieces.clear();
    for (const Touch& touch : group) pieces.push_back(piece_of(world, touch));
    follow_faces(world, group, pieces);
    find_hidden(world, group, pieces, hidden);
  }
  if (std::find(hidden.begin(), hidden.end(), 1) != hidden.end()) take_out(world, hidden);
}

}  // namespace plumb::inline PLUMB_ABI::detail
