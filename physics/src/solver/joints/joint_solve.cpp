// Warm start and passes (joint_solver.h has the equations).
#include <cmath>

#include "solver/joints/coordinates.h"
#include "solver/joints/joint_laws.h"
#include "solver/joints/joint_motion.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Whether a limit that is hit in this substep bounces, and how fast it is hit: the slower of the
// speeds before and after the forces, so that no bounce gains energy.
void note_approach(JointRow& row, const FreeRow& free, Real now) {
  const Real before = row.rate;
  row.approach = std::abs(before) < std::abs(now) ? before : now;
  Real pushed = 0;
  for (const RowPart side : {kLower, kUpper})
    pushed = std::max(pushed, row.impulses.first[side] + row.impulses.second[side]);
  row.may_bounce = free.restitution > Real(0) && !(pushed > Real(0)) &&
                   std::abs(row.approach) > joint_tolerance::kBounceCut * std::abs(now - before);
}

// Parts of three rows that are bounded together, as a vector.
struct VectorBound {
  int first = 0;  // free row
  RowPart part = kFriction;
  Real size = 0;  // [N s] or [N m s]
};

// The passes over one piece.
class PieceSolver {
 public:
  PieceSolver(WorldState& world, const JointPiece& piece, JointPass pass)
      : world_(world),
        scratch_(*world.joints.scratch),
        piece_(piece),
        pass_(pass),
        h_(piece.h),
        closed_(closed_enough(world)) {}

  void run() {
    if (pass_ == JointPass::Relax) {
      search(false);
      return;
    }
    remember(&JointRow::begun);
    if (search(true)) return;
    take_back(&JointRow::begun);
    search(false);
  }

 private:
  // Newton's steps. `ahead`: held rows and springs are to be right where their bodies will have
  // turned to at the end of the substep; else at the present rates, which only projects velocities.
  // Returns false where looking ahead came to nothing: bodies turn by more than a radian in the
  // substep, laws let go and grip again, and in the end all is farther off than it was.
  bool search(bool ahead) {
    ahead_ = ahead;
    bool clamped = false;
    int arrived = 0;  // steps since a law last hit its bound that saw where coordinates arrive
    Real before = 0, first = kUnlimited;
    linear_ = true;
    for (int step = 0; step < joint_tolerance::kMostNewtonSteps; ++step) {
      const bool changed = choose_laws(!clamped) || step == 0;
      if (ahead && !linear_) first = std::min(first, std::max(error_, joint_tolerance::kFarOff));
      if (arrived > 0 && !changed && !clamped) {
        if (!ahead || error_ <= closed_) return true;
        // Newton's method has come too far from where it began: turns by more than a radian in a
        // substep. The step before is taken back; what is left loses energy, but never gains it.
        if (arrived > (stiff_ ? 0 : 1) && error_ > before) {
          take_back(&JointRow::kept);
          return true;
        }
        if (arrived > 1 && error_ > joint_tolerance::kSlowStep * before) return true;
      }
      before = error_;
      if (ahead && !linear_) remember(&JointRow::kept);
      if (changed) factor_piece(scratch_.system, scratch_.blocks, piece_);
      find_impulses();
      clamped = give_impulses();
      if (!has_laws_ && !ahead) return true;
      // Where an impulse was cut off the held rows are yet to follow: such velocities say nothing
      // about where coordinates arrive.
      arrived = clamped || (ahead && linear_) ? 0 : arrived + 1;
      linear_ = clamped;
    }
    if (clamped) hold_only();
    if (!ahead) return true;
    linear_ = false;
    choose_laws(false);
    return error_ <= joint_tolerance::kAstray * first;
  }

  struct Now {
    Real rate[kMaxJointRows] = {}, end[kMaxJointRows] = {};
  };

  SystemRow* rows_of(std::uint32_t i) {
    return &scratch_.system.rows[std::size_t{kMaxJointRows} * i];
  }
  [[nodiscard]] Real time(const JointBlock& block) const {
    return block.split ? Real(0.5) * h_ : h_;
  }
  // [m] or [rad] by which errors of a row are measured.
  [[nodiscard]] static Real size_of(const JointBlock& block, int row) {
    return is_linear(block.row[row].coordinate) ? block.size : Real(1);
  }
  [[nodiscard]] bool second(const JointBlock& block) const {
    return block.split && pass_ == JointPass::Relax;
  }

