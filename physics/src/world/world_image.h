// The blocks of memory that a WorldImage consists of.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// What of a body changes only when somebody changes it.
struct BodyFacts {
  std::uint64_t user_data = 0;
  double mass = 0;                                    // [kg]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s^2] what acts on it
  std::uint32_t slot = 0, generation = 0;
  Vec center_B{0, 0, 0};      // centre of mass in B
  Rotation R_BP{0, 0, 0, 1};  // principal axes in B
  MotionType type = MotionType::Dynamic;
  bool disabled = false;
};

// The facts of all bodies, made again when one was changed, and shared by the images taken since.
class FactsCache {
 public:
  using Facts = std::vector<BodyFacts>;  // ascending slots
  FactsCache() = default;
  void forget() { facts_.reset(); }
  template <class Make>
  std::shared_ptr<const Facts> get(Make&& make) {  // from any thread
    const std::lock_guard lock(mutex_);
    if (!facts_) facts_ = make();
    return facts_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const Facts> facts_;
};

struct ImageContact {
  std::uint32_t reference = 0;  // slot of the body from whose centre of mass positions are seen
  std::uint32_t point_count = 0;
  Vec normal{0, 0, 0};
};
struct ImagePoint {
  Vec position{0, 0, 0};    // [m] as in the manifold
  Real normal_impulse = 0;  // [N s] over the step
};

struct ImageColumns {
  std::shared_ptr<const FactsCache::Facts> facts;
  // By dense index, as in BodyStore.
  std::vector<BodyVelocity> velocity;
  std::vector<BodyPose> pose;
  std::vector<BodyMomentum> momentum;
  std::uint32_t awake_end = 1;
  std::vector<std::uint32_t> dense_of;  // by slot
  std::vector<ImageContact> contacts;
  std::vector<ImagePoint> points;  // of all contacts, one after the other
};

}  // namespace plumb::inline PLUMB_ABI::detail
