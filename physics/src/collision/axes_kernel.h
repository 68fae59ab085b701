// The search for the axis along which two polyhedra are farthest apart, several faces, corners and
// edges side by side. Compiled once per vector length; all give the same bits.
//
// Plain memory only (math/wide_abi.h). Lists are filled up to whole vectors: points with copies of
// the first, planes with ones that nothing is in front of, edges with zeros.
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr int kAxesLanes = 8;  // most doubles in one vector
constexpr int filled_up(int count) { return (count + kAxesLanes - 1) / kAxesLanes * kAxesLanes; }

struct PolyhedronLanes {
  const double *x, *y, *z;                       // [m] corners
  const double *normal_x, *normal_y, *normal_z;  // of the faces, outward
  const double* offset;                          // [m]
  int vertex_count, face_count;
  double centre_x, centre_y, centre_z, inner_radius;  // [m] of a ball that is surely inside
};

// Edges of one polyhedron: from where, along what [m], and the normals of the faces beside them.
struct EdgeLanes {
  double *x, *y, *z, *along_x, *along_y, *along_z;
  double *a_x, *a_y, *a_z, *b_x, *b_y, *b_z;
  int count;
};

// The face of p in front of which q begins farthest out [m].
struct FaceAxis {
  double separation;
  int face;
};
// The two edges across which the shapes are farthest apart [m], by their places in the lists; -1
// where none are by more than was asked.
struct EdgesAxis {
  double separation;
  int a, b;
};

struct AxesKernel {
  // Faces along which q starts at most `floor` out may be told wrong: they do not count.
  FaceAxis (*best_face)(const PolyhedronLanes& p, const PolyhedronLanes& q, double floor);
  // Only pairs that separate by more than `floor`, and whose arcs cross on the Gauss map.
  EdgesAxis (*best_edges)(const EdgeLanes& a, const EdgeLanes& b, double floor);
};
AxesKernel axes_kernel_128();
AxesKernel axes_kernel_256();
AxesKernel axes_kernel_512();

// The longest that this processor has, or of so many bits at most where `bits` > 0.
AxesKernel choose_axes_kernel(int bits);

}  // namespace plumb::inline PLUMB_ABI::detail
