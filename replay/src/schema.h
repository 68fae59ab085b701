// The names under which a recording keeps what a replay needs. Entities below "plumb/" are read
// back by name; everything else in the file is for the eye. README.md holds the same as a table.
#pragma once

#include <cstdint>

namespace plumb::rrd::schema {

// Raised when a reader of the old schema would misread the new one.
inline constexpr std::uint32_t kVersion = 3;

inline constexpr const char* kPrefix = "plumb/";

// Once, static: what the recording is.
namespace recording {
inline constexpr const char* kEntity = "plumb/recording";
inline constexpr const char* kSchemaVersion = "plumb.Recording:schema_version";  // u32
inline constexpr const char* kPrecision = "plumb.Recording:precision";           // text
inline constexpr const char* kScene = "plumb.Recording:scene";                   // text
inline constexpr const char* kFirstFrame = "plumb.Recording:first_frame";        // u64
inline constexpr const char* kSnapshotEvery = "plumb.Recording:snapshot_every";  // u32 [steps]
}  // namespace recording

// One row a step.
namespace step {
inline constexpr const char* kEntity = "plumb/step";
inline constexpr const char* kDt = "plumb.Step:dt";                 // f64 [s]
inline constexpr const char* kTime = "plumb.Step:time";             // f64 [s] after the step
inline constexpr const char* kStateHash = "plumb.Step:state_hash";  // u64 after the step
}  // namespace step

// One row for each step before which something was done to the world.
namespace input {
inline constexpr const char* kEntity = "plumb/input";
inline constexpr const char* kKinds = "plumb.Input:kinds";      // u32 each
inline constexpr const char* kTargets = "plumb.Input:targets";  // u64 each
inline constexpr const char* kLengths = "plumb.Input:lengths";  // u32 each: how many numbers
inline constexpr const char* kNumbers = "plumb.Input:numbers";  // f64, of all inputs of the row
}  // namespace input

// One row at the start and every N steps: the exact state, one component a column.
namespace snapshot {
inline constexpr const char* kEntity = "plumb/snapshot";
inline constexpr const char* kVersion = "plumb.SnapshotHead:schema_version";  // u32 of physics
inline constexpr const char* kPrecision = "plumb.SnapshotHead:precision";     // text
inline constexpr const char* kNames = "plumb.SnapshotHead:columns";           // texts, in order
inline constexpr const char* kColumnPrefix = "plumb.Snapshot:";               // f64 or u64 x width
}  // namespace snapshot

// One row a step: every body that can move. Numbers have the types of the build that wrote them.
namespace body {
inline constexpr const char* kEntity = "plumb/body";
inline constexpr const char* kIds = "plumb.Body:ids";                           // u64 handles
inline constexpr const char* kAwake = "plumb.Body:awake";                       // u8 0 or 1
inline constexpr const char* kPosition = "plumb.Body:position";                 // x3 [m]
inline constexpr const char* kOrientation = "plumb.Body:orientation_xyzw";      // x4
inline constexpr const char* kLinearVelocity = "plumb.Body:linear_velocity";    // x3 [m/s]
inline constexpr const char* kAngularVelocity = "plumb.Body:angular_velocity";  // x3 [rad/s]
}  // namespace body

}  // namespace plumb::rrd::schema
