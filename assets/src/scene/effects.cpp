#include "scene/effects.h"

#include <algorithm>
#include <set>

#include "scene/body_names.h"
#include "scene/effect_fields.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

class FieldReader {
 public:
  FieldReader(const ObjectReader& in, SceneEffect& effect) : in_(in), effect_(effect) {}
  void number(std::string_view key, Real& v) { in_.number(key, v); }
  void flag(std::string_view key, bool& v) { in_.flag(key, v); }
  void vector(std::string_view key, Vec3& v) { in_.vector(key, v); }
  void position(std::string_view key, Pos3& v) { in_.vector(key, v); }
  template <class Enum>
  void choice(std::string_view key, Keys words, Enum& v) {
    in_.choice(key, words, v);
  }
  // Rows one after the other.
  void matrix(std::string_view key, Mat3& m) {
    double numbers[9];
    if (!in_.has(key) || !in_.numbers(key, numbers, 9)) return;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = static_cast<Real>(numbers[i]);
  }
  void controls(AeroSurface& e) {
    e.is_controlled = in_.has("minimum") || in_.has("maximum");
    if (in_.has("minimum") != in_.has("maximum"))
      in_.problems().add(in_.line(), in_.what() + " has one of 'minimum' and 'maximum'",
                         "give both tensors of a control surface, or neither");
    matrix("minimum", e.minimum);
    matrix("maximum", e.maximum);
    in_.number("control", e.control, {-1, 1, false});
  }
  void orientation(Quat& q) {
    Eigen::Quaterniond read = Eigen::Quaterniond::Identity();
    if (read_orientation(in_, read)) q = read.cast<Real>();
  }
  void rest_length(Real& v) {
    effect_.length_as_placed = !in_.has("rest_length");
    in_.number("rest_length", v, kPositive);
  }

 private:
  const ObjectReader& in_;
  SceneEffect& effect_;
};

class FieldWriter {
 public:
  FieldWriter(Json& out, const SceneEffect& effect) : out_(out), effect_(effect) {}
  void number(const char* key, const Real& v) { out_[key] = tidy(v); }
  void flag(const char* key, const bool& v) { out_[key] = v; }
  void vector(const char* key, const Vec3& v) { out_[key] = list(v); }
  void position(const char* key, const Pos3& v) { out_[key] = list(v); }
  template <class Enum>
  void choice(const char* key, Keys words, Enum& v) {
    out_[key] = word(words, v);
  }
  void matrix(const char* key, const Mat3& m) {
    out_[key] = Json::array();
    for (int i = 0; i < 9; ++i) out_[key].push_back(tidy(m(i / 3, i % 3)));
  }
  void controls(const AeroSurface& e) {
    if (!e.is_controlled) return;
    matrix("minimum", e.minimum);
    matrix("maximum", e.maximum);
    number("control", e.control);
  }
  void orientation(const Quat& q) { out_["orientation"] = scene::orientation(q); }
  void rest_length(const Real& v) {
    if (!effect_.length_as_placed) number("rest_length", v);
  }

 private:
  Json& out_;
  const SceneEffect& effect_;
};

template <std::size_t I = 0>
void choose_kind(EffectKind& kind, std::size_t index) {
  if constexpr (I < kEffectKindCount) {
    if (index == I) {
      kind.emplace<I>();
    } else {
      choose_kind<I + 1>(kind, index);
    }
  }
}

// The place of the kind's word in the table; noted where it is none.
std::size_t read_kind(const JsonNode& node, const std::string& what, Problems& problems) {
  std::string known;
  const JsonMember* member = node.find("kind");
  for (std::size_t k = 0; k < kEffectKeys.size(); ++k) {
    if (kEffectKeys[k].kind.empty()) continue;
    if (member != nullptr && member->value.text == kEffectKeys[k].kind) return k;
    known += (known.empty() ? "" : ", ") + std::string(kEffectKeys[k].kind);
  }
  problems.add(member != nullptr ? member->value.line : node.line,
               member != nullptr ? "there is no kind of effect '" + member->value.text + "'"
                                 : what + " has no 'kind'",
               "write one of: " + known);
  return kEffectKeys.size();
}

