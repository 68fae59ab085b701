// All that a world is: its pools, and the scratch lists of the running step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "collision/aabb_tree.h"
#include "effects/effect_store.h"
#include "math/eigen_bridge.h"
#include "plumb/world.h"
#include "solver/adhesion.h"
#include "solver/contact_row.h"
#include "solver/newton/choose.h"
#include "solver/step_groups.h"
#include "solver/surface_drive.h"
#include "solver/turned_rows.h"
#include "solver/turning_row.h"
#include "world/body_store.h"
#include "world/collider_store.h"
#include "world/contact_data.h"
#include "world/joint_store.h"
#include "world/ledger.h"
#include "world/pair_store.h"
#include "world/step_memory.h"
#include "world/world_image.h"

namespace plumb::inline PLUMB_ABI::detail {

namespace newton {
struct Solver;  // solver/newton/newton_solver.h
}

// Bodies that fell asleep together, with the contacts among them and their supports.
struct SleepingIsland {
  bool used = false;
  std::vector<std::uint32_t> bodies;  // slots, ascending
  std::vector<Pair> pairs;            // by key
  std::vector<Contact> contacts;      // theirs
};

struct EventLists {
  std::vector<ContactEvent> contacts;
  std::vector<HitEvent> hits;
  std::vector<SensorEvent> sensors;
  std::vector<SleepEvent> sleep;
  std::vector<QuarantineEvent> quarantined;
  std::vector<JointBreakEvent> broken_joints;
  void clear() {
    contacts.clear();
    hits.clear();
    sensors.clear();
    sleep.clear();
    quarantined.clear();
    broken_joints.clear();
  }
};

// A sensor event as a change of the list of overlaps; the last of a pair counts.
struct OverlapChange {
  SensorOverlap overlap;
  std::uint32_t order = 0;
  bool inside = false;
};

// Which work the running step has, decided once at its start from a few counts.
struct StepFlags {
  bool gravity = false;
  bool sleeping = false;
  bool sensors = false;
};

// Counts by which the plan knows what a scene calls for; kept up to date when bodies and colliders
// come, go and change, so that planning a step takes a few integer tests.
struct SceneCounts {
  std::uint32_t kinematic = 0;  // bodies
  std::uint32_t sensors = 0;
  std::uint32_t restitution = 0;  // colliders with restitution > 0
  std::uint32_t turning = 0;      // ... with rolling or torsional friction
  std::uint32_t driven = 0;       // ... whose surface runs
  std::uint32_t one_way = 0;      // ... that are solid from one side only
  std::uint32_t grained = 0;      // ... with less friction along a grain
  std::uint32_t adhesive = 0;     // ... with adhesion
};

// What the narrowphase found in one pair, before anything is changed.
struct PairFindings {
  std::uint32_t first = 0, count = 0;  // contacts, within its chunk's list ...
  bool kept = false;                   // ... or those of the last step, told anew where they lie
  bool asked = false;                  // for the reach of its colliders
  bool gone = false;                   // the bounds are apart, or all sleeps
  bool overlaps = false;               // sensors: whether they see the other
  Passage passage = Passage::Apart;
  PairMemory memory;
};

// What is known of a collider's box and reach, so that most of them need not be looked at.
struct BoxNotes {
  bool paired = false;     // in some awake pair: only then anything reads its reach
  bool is_new = false;     // a new box since pairs were last asked whether they are gone
  bool old_reach = false;  // the reach is an earlier step's
};

// One colour: rows among which no two share a dynamic body.
struct ColorRange {
  std::uint32_t begin, end;
};

// How a body goes through the step (solver/plain_bodies.h).
// Of a flagged body that moved far: its place among those, a collider of another one near its path.
using FastOthers = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

enum class BodyWay : std::uint8_t { Other, Held, Free };

// What rows did to a body in a substep, and by how much that differed from the one before, summed
// over the step (solver/step_levels.h).
struct StepError {
  Vec dv{0, 0, 0};  // [m/s]
  Real sum = 0;     // [m/s] at the body's farthest point
  Vec dL{0, 0, 0};  // [kg m^2/s]
};

struct WorldState {
  WorldSettings settings;
  BodyStore bodies;
  ColliderStore colliders;
  ColliderTrees trees;
  std::vector<WorldAabb> reach;          // per collider slot: all its places in the next step
  std::vector<BoxNotes> box_notes;       // per collider slot
  std::vector<std::uint32_t> new_boxes;  // collider slots whose boxes are noted as new
  PairStore pairs;
  std::vector<Contact> contacts;   // of the awake pairs, in their order
  std::uint64_t contacts_fit = 0;  // pairs.changes() for which Contact::seen_from holds
  JointStore joints;
  ContactData contact_data;
  std::shared_ptr<EffectStore> effects;  // null until there was one
  bool has_effects = false;              // there is one now; kept by note_effects()
  std::vector<SensorOverlap> overlaps;   // after the last step, ascending
  std::vector<SleepingIsland> islands;
  std::vector<std::uint32_t> free_islands;
  SceneCounts counts;
  JobSystem* jobs = nullptr;
  std::vector<StepObserver*> observers;
  StepDiagnostics diagnostics;
  std::vector<InputRecord> inputs;  // since the last step; kept only while somebody observes
  bool stepping = false;
  bool replaying_input = false;
  double time = 0;
  std::uint64_t step_count = 0;
  StepReport report;

