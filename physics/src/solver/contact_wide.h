// The contact kernel over blocks of W rows. Included by one file per vector length, each compiled
// for its own processors, with PLUMB_VECTOR_BITS set.
//
// Only names of block_pass.h are shared (math/wide_abi.h), and they are plain memory.
#include "solver/block_pass.h"
// Not before the shared header, not after the others.
#include "math/wide_abi.h"
//
#include "solver/body_kernel.h"
#include "solver/contact_kernel.h"
#include "solver/row_responses.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

namespace shared = plumb::PLUMB_SHARED_ABI::detail;
using shared::BlockHead;
using shared::BlockPass;
using shared::BodyPass;

constexpr int kLanes = PLUMB_VECTOR_BITS / (8 * static_cast<int>(sizeof(Real)));
static_assert(kLanes <= BlockHead::kMostLanes);
using Number = Wide<Real, kLanes>;

template <int P>
struct RowBlock : RowNumbers<Number, P> {
  static constexpr int count = P;
};

constexpr std::size_t kRecord = 8;  // [Real] of BodyVelocity and of BodyDelta

// The bodies of a block: read once, written once. Load and sliding load pass through.
class BlockBodies {
 public:
  BlockBodies(const BlockPass& pass, const BlockHead& head)
      : pass_(pass),
        head_(head),
        linear_a_(gather_quad<Real, kLanes>(pass.velocity, kRecord, head.body_a)),
        angular_a_(gather_quad<Real, kLanes>(pass.velocity + 4, kRecord, head.body_a)),
        linear_b_(gather_quad<Real, kLanes>(pass.velocity, kRecord, head.body_b)),
        angular_b_(gather_quad<Real, kLanes>(pass.velocity + 4, kRecord, head.body_b)) {}

  [[nodiscard]] RowVelocities<Number> velocities() const {
    return {{linear_a_.x, linear_a_.y, linear_a_.z},
            {angular_a_.x, angular_a_.y, angular_a_.z},
            {linear_b_.x, linear_b_.y, linear_b_.z},
            {angular_b_.x, angular_b_.y, angular_b_.z},
            {},
            {}};
  }
  [[nodiscard]] DeltaOf<Number> delta(const std::uint32_t* body) const {
    const auto p = gather_quad<Real, kLanes>(pass_.delta, kRecord, body);
    const auto q = gather_quad<Real, kLanes>(pass_.delta + 4, kRecord, body);
    return {{p.x, p.y, p.z}, {q.x, q.y, q.z, q.w}};
  }
  [[nodiscard]] Vector3<Number> shift(const std::uint32_t* body) const {
    const auto p = gather_quad<Real, kLanes>(pass_.delta, kRecord, body);
    return {p.x, p.y, p.z};
  }
  void add_load(Number load, Number sliding) {
    linear_a_.w += load;
    linear_b_.w += load;
    angular_a_.w += sliding;
    angular_b_.w += sliding;
  }
  void write(const RowVelocities<Number>& u) const {
    put(u.va, linear_a_.w, 0, head_.body_a, head_.writes_a);
    put(u.wa, angular_a_.w, 4, head_.body_a, head_.writes_a);
    put(u.vb, linear_b_.w, 0, head_.body_b, head_.writes_b);
    put(u.wb, angular_b_.w, 4, head_.body_b, head_.writes_b);
  }

 private:
  void put(const Vector3<Number>& value, Number fourth, std::size_t at, const std::uint32_t* body,
           std::uint32_t which) const {
    scatter_quad<Real, kLanes>({value.x, value.y, value.z, fourth}, pass_.velocity + at, kRecord,
                               body, which);
  }
  const BlockPass& pass_;
  const BlockHead& head_;
  Quad<Real, kLanes> linear_a_, angular_a_, linear_b_, angular_b_;
};

template <int P>
RowBlock<P>& numbers_of(const BlockPass& pass, const BlockHead& head) {
  return *reinterpret_cast<RowBlock<P>*>(pass.numbers + head.numbers);
}

// Each of these is one stretch of arithmetic on registers: calls in it would pass them by memory.
#define PLUMB_ONE_STRETCH [[gnu::flatten]]

template <int P>
void prepare_rows(const BlockPass& pass, const BlockHead& head) {
  RowBlock<P>& row = numbers_of<P>(pass, head);
  make_responses(row);
  choose_softness(row);
}

template <int P>
PLUMB_ONE_STRETCH void warm_rows(const BlockPass& pass, const BlockHead& head) {
  const RowBlock<P>& row = numbers_of<P>(pass, head);
  BlockBodies bodies(pass, head);
  RowVelocities<Number> u = bodies.velocities();
  place_arms(row, bodies.shift(head.body_a), bodies.shift(head.body_b), u);
  warm_start(row, u);
  bodies.write(u);
}