void read_effect(const JsonNode& node, const BodyNames& bodies, SceneEffect& effect,
                 Problems& problems) {
  effect.line = node.line;
  if (node.kind != JsonNode::Kind::Object) {
    problems.add(node.line, effect.name + " is not an object", "write an object, { ... }");
    return;
  }
  if (const JsonMember* name = node.find("name"))
    if (!name->value.text.empty()) effect.name = name->value.text;
  const std::string what = "effect '" + effect.name + "'";
  const std::size_t kind = read_kind(node, what, problems);
  if (kind == kEffectKeys.size()) return;
  choose_kind(effect.effect.kind, kind);
  const ObjectReader in(node, what, kEffectKeys[kind].keys, problems);
  in.text("name", effect.name);
  const bool needs_body = std::holds_alternative<Thrust>(effect.effect.kind) ||
                          std::holds_alternative<AeroSurface>(effect.effect.kind) ||
                          std::holds_alternative<Spring>(effect.effect.kind);
  if (needs_body && !in.has("body")) in.missing("body", "name the body that it acts on");
  if (in.has("body")) bodies.read(in, "body", BodyNames::World::NotMeant, effect.body);
  if (in.knows("other") && in.has("other")) {
    bodies.read(in, "other", BodyNames::World::Allowed, effect.other);
    if (!effect.other.empty() && effect.other == effect.body)
      problems.add(in.line_of("other"), what + " names one body twice",
                   "name two bodies; one that is left out is the world");
  }
  FieldReader fields(in, effect);
  std::visit(EffectFields<FieldReader>{fields}, effect.effect.kind);
}

Eigen::Vector3d in_world(const PhysicsWorld& world, BodyId body, const Eigen::Vector3d& p) {
  if (body.is_null()) return p;
  const Pose pose = world.pose(body);
  return pose.position.cast<double>() + pose.orientation.cast<double>() * p;
}

}  // namespace

void read_effects(const JsonNode& list, Scene& scene, Problems& problems) {
  const BodyNames bodies(scene);
  std::set<std::string> names;
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    SceneEffect& effect = scene.effects.emplace_back();
    effect.name = "effect " + std::to_string(k);
    read_effect(list.items[k], bodies, effect, problems);
    if (!names.insert(effect.name).second)
      problems.add(effect.line, "there is another effect named '" + effect.name + "'",
                   "give each effect a name of its own");
  }
}

Json json_of_effect(const SceneEffect& effect) {
  SceneEffect copy = effect;  // the fields serve both directions; writing changes nothing
  Json out;
  out["kind"] = std::string(kEffectKeys[effect.effect.kind.index()].kind);
  out["name"] = effect.name;
  if (!effect.body.empty()) out["body"] = effect.body;
  if (!effect.other.empty()) out["other"] = effect.other;
  FieldWriter fields(out, copy);
  std::visit(EffectFields<FieldWriter>{fields}, copy.effect.kind);
  return out;
}

Effect place_effect(const SceneEffect& effect, const PhysicsWorld& world,
                    const SceneInstance& instance) {
  Effect placed = effect.effect;
  placed.body = effect.body.empty() ? BodyId{} : instance.find(effect.body);
  if (auto* spring = std::get_if<Spring>(&placed.kind)) {
    spring->other = effect.other.empty() ? BodyId{} : instance.find(effect.other);
    if (effect.length_as_placed)
      spring->rest_length =
          static_cast<Real>((in_world(world, placed.body, spring->point.cast<double>()) -
                             in_world(world, spring->other, spring->other_point.cast<double>()))
                                .norm());
  }
  return placed;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