  // Rates, and the coordinates at the end of the substep at these rates.
  [[nodiscard]] Now look(const JointBlock& block) const {
    const BlockVelocities u = read_velocities(world_, block);
    Now now;
    for (int i = 0; i < block.rows; ++i) {
      now.rate[i] = row_rate(block, i, u);
      now.end[i] = block.row[i].value + h_ * now.rate[i];
    }
    if (linear_ || !ahead_) return now;
    Moved moved[kMaxJointBodies];
    for (int k = 0; k < block.bodies; ++k) {
      if (block.body[k] == 0) continue;
      const SubstepBody& s = world_.substep[block.body[k]];
      moved[k] = drifted(moved_now(world_, block, k), u.v[k], u.w[k], s.I, s.I_inverse, h_);
    }
    coordinates_at(block, moved, now.end);
    return now;
  }
  [[nodiscard]] RowMoment moment(const JointBlock& block, const Now& now, int f) const {
    return {pass_, h_, now.rate[block.held + f], now.end[block.held + f]};
  }

  [[nodiscard]] int vector_bounds(const JointBlock& block, VectorBound bounds[3]) const {
    int count = 0;
    if (block.friction_group >= 0)
      bounds[count++] = {block.friction_group, kFriction,
                         time(block) * block.free[block.friction_group].friction};
    for (int g = 0; g < block.motor_groups; ++g)
      if (std::isfinite(block.free[3 * g].max_effort))
        bounds[count++] = {3 * g, kMotor, time(block) * block.free[3 * g].max_effort};
    return count;
  }
  // Whether free row f resists turning together with two others, and limits bound the turn as well.
  [[nodiscard]] static bool beside_limits(const JointBlock& block, int f) {
    return block.friction_group > 0 && f >= block.friction_group;
  }
  // By how much a spring that acts like a rigid hold will miss its place, in sizes or radians [-].
  [[nodiscard]] Real error_of(const JointBlock& block, int f, const Law& law) const {
    const Real S = block.free_inverse_mass[f];
    return std::abs(law.lack * h_) * (S / (S + law.give)) / size_of(block, block.held + f);
  }
  // The law of part `part` of a free row.
  [[nodiscard]] Law law_of(const JointBlock& block, const Now& now, int f, RowPart part) const {
    Law laws[kMaxLaws];
    const int count = laws_of(block, f, moment(block, now, f), laws);
    for (int i = 0; i < count; ++i)
      if (laws[i].part == part) return laws[i];
    return {};
  }
  // Where three parts would go by themselves, and whether that lies within their bound.
  bool vector_acts(const JointBlock& block, const Now& now, const VectorBound& bound,
                   Real wanted[3]) const {
    Real square = 0;
    for (int k = 0; k < 3; ++k) {
      const Law law = law_of(block, now, bound.first + k, bound.part);
      const Real S = block.free_inverse_mass[bound.first + k];
      wanted[k] = S + law.give > Real(0) ? law.impulse - law.lack / (S + law.give) : law.impulse;
      square += wanted[k] * wanted[k];
    }
    return square < bound.size * bound.size;
  }

