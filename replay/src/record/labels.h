// Texts beside bodies and joints, for those that were given one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plumb/world.h"
#include "record/anchor.h"
#include "record/frame.h"
#include "rrd/table.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class Labels {
 public:
  void set(BodyId body, std::string text) { of_bodies_[body] = std::move(text); }
  void set(JointId joint, std::string text) { of_joints_[joint] = std::move(text); }

  // Sends the texts of what is there now, and adds the frame.
  void rebuild(rrd::Writer& writer, const PhysicsWorld& world, const Frame& frame);
  void add(const Frame& frame);
  void send(rrd::Writer& writer);

 private:
  std::map<BodyId, std::string> of_bodies_;
  std::map<JointId, std::string> of_joints_;
  std::vector<Anchor> places_;
  std::vector<rrd::Table> batches_;
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
