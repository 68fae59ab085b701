#include "scene/place_joint.h"

#include <variant>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct WidePose {
  Vector3d position;
  Quaterniond orientation;
};

WidePose pose_of(const PhysicsWorld& world, BodyId body) {
  const Pose pose = world.pose(body);  // that of the world's origin for the null handle
  return {pose.position.cast<double>(), Quaterniond(pose.orientation.cast<double>())};
}

// The frame that a side of the joint has in its body, in double up to the last rounding.
LocalPose frame_of(const SceneJointSide& side, const Quaterniond& R_WJ, const WidePose& X_WB) {
  if (side.frame) return *side.frame;
  LocalPose frame;
  frame.position = (X_WB.orientation.conjugate() * (side.anchor - X_WB.position)).cast<Real>();
  frame.orientation = (X_WB.orientation.conjugate() * R_WJ).normalized().cast<Real>();
  return frame;
}

Vector3d origin_of(const LocalPose& frame, const WidePose& X_WB) {
  return X_WB.position + X_WB.orientation * frame.position.cast<double>();
}

void set_length(JointKind& kind, Real length) {
  if (auto* rod = std::get_if<DistanceJoint>(&kind)) rod->length = length;
  if (auto* rope = std::get_if<RopeJoint>(&kind)) rope->max_length = length;
  if (auto* spring = std::get_if<SpringJoint>(&kind)) spring->rest_length = length;
}

}  // namespace

Result<Joint> place_joint(const SceneJoint& source, const PhysicsWorld& world,
                          const SceneInstance& instance) {
  Joint joint = source.joint;
  joint.user_data = instance.joints.size();
  auto* gear = std::get_if<GearJoint>(&joint.kind);
  auto* rack = std::get_if<RackPinionJoint>(&joint.kind);
  if (gear || rack) {
    (gear ? gear->first : rack->pinion) = instance.find_joint(source.first);
    (gear ? gear->second : rack->rack) = instance.find_joint(source.second);
    return joint;
  }
  for (const SceneJointSide* side : {&source.a, &source.b}) {
    if (!side->body.empty() && instance.find(side->body).is_null())
      return Error{"joint '" + source.name + "': there is no body '" + side->body + "'"};
  }
  joint.body_a = source.a.body.empty() ? BodyId{} : instance.find(source.a.body);
  joint.body_b = source.b.body.empty() ? BodyId{} : instance.find(source.b.body);
  const WidePose X_WA = pose_of(world, joint.body_a), X_WB = pose_of(world, joint.body_b);
  joint.frame_a = frame_of(source.a, source.orientation, X_WA);
  joint.frame_b = frame_of(source.b, source.orientation, X_WB);
  if (source.length_as_placed) {
    const Vector3d apart = origin_of(joint.frame_b, X_WB) - origin_of(joint.frame_a, X_WA);
    set_length(joint.kind, static_cast<Real>(apart.norm()));
  }
  return joint;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