  // --- scratch of the running step (kept between steps for its storage) ---
  StepMemory memory;
  StepFlags flags;
  Real dt = 0, h = 0;                         // [s] step, substep
  Real falls_in_a_step = 0;                   // [m] g dt^2
  Real last_h = 0;                            // [s] substep to which the remembered impulses belong
  bool deep_overlap = false;                  // some contact of this step begins far inside
  std::vector<std::uint8_t> overlaps_deeply;  // per dense body, only then: whether it has one
  std::vector<std::uint32_t> tumbled;         // slots: only within the last step (deep_bodies.h)
  Real proxy_dt = 0;                          // [s] step for which the boxes reach ahead
  std::vector<std::uint32_t> row_order;       // contacts by colour
  std::vector<ColorRange> colors;
  std::vector<ContactRow<Real>> rows;  // in colour order
  std::vector<std::uint32_t> bouncing_rows;
  std::vector<SpinningRow> spinning_rows;
  std::vector<TurnedRow> turned_rows;
  std::vector<AdhesiveRow> adhesive_rows;
  std::shared_ptr<newton::Solver> newton;      // null until a step calls for it
  newton::Calls newton_calls;                  // of the last step
  std::vector<TurningRow<Real>> turning_rows;  // of the rows that resist turning
  std::vector<BodyDelta> delta;                // per dense index
  std::vector<SubstepBody> substep;            // per dense index
  std::vector<std::uint8_t> contacts_changed;  // per dense index: other points carry load now
  std::vector<BodyWay> body_ways;              // per dense index
  StepGroups groups;
  std::vector<StepError> step_errors;     // per dense index; only with a tolerance
  std::vector<std::uint64_t> color_mask;  // per dense index
  std::vector<std::uint32_t> parents;     // union-find, per slot
  std::vector<std::uint64_t> new_keys;
  std::vector<std::vector<std::uint64_t>> new_keys_by_chunk;
  std::vector<Pair> new_pairs;
  std::vector<PairFindings> findings;  // per awake pair
  std::vector<std::vector<Contact>> contacts_by_chunk;
  std::vector<Contact> new_contacts;
  std::vector<std::uint32_t> bodies_to_wake;
  std::vector<std::vector<std::uint32_t>> fast_by_chunk;  // bodies that moved far
  std::vector<FastOthers> fast_others_by_chunk;
  std::vector<std::uint32_t> query_list;  // collider slots whose pairs must be sought
  std::vector<std::uint32_t> touched;     // body slots that somebody acted on since the last step

