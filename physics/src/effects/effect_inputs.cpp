// Effects as numbers: body u64, user data u64, kind, then the fields of the kind in the order of
// EffectVisitor (x3: vectors and positions; matrices by columns; quaternions xyzw; a mesh: 0 or 1
// first, then its shape as in inputs.cpp).
#include "effects/effect_numbers.h"
#include "world/number_visitors.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

class Writer : public NumberWriter {
 public:
  using NumberWriter::NumberWriter;
  void mesh(std::optional<SurfaceMesh>& mesh) {
    if (presence(mesh)) append_shape(out_, *mesh);
  }
};

class Reader : public NumberFiller {
 public:
  using NumberFiller::NumberFiller;
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
};

template <class To>
void visit_effect(To& t, Effect& effect) {
  t(effect.body);
  t(effect.user_data);
  visit_index(t, effect.kind);
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