  // Which laws act, and by how much every row misses what it asks for. Returns whether other rows
  // act than before. Unless any may enter, those that act are among those that did.
  bool choose_laws(bool may_enter) {
    bool changed = false;
    has_laws_ = false;
    error_ = Real(0);
    stiff_ = false;
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
      const JointBlock& block = scratch_.blocks[i];
      const Now now = look(block);
      SystemRow* rows = rows_of(i);
      for (int k = 0; k < block.held; ++k) {
        const JointRow& row = block.row[k];
        rows[k].acts = true;
        rows[k].give = 0;
        Real lack = now.rate[k];
        if (pass_ == JointPass::Solve) {
          lack = (now.end[k] - row.value) / h_;
        }
        rows[k].value = -static_cast<double>(lack);
        error_ = std::max(error_, std::abs(lack * h_) / size_of(block, k));
      }
      VectorBound bounds[3];
      bool acts[3];
      Real wanted[3] = {};
      const int bound_count = vector_bounds(block, bounds);
      for (int b = 0; b < bound_count; ++b) acts[b] = vector_acts(block, now, bounds[b], wanted);
      for (int f = 0; f < block.rows - block.held; ++f) {
        Law laws[kMaxLaws];
        const int count = laws_of(block, f, moment(block, now, f), laws);
        has_laws_ = has_laws_ || count > 0;
        SystemRow next;
        double G = 0, sum = 0;
        for (int k = 0; k < count; ++k) {
          bool in = laws[k].acts();
          for (int b = 0; b < bound_count; ++b)
            if (laws[k].part == bounds[b].part && f >= bounds[b].first && f < bounds[b].first + 3)
              in = acts[b];
          // Rates while held rows do not hold say nothing about who wants in.
          if (!may_enter)
            in = laws[k].inside() && (rows[block.held + f].laws & 1u << laws[k].part) != 0;
          if (!in || !(laws[k].soft || rigid_laws_)) continue;
          next.lack[laws[k].part] = laws[k].lack;
          if (laws[k].soft) {
            next.laws |= 1u << laws[k].part;
            G += 1 / static_cast<double>(laws[k].give);
            sum += static_cast<double>(laws[k].lack) / static_cast<double>(laws[k].give);
            if (laws[k].stiff) error_ = std::max(error_, error_of(block, f, laws[k]));
            stiff_ = stiff_ || laws[k].stiff;
          } else {  // the last one wins: limits over friction over motors
            if (next.rigid >= 0) next.laws &= ~(1u << next.rigid);
            next.rigid = static_cast<int>(laws[k].part);
            next.laws |= 1u << laws[k].part;
            next.value = -static_cast<double>(laws[k].lack);
          }
        }
        // Friction that sticks holds what limits hold as well.
        if (next.rigid == kFriction && beside_limits(block, f))
          next.give =
              joint_tolerance::kFrictionGive * static_cast<double>(block.free_inverse_mass[f]);
        next.acts = next.laws != 0;
        if (next.rigid < 0 && G > 0) {
          next.give = 1 / G;
          next.value = -sum / G;
        }
        SystemRow& row = rows[block.held + f];
        changed = changed || next.laws != row.laws;
        next.size = row.size;
        next.rate = now.rate[block.held + f];
        row = next;
      }
    }
    return changed;
  }

  // What pushes, rubs and drives is left as it is; what is held holds, and springs follow.
  void hold_only() {
    linear_ = true;
    rigid_laws_ = false;
    choose_laws(false);
    factor_piece(scratch_.system, scratch_.blocks, piece_);
    find_impulses();
    give_impulses();
    rigid_laws_ = true;
  }

  void find_impulses() {
    JointSystem& system = scratch_.system;
    if (pass_ == JointPass::Solve && piece_.loops) {
      // The compliance is felt by the whole impulse, so that loops cannot build up any against
      // themselves.
      for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
        const JointBlock& block = scratch_.blocks[i];
        SystemRow* rows = rows_of(i);
        for (int k = 0; k < block.held; ++k)
          rows[k].value -= joint_tolerance::kLoopCompliance * rows[k].size *
                           static_cast<double>(block.row[k].impulses.first[kHold]);
      }
    }
    solve_factored(system, scratch_.blocks, piece_);
  }

  // Applies the impulses and shares them out among the laws. Returns whether some bound was hit.
  bool give_impulses() {
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
      JointBlock& block = scratch_.blocks[i];
      const SystemRow* rows = rows_of(i);
      Real l[kMaxJointRows];
      for (int k = 0; k < block.rows; ++k) l[k] = static_cast<Real>(rows[k].value);
      for (int k = 0; k < block.held; ++k) {
        RowImpulses& impulses = block.row[k].impulses;
        (second(block) ? impulses.second : impulses.first)[kHold] += l[k];
      }
      change(block, l);
    }
    if (!has_laws_) return false;
    bool clamped = false;
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i)
      clamped = share_out(scratch_.blocks[i], rows_of(i)) || clamped;
    return clamped;
  }
  void remember(RowImpulses JointRow::*as) {
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
      JointBlock& block = scratch_.blocks[i];
      for (int k = 0; k < block.rows; ++k) block.row[k].*as = block.row[k].impulses;
    }
  }
  void take_back(RowImpulses JointRow::*to) {
    for (std::uint32_t i = piece_.begin; i < piece_.end; ++i) {
      JointBlock& block = scratch_.blocks[i];
      Real l[kMaxJointRows];
      for (int k = 0; k < block.rows; ++k) {
        JointRow& row = block.row[k];
        l[k] = total_impulse(row.*to, false) - total_impulse(row.impulses, false);
        row.impulses = row.*to;
      }
      change(block, l);
    }
  }
  void change(const JointBlock& block, const Real* l) {
    BlockVelocities u = read_velocities(world_, block);
    apply_impulses(block, l, u);
    write_velocities(world_, block, u);
  }

  bool share_out(JointBlock& block, const SystemRow* rows) {
    const Now now = look(block);
    Real missing[kMaxJointRows] = {};
    bool clamped = false;
    for (int f = 0; f < block.rows - block.held; ++f) {
      const SystemRow& row = rows[block.held + f];
      Law laws[kMaxLaws];
      const int count = laws_of(block, f, moment(block, now, f), laws);
      const Real given = static_cast<Real>(row.value);
      Real shared = 0;
      const auto give = [&](const Law& law, Real impulse) {
        const Real kept = std::min(std::max(impulse, law.lower), law.upper);
        set_impulse(block, f, pass_, law.part, kept);
        shared += kept - law.impulse;
        return kept != impulse;
      };
      for (int k = 0; k < count; ++k) {
        const Law& law = laws[k];
        const bool acted = (row.laws & 1u << law.part) != 0;
        if (law.soft && acted) {
          // What the system said. Asked where its body came in truth, after a turn by a good part
          // of a radian, a spring would answer with more than it can take back.
          const Real lack = row.lack[law.part] + (now.rate[block.held + f] - row.rate);
          clamped = give(law, law.impulse - lack / law.give) || clamped;
        } else if (!acted && (law.impulse < law.lower || law.impulse > law.upper)) {
          give(law, law.impulse);  // the bounds have come closer since it was found
          clamped = true;
        }
        // A motor that works against a limit or against friction gives all it has.
        if (!law.soft && row.rigid >= 0 && law.part != row.rigid && law.acts()) {
          const Real end = law.lack > Real(0) ? law.lower : law.upper;
          if (std::abs(law.lack) > kNoLack && std::isfinite(end)) give(law, end);
        }
      }
      for (int k = 0; k < count; ++k)
        if (laws[k].part == row.rigid)
          clamped = give(laws[k], laws[k].impulse + given - shared) || clamped;
      missing[block.held + f] = shared - given;
    }
    clamped = bound_vectors(block, now, rows, missing) || clamped;
    for (int f = 0; f < block.rows - block.held; ++f) settle_unlimited_motor(block, f, pass_);
    bool any = false;
    for (int k = block.held; k < block.rows; ++k) any = any || missing[k] != Real(0);
    if (any) change(block, missing);
    return clamped;
  }

  // Three rows beyond their common bound slide: a projected step, whose fixed point opposes the
  // motion exactly.
  bool bound_vectors(JointBlock& block, const Now& now, const SystemRow* rows, Real* missing) {
    VectorBound bounds[3];
    bool clamped = false;
    const int count = vector_bounds(block, bounds);
    for (int b = 0; b < count; ++b) {
      Real wanted[3] = {}, square = 0;
      const bool acted = (rows[block.held + bounds[b].first].laws & 1u << bounds[b].part) != 0;
      if (acted) {
        for (int k = 0; k < 3; ++k)
          wanted[k] = law_of(block, now, bounds[b].first + k, bounds[b].part).impulse;
      } else {
        vector_acts(block, now, bounds[b], wanted);
      }
      for (int k = 0; k < 3; ++k) square += wanted[k] * wanted[k];
      if (acted && !(square > bounds[b].size * bounds[b].size)) continue;
      const Real scale =
          square > bounds[b].size * bounds[b].size ? bounds[b].size / std::sqrt(square) : Real(1);
      for (int k = 0; k < 3; ++k) {
        const int f = bounds[b].first + k;
        const Real before = law_of(block, now, f, bounds[b].part).impulse;
        const Real step = scale * wanted[k] - before;
        set_impulse(block, f, pass_, bounds[b].part, scale * wanted[k]);
        missing[block.held + f] += step;
        clamped = clamped || std::abs(step) > kSameImpulse * bounds[b].size;
      }
    }
    return clamped;
  }

  // Speeds [m/s, rad/s] below which nothing is asked for, and impulses that are as good as equal,
  // relative to their bound [-].
  static constexpr Real kNoLack = Real(100) * std::numeric_limits<Real>::epsilon();
  static constexpr Real kSameImpulse = Real(1e-3);

  WorldState& world_;
  JointScratch& scratch_;
  const JointPiece& piece_;
  JointPass pass_;
  Real h_;
  Real closed_;         // [-] as error_, where Newton's steps end
  bool ahead_ = false;  // at the end of the substep, else at the present rates
  bool linear_ = true;  // the end of the substep by the present rates
  bool has_laws_ = false;
  bool rigid_laws_ = true;  // limits, motors and frictions take part
  bool stiff_ = false;      // some spring acts like a rigid hold
  Real error_ = 0;  // largest [-] by which a held coordinate will be off, in sizes or radians
};

}  // namespace

