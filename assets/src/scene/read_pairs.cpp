#include "scene/read_pairs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/body_names.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

void read_value(const ObjectReader& in, std::string_view key, const Range& range,
                std::optional<Real>& out) {
  Real value = 0;
  if (in.number(key, value, range)) out = value;
}

void read_material_pair(const ObjectReader& in, SceneMaterialPair& pair) {
  double kinds[2];
  if (!in.has("kinds")) {
    in.missing("kinds", "name two kinds of material, for example [1, 2]");
  } else if (in.numbers("kinds", kinds, 2)) {
    const auto good = [](double kind) {
      return kind >= 1 && kind <= static_cast<double>(kLastKind) && kind == std::floor(kind);
    };
    if (good(kinds[0]) && good(kinds[1])) {
      pair.kind_a = static_cast<std::uint32_t>(kinds[0]);
      pair.kind_b = static_cast<std::uint32_t>(kinds[1]);
    } else {
      in.problems().add(in.line_of("kinds"),
                        "'kinds' of " + in.what() + " are not two kinds of material",
                        "write the \"kind\" of two materials, whole numbers from 1 on");
    }
  }
  read_value(in, "friction", kNotNegative, pair.values.friction);
  read_value(in, "restitution", {0, 1, false}, pair.values.restitution);
  read_value(in, "rolling_friction", kNotNegative, pair.values.rolling_friction);
  read_value(in, "torsional_friction", kNotNegative, pair.values.torsional_friction);
  const auto has = [&in](std::string_view key) { return in.has(key); };
  if (std::none_of(std::begin(keys::kMaterialPair) + 1, std::end(keys::kMaterialPair), has))
    in.problems().add(in.line(), in.what() + " says nothing about the two",
                      "give friction, restitution, rolling_friction or torsional_friction");
}

bool same_kinds(const SceneMaterialPair& p, const SceneMaterialPair& q) {
  return std::minmax(p.kind_a, p.kind_b) == std::minmax(q.kind_a, q.kind_b);
}

void read_side(const ObjectReader& in, char letter, const BodyNames& bodies,
               SceneExclusion::Side& side) {
  const std::string body_key = std::string("body_") + letter;
  const std::string collider_key = std::string("collider_") + letter;
  if (!in.has(body_key)) in.missing(body_key, "name two bodies that never meet");
  const SceneBody* body = bodies.read(in, body_key, BodyNames::World::NotMeant, side.body);
  if (!in.has(collider_key)) return;
  const int colliders = body ? static_cast<int>(body->colliders.size()) : 0;
  if (body && colliders == 0) {
    in.problems().add(in.line_of(collider_key), "body '" + side.body + "' has no colliders",
                      "remove collider_a and collider_b, or give it one");
    return;
  }
  int place = 0;
  if (body && in.integer(collider_key, place, 0, colliders - 1))
    side.collider = static_cast<std::size_t>(place);
}

}  // namespace

void read_material_pairs(const JsonNode& list, std::vector<SceneMaterialPair>& pairs,
                         Problems& problems) {
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    const JsonNode& node = list.items[k];
    const ObjectReader in(node, "material pair " + std::to_string(k), keys::kMaterialPair,
                          problems);
    if (!in.is_object()) continue;
    SceneMaterialPair pair;
    pair.line = node.line;
    read_material_pair(in, pair);
    const auto twin = std::find_if(pairs.begin(), pairs.end(), [&](const SceneMaterialPair& p) {
      return pair.kind_a != 0 && same_kinds(p, pair);
    });
    if (twin != pairs.end())
      problems.add(node.line, in.what() + " is about kinds that have an entry already",
                   "keep one of them; the other stands in line " + std::to_string(twin->line));
    pairs.push_back(pair);
  }
}

void read_excluded_pairs(const JsonNode& list, Scene& scene, Problems& problems) {
  const BodyNames bodies(scene);
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    const JsonNode& node = list.items[k];
    const ObjectReader in(node, "excluded pair " + std::to_string(k), keys::kExcludedPair,
                          problems);
    if (!in.is_object()) continue;
    SceneExclusion& pair = scene.excluded_pairs.emplace_back();
    pair.line = node.line;
    read_side(in, 'a', bodies, pair.a);
    read_side(in, 'b', bodies, pair.b);
    if (in.has("collider_a") != in.has("collider_b"))
      problems.add(node.line, in.what() + " names a collider on one side only",
                   "give collider_a and collider_b, or neither for the whole bodies");
    if (!pair.a.body.empty() && pair.a.body == pair.b.body)
      problems.add(in.line_of("body_b"), in.what() + " names one body twice",
                   "name two bodies; the colliders of one never meet");
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
