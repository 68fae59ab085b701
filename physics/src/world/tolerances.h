// Every tolerance of the step that a user should not have to choose: unit, range, default, reason.
// Lengths derive from shape size and time step, so that a 1 mm and a 10 km body behave alike.
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail::tolerance {

// How far an arm of a contact between two dynamic bodies follows their motion within a step, in the
// smallest radii of gyration of its body [-]: its response stays below twice the one it was solved
// for.
inline constexpr Real kArmRoom = Real(0.5);

// Overlap that a resting contact keeps, as a fraction of the smaller body's smallest thickness [-].
// 0.002: 2 mm for a 1 m box. Without it resting points flicker between touching and not.
inline constexpr Real kSlopFraction = Real(0.002);

// Manifolds are kept, and only moved along, while no point of the smaller body has moved by more
// than this many slops [-], seen from the other one, since they were found: 80 um for a 1 m box.
// Most pairs of a pile that settles creep by less than half of that in a step.
inline constexpr Real kRecycleSlops = Real(0.04);

// A body that turns by more than this in a step [rad], by its angular velocity, has its contact
// rows told anew within the step; except where it shows the contact a ball, whose core is shorter
// than the root of kRoundCore [-] of the arm. Below, the error of arms that stay is of the order of
// its square.
inline constexpr Real kFastTurn = Real(0.25);
inline constexpr Real kRoundCore = Real(0.01);

// Contact points are made this many slops before the surfaces meet [-], so that a manifold keeps
// all its points while a body rocks by less than the slop.
inline constexpr Real kMarginSlops = Real(4);

// Boxes in the broadphase are grown by this fraction of the body's smallest thickness [-]. Larger:
// fewer tree updates, more false pairs.
inline constexpr Real kFatBoxFraction = Real(0.1);
// ... and reach ahead along the path of this many steps [-], so that a fast body re-enters the tree
// every few steps only.
inline constexpr Real kFatBoxSteps = Real(2);
// What is near nothing: as many as carry it by so many times its own radius [-], and at most so
// many [-]. Long boxes meet little where there is little to meet.
inline constexpr Real kFreeBoxFraction = Real(6);
inline constexpr Real kFreeBoxSteps = Real(64);
// ... and leave as much room on all sides, at most this fraction of the smallest thickness [-].
inline constexpr Real kFreeBoxSpare = Real(0.25);

// Overlap is worked off no faster than this many thicknesses a second [1/s]. 2: a 1 m box leaves
// the ground at 2 m/s at most, however deep it was born in it.
inline constexpr Real kPushRate = Real(2);

// Effective masses that a contact's spring is made for [-]. Of two equal bodies the effective mass
// is half of one, so that with 2 the upper one sinks by g/w^2 under its own weight. A column of n
// equal boxes stands while n^3 < 0.65 s w^2 width / g for s masses (Euler's self-weighted column,
// with the contacts' resistance to tilt for its stiffness): 13 boxes of 1 m at 30 Hz with 1, 17
// with 2. Beyond, one pass a substep leaves wide walls restless (seen from 4 on).
inline constexpr Real kContactMasses = Real(2);

// Contacts with static or kinematic bodies are this much stiffer than those between dynamic ones
// [-] so that the ground yields last. [Catto 2024]
inline constexpr Real kStaticStiffness = Real(2);

// Up to this g / thickness [1/s^2] contacts have the settings' frequency: at 30 Hz a body sinks by
// 0.28 mm, 0.3 % of 10 cm. Smaller ones (or heavier gravity) get stiffer contacts, to sink no more.
inline constexpr Real kReferencePull = Real(98);

// No contact gets a frequency above this many times the substep rate [-]: a stiffer spring could
// not be followed. [Catto 2024]
inline constexpr Real kStiffestContact = Real(0.25);

// The contacts of bodies that begin a step with overlap above this many slops [-] are relaxed more
// often, so that what pushes bodies apart does not throw them.
inline constexpr Real kDeepSlops = Real(10);
inline constexpr int kDeepRelaxPasses = 6;
// ... with the contacts of those that touch them, and so on, so many times [-]. With 0 a stack
// under 100 g loses hold of its lowest box; from 1 on it stands as if all were relaxed.
inline constexpr int kDeepLayers = 2;

// An approach slower than this many g h (h: substep) does not bounce [-]. A pair at rest gains g h
// a substep, so that anything below is noise; a pair that was at rest needs more, because an
// unconverged solver leaves several g h.
inline constexpr Real kBounceCutNew = Real(0.25);
inline constexpr Real kBounceCutResting = Real(8);
// A pair bounces at most so often within one substep [-]; after that it is treated as inelastic.
// Ends the infinite series of bounces of a ball between two closing walls.
inline constexpr int kMaxBouncesPerSubstep = 16;
// Passes over the bouncing pairs of one substep [-]; a row of n touching balls needs about n.
inline constexpr int kMaxImpactPasses = 64;

// A pair that moves more than this fraction of the smaller thickness in a step is swept [-]: its
// manifold is taken where the surfaces first meet, so that nothing thin is passed unseen.
inline constexpr Real kSweptFraction = Real(0.25);
// Bodies that joints tie get contacts from as far away as this fraction of the smaller thickness
// [-] where they come so far in a step, by turning above all. Of 48 falls of a ragdoll that begin
// 1e-5 m/s apart, six had a limb stopped 1.0 to 1.3 cm short of its joint with kSweptFraction, none
// has with this; without a bound a limb would meet what its joint keeps it from.
inline constexpr Real kTiedReach = Real(1);
// Advances of a sweep against shapes with parts [-]; each at least halves what a sphere's sweep
// still misses.
inline constexpr int kSweepSteps = 32;
// Surfaces this near count as met [-], as a fraction of the slop.
inline constexpr Real kSweepTolerance = Real(0.5);

// A body that moves by more than this fraction of its thickness in a step is followed along its
// path after the step [-]: what moves less cannot get its middle past anything unseen.
inline constexpr Real kContinuousFraction = Real(0.25);
// It is stopped where it overlaps what it meets by this many slops [-]. More than resting contacts
// sink in, so that a body that slides fast over the seam of two flush boxes does not stop at it:
// the shapes are followed with a slightly smaller core.
inline constexpr Real kContinuousOverlapSlops = Real(4);
// Bodies nearer than this many slops at the step's start are in contact already [-], which is the
// contact solver's business, until they get deeper by this fraction of the smaller thickness [-].
inline constexpr Real kContinuousTouchSlops = Real(4);
inline constexpr Real kContinuousAllowance = Real(0.125);

// A one-way collider is solid for what lies within 60 degrees of its direction [-]: the sides of a
// plate let through, its rounded rims hold.
inline constexpr Real kOneWayCosine = Real(0.5);
// What overlaps it by more than this many slops when they first meet is inside and passes [-]. More
// than the 5 slops at which the continuous stage leaves what it has stopped on the solid side.
inline constexpr Real kOneWayInsideSlops = Real(10);

// A body counts as being at rest below this fraction of sqrt(g d) [-], d its size: the speed it
// would have after falling 1e-4 d. 0.014 sqrt(9.81 * 1) = 4.4 cm/s for a 1 m body.
inline constexpr Real kRestSpeedFraction = Real(0.014);
// Without gravity: this many sizes a second [1/s].
inline constexpr Real kRestSizesPerSecond = Real(1e-3);

// A normal impulse below this fraction of m g h counts as none [-] when it is asked whether the set
// of loaded contact points changed (rounding leaves such impulses in bodies that fall together).
inline constexpr Real kLoadedFraction = Real(1e-6);

// Level of detail in time (step_levels.h). An island keeps at least so many substeps [-], so that
// its own steps tell of their error.
inline constexpr int kFewestSubsteps = 2;
// It gets half as many once so many steps in a row [-] have erred by less than this share of the
// tolerance [-]: with steps twice as long errors of second order are four times as large, and half
// of the tolerance is kept in hand.
inline constexpr int kCalmSteps = 4;
inline constexpr Real kCalmShare = Real(0.125);

// Bodies per chunk of a parallel loop [-]: 256 records of 32 bytes are 8 kB, no shared cache line.
inline constexpr unsigned kBodyGrain = 256;
inline constexpr unsigned kPairGrain = 64;
// A search along a path takes microseconds: few in a chunk.
inline constexpr unsigned kSweepGrain = 4;
inline constexpr unsigned kBlockGrain = 16;  // blocks of up to 16 rows
inline constexpr unsigned kRowGrain = 64;
// Rows of bodies that go through the substeps apart from others (step_groups.h) [-]: rows of 500
// bytes and bodies of 300 that fit together into half a megabyte, of which most processors have as
// much or more for each core. So many are gathered; fewer are not worth a group of their own; who
// has more gains more from threads that share its colours.
inline constexpr unsigned kRowsApart = 512;
inline constexpr unsigned kFewestRowsApart = 128;
inline constexpr unsigned kMostRowsApart = 1024;

}  // namespace plumb::inline PLUMB_ABI::detail::tolerance