void note_approaches(JointBlock& block, const WorldState& world) {
  const BlockVelocities u = read_velocities(world, block);
  for (int i = block.held; i < block.rows; ++i)
    note_approach(block.row[i], block.free[i - block.held], row_rate(block, i, u));
}

void warm_start_joint(WorldState& world, JointBlock& block, JointPass pass) {
  const bool second = pass == JointPass::Relax;
  if (second && !block.split) return;  // one impulse for both passes: it is there already
  BlockVelocities u = read_velocities(world, block);
  Real impulse[kMaxJointRows] = {};
  for (int i = 0; i < block.rows; ++i) {
    RowImpulses& impulses = block.row[i].impulses;
    if (i >= block.held) {
      const FreeRow& row = block.free[i - block.held];
      if (!second) {
        note_approach(block.row[i], row, row_rate(block, i, u));
      } else {
        // The second part of what springs do follows from the first.
        const auto rest = [](Real share) { return (Real(1) - share) / share; };
        impulses.second[kSpring] = rest(row.spring_share) * impulses.first[kSpring];
        if (row.servo && row.servo_frequency > Real(0))
          impulses.second[kMotor] = rest(row.servo_share) * impulses.first[kMotor];
        if (row.limit_frequency > Real(0)) {
          for (const RowPart side : {kLower, kUpper})
            impulses.second[side] = rest(row.limit_share) * impulses.first[side];
        } else {
          for (const RowPart side : {kLower, kUpper})
            impulses.second[side] = std::max(impulses.second[side], -impulses.first[side]);
        }
      }
    }
    impulse[i] = total_impulse(impulses, second);
  }
  apply_impulses(block, impulse, u);
  write_velocities(world, block, u);
}

void solve_joints_of(WorldState& world, const JointPiece& piece, JointPass pass) {
  PieceSolver(world, piece, pass).run();
}

void note_rates(JointBlock& block, const WorldState& world) {
  const BlockVelocities u = read_velocities(world, block);
  for (int i = block.held; i < block.rows; ++i) block.row[i].rate = row_rate(block, i, u);
}

void sum_joint(JointBlock& block, const WorldState& world, JointPass pass) {
  if (!block.split && pass == JointPass::Solve) return;  // the relaxing pass changes it yet
  const bool second = block.split && pass == JointPass::Relax;
  const int b = block.place[1];
  const Vec arm = rotate(moved_now(world, block, b).dq, block.pair[0].arm_b);
  for (int i = 0; i < block.rows; ++i) {
    JointRow& row = block.row[i];
    const Real* part = second ? row.impulses.second : row.impulses.first;
    for (int p = 0; p < kRowParts; ++p) row.sum[p] += part[p];
    const BodyJacobian& J = block.J[i * block.bodies + b];
    const Real l = total_impulse(row.impulses, second);
    block.force_sum += l * J.linear;
    block.torque_sum += l * (J.angular - cross(arm, J.linear));
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
