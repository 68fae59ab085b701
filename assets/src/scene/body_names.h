// How joints and pairs name the bodies of their scene: by name, a copy of a repeat by "name[3]".
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "plumb/assets/scene.h"
#include "scene/object_reader.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

class BodyNames {
 public:
  explicit BodyNames(const Scene& scene);  // whose bodies have been read

  enum class World { Allowed, NotMeant };
  // Of the key. Null if it is absent or wrong, or names the world, which leaves `name` empty.
  const SceneBody* read(const ObjectReader& in, std::string_view key, World world,
                        std::string& name) const;

 private:
  std::map<std::string_view, const SceneBody*> bodies_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
