// The cases of every number type that this build has.
#include "accuracy/cell.h"

#include "plumb/settings.h"

namespace plumb::accuracy {

const CellCode* cells_of(Precision precision) {
  switch (precision) {
    case Precision::F32:
#if defined(PLUMB_LAB_F32)
      return &cells_f32();
#else
      return nullptr;
#endif
    case Precision::F32D:
#if defined(PLUMB_LAB_F32D)
      return &cells_f32d();
#else
      return nullptr;
#endif
    case Precision::F64:
#if defined(PLUMB_LAB_F64)
      return &cells_f64();
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

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names{"SoftStep", "Newton", "Auto", "WorstFirst"};
  return names;
}

const std::vector<std::string>& friction_names() {
  static const std::vector<std::string> names{"Exact", "4-facets", "8-facets"};
  return names;
}

}  // namespace plumb::accuracy
