#include "hull/qhull.h"

#include <csetjmp>
#include <cstdio>
#include <utility>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

// The faces of a finished run as plain numbers. Qhull leaves by longjmp when something goes wrong;
// nothing with a destructor may be alive across it, so that `flat` belongs to the caller.
// Each face is written as its size and its points. False if Qhull gave up.
bool read_faces(qhT* qh, std::vector<int>& flat, double& outer) {
  // Room beforehand: an allocation that is skipped over by a jump would leak.
  std::size_t room = 0;
  {
    facetT* facet = nullptr;
    FORALLfacets room += 1 + static_cast<std::size_t>(qh_setsize(qh, facet->vertices));
  }
  flat.reserve(room);
  if (setjmp(qh->errexit) != 0) {
    qh->NOerrexit = True;
    return false;
  }
  qh->NOerrexit = False;
  facetT* facet = nullptr;
  FORALLfacets {
    setT* corners = qh_facet3vertex(qh, facet);  // in order around the face, for merged faces too
    flat.push_back(qh_setsize(qh, corners));
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(corners) flat.push_back(qh_pointid(qh, vertex->point));
    qh_settempfree(qh, &corners);
  }
  outer = qh_maxouter(qh);
  qh->NOerrexit = True;
  return true;
}

}  // namespace

Result<QhullRun> run_qhull(const std::vector<Eigen::Vector3d>& points, double coplanar_tolerance) {
  std::vector<coordT> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points)
    coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});

  // C-n merges neighbours whose centre lies within n of the other's plane; Pp keeps quiet.
  char command[64];
  std::snprintf(command, sizeof command, "qhull Pp C-%.3g", coplanar_tolerance);
  std::FILE* messages = std::tmpfile();
  if (messages == nullptr) return Error{"convex hull: no temporary file for Qhull's messages"};

  qhT qh_state;
  qhT* qh = &qh_state;
  qh_zero(qh, messages);
  const int exit_code = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(),
                                     False, command, nullptr, messages);
  std::vector<int> flat;
  QhullRun run;
  const bool complete = exit_code == 0 && read_faces(qh, flat, run.outer);
  qh_freeqhull(qh, !qh_ALL);
  int left = 0, total = 0;
  qh_memfreeshort(qh, &left, &total);

  std::string first_line;
  if (!complete) {
    char line[256] = "";
    std::rewind(messages);
    if (std::fgets(line, sizeof line, messages) != nullptr) first_line = line;
    while (!first_line.empty() && (first_line.back() == '\n' || first_line.back() == ' '))
      first_line.pop_back();
  }
  std::fclose(messages);
  if (!complete) {
    return Error{"convex hull: Qhull gave up" +
                 (first_line.empty() ? std::string() : " (" + first_line + ")") +
                 "; the points may be too flat for a body"};
  }

  for (std::size_t i = 0; i < flat.size();) {
    const auto size = static_cast<std::size_t>(flat[i++]);
    std::vector<std::uint32_t> polygon;
    // Qhull lists them clockwise.
    for (std::size_t k = size; k-- > 0;) polygon.push_back(static_cast<std::uint32_t>(flat[i + k]));
    i += size;
    run.polygons.push_back(std::move(polygon));
  }
  return run;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
