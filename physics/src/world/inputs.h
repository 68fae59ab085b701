// Writing calls down as numbers, and reading them back (inputs.cpp documents the layouts).
#pragma once

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// Whether the call leaves alone all that an image takes for granted (BodyFacts).
constexpr bool changes_motion_alone(InputKind kind) {
  switch (kind) {
    case InputKind::SetPose:
    case InputKind::SetLinearVelocity:
    case InputKind::SetAngularVelocity:
    case InputKind::ApplyForce:
    case InputKind::ApplyForceAt:
    case InputKind::ApplyForceAtBodyPoint:
    case InputKind::ApplyTorque:
    case InputKind::ApplyImpulse:
    case InputKind::ApplyImpulseAt:
    case InputKind::ApplyImpulseAtBodyPoint:
    case InputKind::ApplyAngularImpulse:
    case InputKind::SetAwake:
      return true;
    default:
      return false;
  }
}

// To be called by all that changes a world from outside. Notes it when somebody observes the world.
// `fill` appends its numbers.
template <class Fill>
void note_input(WorldState& world, InputKind kind, std::uint64_t target, Fill&& fill) {
  if (!changes_motion_alone(kind)) world.facts.forget();
  if (world.observers.empty()) return;
  InputRecord record;
  record.kind = kind;
  record.target = target;
  fill(record.numbers);
  world.inputs.push_back(std::move(record));
}

inline void append_all(std::vector<double>& out, std::initializer_list<double> numbers) {
  out.insert(out.end(), numbers.begin(), numbers.end());
}
inline double as_number(Real a) { return static_cast<double>(a); }

void append(std::vector<double>& out, const Vec3& v);
void append_position(std::vector<double>& out, const Pos3& p);
void append(std::vector<double>& out, const Quat& q);
void append(std::vector<double>& out, const MassProperties& m);
void append(std::vector<double>& out, const RigidBody& body);
void append(std::vector<double>& out, const MotionLocks& locks);
void append(std::vector<double>& out, const Collider& collider);
void append(std::vector<double>& out, const LocalPose& pose);
void append(std::vector<double>& out, const Material& material);
void append(std::vector<double>& out, const WorldSettings& settings);
void append(std::vector<double>& out, const SurfaceVelocity& velocity);
void append(std::vector<double>& out, const Filter& filter);
void append(std::vector<double>& out, const std::optional<MaterialPair>& values);
void append_long(std::vector<double>& out, std::uint64_t v);  // low and high 32 bits

// Reads numbers in order; remembers when there were too few or one was no valid choice.
class NumberReader {
 public:
  explicit NumberReader(std::span<const double> numbers) : numbers_(numbers) {}
  double number();
  Real real() { return static_cast<Real>(number()); }
  bool flag() { return number() != 0; }
  std::uint32_t word();       // 32-bit
  std::uint64_t long_word();  // two numbers: low, high
  Vec3 vector();
  Pos3 position();
  Quat orientation();
  MassProperties mass();
  MotionType motion_type();
  MotionLocks locks();
  RigidBody body();
  Shape shape();
  LocalPose local_pose();
  Material material();
  Collider collider();
  WorldSettings settings();
  SurfaceVelocity surface_velocity();
  Filter filter();
  std::optional<MaterialPair> material_pair();
  [[nodiscard]] bool complete() const { return ok_ && at_ == numbers_.size(); }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  std::span<const double> numbers_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

// Shapes with their geometry (shape_inputs.cpp). Reading clears `ok` where the numbers make none.
void append_shape(std::vector<double>& out, const Shape& shape);
Shape read_shape(NumberReader& in, bool& ok);

}  // namespace plumb::inline PLUMB_ABI::detail
