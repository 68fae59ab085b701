#include "world/inner_edges.h"

#include <algorithm>
#include <tuple>

#include "collision/core_distance.h"
#include "collision/core_support.h"
#include "collision/surface/composite_shape.h"
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

// Whether all points of a contact lie on a neighbour that stands out beyond their plane.
bool is_hidden(const WorldState& world, const Touch& touch, const Piece& neighbour) {
  const Contact& contact = world.contacts[touch.contact];
  const Pair& pair = world.pairs[contact.pair];
  const Num flush = static_cast<Num>(kFlushSlops * pair.slop);
  const std::uint32_t seen_from = pair.relative_to_b ? pair.body_b : pair.body_a;
  const PosVec origin = world.bodies.pose[world.bodies.info[seen_from].dense].x;
  const NumVec outward = to_num(touch.of_b ? -contact.manifold.normal : contact.manifold.normal);
  const NumRotation back = conjugate(neighbour.q);
  const NumVec n = rotate(back, outward);
  const NumVec farthest = core_support(*neighbour.shape, n);
  const Num radius = static_cast<Num>(neighbour.shape->radius);
  const Num reach = dot(farthest, n) + radius;
  const NumVec advance = touch.of_b ? to_num(contact.advance) : NumVec{0, 0, 0};
  for (int i = 0; i < contact.manifold.count; ++i) {
    const ManifoldPoint& at = contact.manifold.points[i];
    const Num gap = static_cast<Num>(at.separation - contact.advanced_gap);
    const NumVec on_piece = to_num(at.position) - advance - (Num(0.5) * gap) * outward;
    const NumVec p = rotate(back, cast<Num>(origin - neighbour.x) + on_piece);
    if (distance_to_core(*neighbour.shape, p).distance - radius > flush) return false;
    if (reach - dot(n, p) <= flush) return false;
  }
  return true;
}

void list_touches(WorldState& world, StepList<Touch>& touches) {
  for (std::uint32_t k = 0; k < world.contacts.size(); ++k) {
    const Pair& pair = world.pairs[world.contacts[k].pair];
    const ColliderInfo& a = world.colliders.info[pair.collider_a()];
    const ColliderInfo& b = world.colliders.info[pair.collider_b()];
    if (is_surface(a.shape.type) || is_surface(b.shape.type)) continue;
    const auto list = [&](const ColliderInfo& piece, std::uint32_t mover, bool of_b) {
      if (may_have_neighbours(world, piece))
        touches.push_back({mover, is_static(world, piece.body) ? kNone : piece.body, k, of_b});
    };
    list(a, pair.body_b, false);
    list(b, pair.body_a, true);
  }
}

// The touches of one body with one rigid whole: which of them a neighbour hides.
void find_hidden(const WorldState& world, std::span<const Touch> group,
                 StepList<std::uint8_t>& hidden) {
  const std::size_t count = group.size();
  StepList<Piece> pieces(hidden.get_allocator());
  for (const Touch& touch : group) pieces.push_back(piece_of(world, touch));
  const auto same = [](const Piece& a, const Piece& b) {
    return a.shape == b.shape && length_squared(a.x - b.x) == PosReal(0);
  };
  const auto hides = [&](std::size_t j, std::size_t i) {  // j's piece the contact i
    return pieces[i].shape != nullptr && pieces[j].shape != nullptr &&
           !same(pieces[i], pieces[j]) && is_hidden(world, group[i], pieces[j]);
  };
  StepList<std::uint8_t> doubtful(count, 0, hidden.get_allocator());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count && doubtful[i] == 0; ++j) doubtful[i] = hides(j, i) ? 1 : 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (doubtful[i] == 0) continue;
    for (std::size_t j = 0; j < count; ++j)
      if (doubtful[j] == 0 && hides(j, i)) hidden[group[i].contact] = 1;
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
    if (begin != end) pair.touching = pair.contact_count > 0;
  }
  world.contacts.resize(kept);
}

}  // namespace

void drop_hidden_contacts(WorldState& world) {
  StepList<Touch> touches(&world.memory);
  list_touches(world, touches);
  const auto whole = [](const Touch& t) { return std::pair(t.mover, t.rigid); };
  std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return std::tuple(a.mover, a.rigid, a.contact, a.of_b) <
           std::tuple(b.mover, b.rigid, b.contact, b.of_b);
  });
  StepList<std::uint8_t> hidden(world.contacts.size(), 0, &world.memory);
  for (std::size_t begin = 0, end; begin < touches.size(); begin = end) {
    for (end = begin + 1; end < touches.size() && whole(touches[end]) == whole(touches[begin]);)
      ++end;
    if (end - begin > 1) find_hidden(world, std::span(touches).subspan(begin, end - begin), hidden);
  }
  if (std::find(hidden.begin(), hidden.end(), 1) != hidden.end()) take_out(world, hidden);
}

}  // namespace plumb::inline PLUMB_ABI::detail