  // Events are gathered from the end of one step to the end of the next, then published together.
  EventLists gathering, published;
  LedgerBook ledger;
  std::unique_ptr<PhysicsWorld> twin;  // for the error estimate; with the image it is made from
  Snapshot twin_image;
  // For images: what only an input changes, and what only falling asleep and waking change.
  mutable SharedPart<BodyFactsList> facts;
  mutable SharedPart<ImageContacts> sleeping_contacts;
  std::vector<OverlapChange> overlap_changes;
  std::vector<SensorOverlap> new_overlaps;
  std::vector<std::uint8_t> leaves_box;  // of `moved`
  std::vector<std::uint32_t> moved;      // bodies moved by the last step, ascending slots
};

// Runs task(begin, end) over [0, count), on the job system where there is one and it is worth it.
inline void parallel_for(JobSystem* jobs, std::uint32_t count, std::uint32_t grain,
                         const RangeTask& task) {
  if (count == 0) return;
  if (jobs == nullptr || count <= grain) {
    for (std::uint32_t begin = 0; begin < count; begin += grain)
      task(begin, begin + grain < count ? begin + grain : count);
  } else {
    jobs->parallel_for(count, grain, task);
  }
}
inline void parallel_for(const WorldState& world, std::uint32_t count, std::uint32_t grain,
                         const RangeTask& task) {
  parallel_for(world.jobs, count, grain, task);
}

// [s] The next step, as far as is known: as the last one, before the first as most scenes' are.
inline Real coming_step(const WorldState& world) {
  return world.dt > Real(0) ? world.dt : Real(1.0 / 60);
}

// --- bodies (world/body_mass.cpp, body_motion.h) ---
void update_mass(WorldState& world, std::uint32_t body);
void update_locks(WorldState& world, std::uint32_t body);
void update_collider_frames(WorldState& world, std::uint32_t body);
void refresh_velocity(WorldState& world, std::uint32_t body);

// --- sleeping (world/islands.cpp) ---
void wake_body(WorldState& world, std::uint32_t body);    // with its island
void wake_around(WorldState& world, std::uint32_t body);  // whatever sleeps on its bounds
void sleep_islands(WorldState& world);
void put_to_sleep(WorldState& world, std::uint32_t body);  // with all it touches

// --- stages of the step ---
void plan_step(WorldState& world, double dt);
void find_pairs(WorldState& world);
void collide_pairs(WorldState& world);
void find_newton_islands(WorldState& world);
void color_contacts(WorldState& world);
void build_rows(WorldState& world);
// Notes which points carry more than a negligible normal impulse.
void mark_loaded_points(ContactRow<Real>& row);
void run_substeps(WorldState& world);
void stop_fast_bodies(WorldState& world);
void finalize_bodies(WorldState& world);

// --- error estimate (world/error_estimate.cpp) ---
bool wants_estimate(const WorldState& world);  // of the coming step
void step_twin(WorldState& world, const PhysicsWorld& original, double dt);
void compare_with_twin(WorldState& world, const PhysicsWorld& original);

// --- events (world/contact_events.cpp) ---
void note_pair_end(WorldState& world, const Pair& pair);  // nothing if it did not touch
void note_contact_events(WorldState& world);
void note_hits(WorldState& world);
SensorOverlap overlap_of(const WorldState& world, const Pair& pair);  // of a sensor
void update_overlaps(WorldState& world);  // by the gathered events (sensor_overlaps.cpp)

// --- pairs (world/pair_rules.cpp) ---
Pair make_pair(const WorldState& world, std::uint64_t key);
// The same pair by today's data, with what it remembers.
Pair remake_pair(const WorldState& world, const Pair& pair);
bool may_meet(const WorldState& world, std::uint32_t collider_a, std::uint32_t collider_b);
// Adds `change` to the counts that the collider belongs to.
void count_collider(SceneCounts& counts, const Collider& collider, std::uint32_t change);

// --- boxes (world/broadphase.cpp) ---
void update_proxy(WorldState& world, std::uint32_t collider, bool force);
// Its two halves: whether the collider may leave its box in the next step, and a new box. Only the
// first may run for several colliders at once.
bool leaves_proxy(WorldState& world, std::uint32_t collider);
// Whether some collider of an awake body may; does not look closely at what surely stays.
bool may_leave_boxes(WorldState& world, std::uint32_t body);
// The reach of a collider as update_reach would find it.
WorldAabb reach_now(const WorldState& world, std::uint32_t collider);
void give_proxy(WorldState& world, std::uint32_t collider);
// The box of all places that a collider may take in the next step; returns its body's path [m].
PosVec update_reach(WorldState& world, std::uint32_t collider);
// Its pairs shall be asked whether they are gone.
void note_new_box(WorldState& world, std::uint32_t collider);
// Which colliders are in pairs; all pairs have been asked.
void note_paired(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
