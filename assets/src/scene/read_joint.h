// The parts of a joint in a scene file, from the inside out: what acts along one coordinate, the
// kind with its own keys, the joint with its bodies and frames.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "plumb/assets/scene.h"
#include "scene/body_names.h"
#include "scene/object_reader.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// What a coordinate measures: angles may be given in degrees, as "key_degrees".
enum class Measure { Path, Angle };  // [m], [rad]

// These leave their target alone, and return false, when the key is absent or wrong.
bool read_measure(const ObjectReader& in, const std::string& key, Measure measure, double& out);
bool read_measured_vector(const ObjectReader& in, const std::string& key, Vec3& out);  // of angles
bool read_range(const ObjectReader& in, const std::string& key, Measure measure, Real& lower,
                Real& upper);
void read_softness(const ObjectReader& parent, std::string_view key, JointSoftness& softness);
// Of the keys "limit", "motor", "spring" and "friction".
void read_axis(const ObjectReader& parent, Measure measure, JointAxis& axis);

// Reads "kind" and the keys that belong to it; false if the kind is not known.
bool read_joint_kind(const ObjectReader& in, SceneJoint& joint);

// Reads the joints of a scene whose bodies have been read.
class JointsReader {
 public:
  explicit JointsReader(const Scene& scene, Problems& problems);
  void read(const JsonNode& list, std::vector<SceneJoint>& joints);

 private:
  void read_one(const JsonNode& node, SceneJoint& joint);
  void read_place(const ObjectReader& in, SceneJoint& joint);
  void read_side(const ObjectReader& in, char letter, SceneJointSide& side);
  void check_coupled(const ObjectReader& in, std::string_view key, const std::string& wanted);

  BodyNames bodies_;
  std::map<std::string, std::string_view> kinds_;  // of the joints read so far, by name
  Problems& problems_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
