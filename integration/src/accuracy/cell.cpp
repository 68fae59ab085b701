// The cases of every number type that this build has.
#include "accuracy/cell.h"

#include "plumb/settings.h"

#if defined(PLUMB_LAB_F32)
namespace plumb::f32::cells {
const accuracy::CellCode& code();
}
#endif
#if defined(PLUMB_LAB_F32D)
namespace plumb::f32d::cells {
const accuracy::CellCode& code();
}
#endif
#if defined(PLUMB_LAB_F64)
namespace plumb::f64::cells {
const accuracy::CellCode& code();
}
#endif

namespace plumb::accuracy {

const CellCode* cells_of(Precision precision) {
  switch (precision) {
    case Precision::F32:
#if defined(PLUMB_LAB_F32)
      return &f32::cells::code();
#else
      return nullptr;
#endif
    case Precision::F32D:
#if defined(PLUMB_LAB_F32D)
      return &f32d::cells::code();
#else
      return nullptr;
#endif
    case Precision::F64:
#if defined(PLUMB_LAB_F64)
      return &f64::cells::code();
#else
      return nullptr;
#endif
  }
  return nullptr;
}

const std::vector<std::string>& rotation_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (int i = 0; i < kRotationMethodCount; ++i)
      list.emplace_back(name_of(static_cast<RotationMethod>(i)));
    return list;
  }();
  return names;
}

}  // namespace plumb::accuracy
