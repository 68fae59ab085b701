#include "scene/body_names.h"

#include <charconv>
#include <vector>

#include "scene/nearest.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

BodyNames::BodyNames(const Scene& scene) {
  for (const SceneBody& body : scene.bodies) bodies_.emplace(body.name, &body);
}

const SceneBody* BodyNames::read(const ObjectReader& in, std::string_view key, World world,
                                 std::string& name) const {
  std::string written;
  if (!in.text(key, written)) return nullptr;
  if (world == World::Allowed && written == kWorldName) return nullptr;
  name = written;
  const auto complain = [&](const std::string& what, const std::string& remedy) {
    in.problems().add(in.line_of(key), what, remedy);
    return nullptr;
  };
  const std::size_t bracket = written.find('[');
  const std::string_view plain = std::string_view(written).substr(0, bracket);
  const auto found = bodies_.find(plain);
  if (found == bodies_.end()) {
    std::vector<std::string_view> names;
    if (world == World::Allowed) names.push_back(kWorldName);
    for (const auto& [known, body] : bodies_) names.push_back(known);
    const std::string_view nearest = nearest_of(plain, names);
    const std::string any = "name one of the scene's bodies";
    return complain("there is no body '" + std::string(plain) + "'",
                    !nearest.empty()          ? "did you mean '" + std::string(nearest) + "'?"
                    : world == World::Allowed ? any + ", or \"world\""
                                              : any);
  }
  const SceneBody& body = *found->second;
  if (!body.repeat) {
    if (bracket == std::string::npos) return &body;
    return complain("body '" + body.name + "' has no copies", "write its name without a number");
  }
  std::size_t copy = 0;
  const char* end = written.data() + written.size();
  bool good = bracket != std::string::npos && written.back() == ']';
  if (good) {
    const auto [stop, error] = std::from_chars(written.data() + bracket + 1, end - 1, copy);
    good = error == std::errc{} && stop == end - 1 && copy < body.repeat->total();
  }
  // What is written must be what the copy is called: "link[01]" is not.
  if (good && written == body.name + "[" + std::to_string(copy) + "]") return &body;
  return complain("'" + written + "' names no copy of the body '" + body.name + "'",
                  "name one of '" + body.name + "[0]' to '" + body.name + "[" +
                      std::to_string(body.repeat->total() - 1) + "]'");
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