void mark(const BlockPass& pass, const BlockHead& head, std::uint32_t lanes) {
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
    const int i = __builtin_ctz(left);
    if ((head.writes_a >> i & 1u) != 0) pass.contacts_changed[head.body_a[i]] = 1;
    if ((head.writes_b >> i & 1u) != 0) pass.contacts_changed[head.body_b[i]] = 1;
  }
}

// The soft pass, or the relaxing one, which also tells the bodies what they carry.
template <int P, bool kRelaxes>
PLUMB_ONE_STRETCH void sweep_block(const BlockPass& pass, const BlockHead& head) {
  RowBlock<P>& row = numbers_of<P>(pass, head);
  BlockBodies bodies(pass, head);
  RowVelocities<Number> u = bodies.velocities();
  const DeltaOf<Number> da = bodies.delta(head.body_a), db = bodies.delta(head.body_b);
  place_arms(row, da.dp, db.dp, u);
  const SeparationChange<Number> change = separation_change(row, da, db);
  Number load, sliding;
  solve_normal(row, change, Number(pass.inverse_h), !kRelaxes, u);
  solve_friction(row, u, load, sliding);
  if (kRelaxes) bodies.add_load(load, sliding);
  bodies.write(u);
  if (!kRelaxes) return;
  // Between two dynamic bodies the shift of the trapezoid would not keep their angular momentum.
  mark(pass, head, bits_of(load > Number(0)) & head.writes_a & head.writes_b);
  if (pass.ends_substep) mark(pass, head, bits_of(end_substep(row)) & head.lanes);
}
template <int P>
void solve_rows(const BlockPass& pass, const BlockHead& head) {
  sweep_block<P, false>(pass, head);
}
template <int P>
void relax_rows(const BlockPass& pass, const BlockHead& head) {
  sweep_block<P, true>(pass, head);
}

// W consecutive bodies. Which quads of a record hold what: see the records (body_store.h,
// contact_row.h).
class Bodies {
 public:
  Bodies(const BodyPass& pass, std::uint32_t first, std::uint32_t which)
      : pass_(pass),
        first_(first),
        which_(which),
        velocity_(read(pass.velocity, 8)),
        spin_(read(pass.velocity + 4, 8)) {
    const auto L = read(pass.momentum, 4), J = read(pass.mass + 4, 12);
    const auto p = read(pass.delta, 8), dq = read(pass.delta + 4, 8);
    const auto q = read(pass.orientation, pass.pose_stride);
    lanes = {three(velocity_),         three(spin_),         three(L), three(p),
             {dq.x, dq.y, dq.z, dq.w}, {q.x, q.y, q.z, q.w}, three(J)};
  }
  BodyLanes<Number> lanes;

  [[nodiscard]] Vector3<Number> acceleration() const { return of_substep(12); }
  [[nodiscard]] Vector3<Number> v_start() const { return of_substep(0); }
  [[nodiscard]] Vector3<Number> L_start() const { return of_substep(4); }
  [[nodiscard]] Vector3<Number> w_in() const { return of_substep(8); }
  [[nodiscard]] Vector3<Number> torque() const { return three(read(pass_.force + 4, 8)); }
  [[nodiscard]] Symmetric3<Number> inertia() const {
    const auto a = read(pass_.substep + 16, 32), b = read(pass_.substep + 20, 32);
    return {a.x, a.y, a.z, a.w, b.x, b.y};
  }

  void write_start() const {
    write(lanes.v, read(pass_.substep, 32).w, pass_.substep, 32);  // the stiffness stays
    write(lanes.L, Number(0), pass_.substep + 4, 32);
  }
  void write_w_in() const { write(lanes.w, Number(0), pass_.substep + 8, 32); }
  // Only bodies of `which` from here on.
  void keep(std::uint32_t which) { which_ &= which; }
  void write_momentum() const { write(lanes.L, Number(0), pass_.momentum, 4); }
  void write_velocity() const { write_velocity(velocity_.w, spin_.w); }
  void write_velocity_without_load() const { write_velocity(Number(0), Number(0)); }
  void write_delta() const {
    write(lanes.dp, Number(0), pass_.delta, 8);
    write(lanes.dq, pass_.delta + 4, 8);
  }
  void write_orientation(const Quaternion<Number>& q) const {
    write(q, pass_.orientation, pass_.pose_stride);
  }

