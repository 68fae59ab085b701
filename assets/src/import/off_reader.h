// OFF files (Object File Format, [Phillips 2007]): the variants STOFF, COFF, NOFF, 4OFF and nOFF of
// three dimensions, as text. Faces may have any number of corners. assimp's own reader leaves out
// faces of more than nine corners and bends indices that are out of range.
#pragma once

#include <string_view>
#include <vector>

#include "plumb/assets/result.h"
#include "plumb/math.h"

namespace Assimp {
class Importer;
}

namespace plumb::inline PLUMB_ABI::assets::detail {

struct OffPolygons {
  std::vector<Eigen::Vector3d> vertices;  // [file units]
  std::vector<std::uint32_t> corners;     // of all faces, one after the other
  std::vector<std::size_t> ends;          // of each face in `corners`
};

// The error names the line, and the index if one is wrong.
Result<OffPolygons> parse_off(std::string_view text);

// Puts a reader that uses the above in the place of assimp's own.
void read_off_ourselves(Assimp::Importer& importer);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
