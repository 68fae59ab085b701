// Where Newton's method does not get through by itself: a primal-dual interior point method on the
// same convex problem (shifts and radii fixed), of which only the start of the next try is wanted.
//
//   M v = p + J^T l,   w = J v + b,   l in K, w in K*, l . w = 0
//
// It follows l o w = mu e for mu to 0 in the scaling of Nesterov and Todd, with Mehrotra's
// predictor and corrector [Vandenberghe 2010]. The number of its iterations hardly depends on
// masses, on the number of contacts, or on how many of them open and close: 10 to 25. Each factors
// a matrix of the pattern that Newton's has. What is bounded by an interval is treated alike;
// bounds on vectors are taken component by component.
#pragma once

#include "solver/newton/island.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

// From island.v to velocities and impulses (in v and g) near those that obey the laws.
void find_interior_point(Island& island);

}  // namespace plumb::inline PLUMB_ABI::detail::newton
