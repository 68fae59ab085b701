// Effects as numbers: body u64, user data u64, kind, then the fields of the kind in the order of
// EffectVisitor (x3: vectors and positions; matrices by columns; quaternions xyzw; a mesh: 0 or 1
// first, then its shape as in inputs.cpp).
#include "effects/effect_numbers.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

class Writer {
 public:
  explicit Writer(std::vector<double>& out) : out_(out) {}
  void operator()(Real& v) { out_.push_back(static_cast<double>(v)); }
  void operator()(bool& v) { out_.push_back(v ? 1.0 : 0.0); }
  void operator()(std::uint32_t& v) { out_.push_back(static_cast<double>(v)); }
  void operator()(std::uint64_t& v) { append_long(out_, v); }
  void operator()(BodyId& id) { append_long(out_, id.value()); }
  void operator()(Vec3& v) { append(out_, v); }
  void position(Pos3& p) { append_position(out_, p); }
  void unit(Quat& q) { append(out_, q); }
  template <class Enum>
  void choice(Enum& v, std::uint32_t) {
    out_.push_back(static_cast<double>(v));
  }
  void mesh(std::optional<SurfaceMesh>& mesh) {
    out_.push_back(mesh.has_value() ? 1.0 : 0.0);
    if (mesh.has_value()) append_shape(out_, *mesh);
  }

 private:
  std::vector<double>& out_;
};

class Reader {
 public:
  Reader(NumberReader& in, bool& ok) : in_(in), ok_(ok) {}
  void operator()(Real& v) { v = in_.real(); }
  void operator()(bool& v) { v = in_.flag(); }
  void operator()(std::uint32_t& v) { v = in_.word(); }
  void operator()(std::uint64_t& v) { v = in_.long_word(); }
  void operator()(BodyId& id) { id = BodyId::from_value(in_.long_word()); }
  void operator()(Vec3& v) { v = in_.vector(); }
  void position(Pos3& p) { p = in_.position(); }
  void unit(Quat& q) { q = in_.orientation(); }
  template <class Enum>
  void choice(Enum& v, std::uint32_t count) {
    const std::uint32_t value = in_.word();
    if (value >= count) ok_ = false;
    v = static_cast<Enum>(value < count ? value : 0);
  }
  void mesh(std::optional<SurfaceMesh>& mesh) {
    if (!in_.flag()) return;
    const Shape shape = in_.shape();
    const auto* read = std::get_if<SurfaceMesh>(&shape);
    if (read == nullptr || read->geometry == nullptr) {
      ok_ = false;
      return;
    }
    mesh = *read;
  }

 private:
  NumberReader& in_;
  bool& ok_;
};

template <std::size_t I = 0>
void choose_kind(EffectKind& kind, std::uint32_t index) {
  if constexpr (I < kEffectKindCount) {
    if (index == I) {
      kind.emplace<I>();
    } else {
      choose_kind<I + 1>(kind, index);
    }
  }
}

template <class To>
void visit_effect(To& t, Effect& effect) {
  t(effect.body);
  t(effect.user_data);
  std::uint32_t index = static_cast<std::uint32_t>(effect.kind.index());
  t.choice(index, static_cast<std::uint32_t>(kEffectKindCount));
  if (index != effect.kind.index()) choose_kind(effect.kind, index);
  std::visit(EffectVisitor<To>{t}, effect.kind);
}

}  // namespace

void append(std::vector<double>& out, const Effect& effect) {
  Effect copy = effect;  // the visitor serves both directions; writing changes nothing
  Writer writer(out);
  visit_effect(writer, copy);
}

Effect read_effect(NumberReader& in, bool& ok) {
  Effect effect;
  Reader reader(in, ok);
  visit_effect(reader, effect);
  return effect;
}

}  // namespace plumb::inline PLUMB_ABI::detail
