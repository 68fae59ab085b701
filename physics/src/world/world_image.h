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

struct ImageContact {
  std::uint32_t reference = 0;  // slot of the body from whose centre of mass positions are seen
  std::uint32_t point_count = 0;
  Vec normal{0, 0, 0};
};
struct ImagePoint {
  Vec position{0, 0, 0};    // [m] as in the manifold
  Real normal_impulse = 0;  // [N s] over the step
};

struct ImageContacts {
  std::vector<ImageContact> contacts;
  std::vector<ImagePoint> points;  // of all contacts, one after the other
};

// Something that seldom changes: made again when it did, and shared by the images taken since.
template <class T>
class SharedPart {
 public:
  void forget() { made_.reset(); }
  template <class Make>
  std::shared_ptr<const T> get(Make&& make) {  // from any thread
    const std::lock_guard lock(mutex_);
    if (!made_) made_ = make();
    return made_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const T> made_;
};
using BodyFactsList = std::vector<BodyFacts>;  // ascending slots

struct ImageColumns {
  std::shared_ptr<const BodyFactsList> facts;
  // By dense index, as in BodyStore.
  std::vector<BodyVelocity> velocity;
  std::vector<BodyPose> pose;
  std::vector<BodyMomentum> momentum;
  std::uint32_t awake_end = 1;
  std::vector<std::uint32_t> dense_of;  // by slot
  ImageContacts awake;
  std::shared_ptr<const ImageContacts> asleep;  // of pairs in sleeping islands
};

}  // namespace plumb::inline PLUMB_ABI::detail