 private:
  [[nodiscard]] Quad<Real, kLanes> read(const Real* base, std::size_t stride) const {
    return read_run<Real, kLanes>(base + first_ * stride, stride);
  }
  [[nodiscard]] static Vector3<Number> three(const Quad<Real, kLanes>& q) {
    return {q.x, q.y, q.z};
  }
  [[nodiscard]] Vector3<Number> of_substep(std::size_t at) const {
    return three(read(pass_.substep + at, 32));
  }
  void write_velocity(Number load, Number sliding) const {
    write(lanes.v, load, pass_.velocity, 8);
    write(lanes.w, sliding, pass_.velocity + 4, 8);
  }
  void write(const Quaternion<Number>& q, Real* base, std::size_t stride) const {
    write_run<Real, kLanes>({q.x, q.y, q.z, q.w}, base + first_ * stride, stride, which_);
  }
  void write(const Vector3<Number>& a, Number fourth, Real* base, std::size_t stride) const {
    write({a.x, a.y, a.z, fourth}, base, stride);
  }

  const BodyPass& pass_;
  std::size_t first_;
  std::uint32_t which_;
  Quad<Real, kLanes> velocity_, spin_;  // with the loads
};

PLUMB_ONE_STRETCH
void kick_bodies(const BodyPass& pass, std::uint32_t first, std::uint32_t which) {
  Bodies bodies(pass, first, which);
  bodies.write_start();
  kick_lanes(bodies.lanes, bodies.acceleration(), bodies.torque(), Number(pass.h));
  bodies.write_momentum();
  bodies.write_velocity();
  bodies.write_w_in();
}

PLUMB_ONE_STRETCH
std::uint32_t drift_bodies(const BodyPass& pass, std::uint32_t first, std::uint32_t which) {
  Bodies bodies(pass, first, which);
  collect_lanes(bodies.lanes, bodies.inertia(), bodies.w_in());
  const std::uint32_t done = bits_of(drift_lanes(bodies.lanes, Number(pass.h)));
  bodies.keep(done);
  bodies.write_momentum();
  bodies.write_velocity_without_load();
  bodies.write_delta();
  bodies.write_w_in();
  return which & ~done;
}

PLUMB_ONE_STRETCH
void finish_bodies(const BodyPass& pass, std::uint32_t first, std::uint32_t which,
                   const Real* weight) {
  Bodies bodies(pass, first, which);
  collect_lanes(bodies.lanes, bodies.inertia(), bodies.w_in());
  Number weights;
  for (int i = 0; i < kLanes; ++i) weights.v[i] = weight[i];
  correct_lanes(bodies.lanes, bodies.v_start(), bodies.L_start(), weights);
  bodies.write_momentum();
  bodies.write_delta();
}

PLUMB_ONE_STRETCH
std::uint32_t fly_bodies(const BodyPass& pass, std::uint32_t first, std::uint32_t which) {
  Bodies bodies(pass, first, which);
  Quaternion<Number> q;
  const std::uint32_t done =
      bits_of(fly_lanes(bodies.lanes, q, bodies.acceleration(), bodies.torque(), Number(pass.dt)));
  bodies.keep(done);
  bodies.write_momentum();
  bodies.write_velocity();
  bodies.write_delta();
  bodies.write_orientation(q);
  return which & ~done;
}

// Calls the version of a block kernel for the block's number of points.
#define PLUMB_FOR_EACH_BLOCK(kernel)                                  \
  [](const BlockPass& pass, std::uint32_t begin, std::uint32_t end) { \
    for (std::uint32_t i = begin; i < end; ++i) {                     \
      const BlockHead& head = pass.heads[i];                          \
      switch (head.points) {                                          \
        case 1:                                                       \
          kernel<1>(pass, head);                                      \
          break;                                                      \
        case 2:                                                       \
          kernel<2>(pass, head);                                      \
          break;                                                      \
        case 3:                                                       \
          kernel<3>(pass, head);                                      \
          break;                                                      \
        default:                                                      \
          kernel<4>(pass, head);                                      \
          break;                                                      \
      }                                                               \
    }                                                                 \
  }

}  // namespace
}  // namespace plumb::inline PLUMB_ABI::detail

namespace plumb::inline PLUMB_SHARED_ABI::detail {

BlockKernel PLUMB_JOIN(block_kernel_, PLUMB_VECTOR_BITS, )() {
  namespace here = plumb::PLUMB_ABI::detail;
  using here::prepare_rows, here::relax_rows, here::solve_rows, here::warm_rows;
  BlockKernel kernel;
  kernel.lanes = here::kLanes;
  kernel.prepare = PLUMB_FOR_EACH_BLOCK(prepare_rows);
  kernel.warm = PLUMB_FOR_EACH_BLOCK(warm_rows);
  kernel.solve = PLUMB_FOR_EACH_BLOCK(solve_rows);
  kernel.relax = PLUMB_FOR_EACH_BLOCK(relax_rows);
  kernel.kick = here::kick_bodies;
  kernel.drift = here::drift_bodies;
  kernel.finish = here::finish_bodies;
  kernel.fly = here::fly_bodies;
  return kernel;
}

}  // namespace plumb::inline PLUMB_SHARED_ABI::detail
