// The inner and the outer iteration of one island's solve.
//
//   inner   min over v of  1/2 |v - v*|_M^2 + sum 1/(2 rho) |P(c - rho (J v + b))|^2
//           convex and once differentiable: a semismooth Newton method with the matrix
//           M + rho sum J^T D J and a search along each step [Qi, Sun 1993]
//   outer   c = P(y), shift = |u_t|: the proximal (augmented Lagrangian) iteration
//           [Rockafellar 1976]; what is left at its end is the exact law, rho has no part in it
#pragma once

#include "solver/newton/island.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

// --- inner (newton_method.cpp) ---
// Impulses and gradient at island.v; the largest momentum that is unaccounted for, relative to what
// acts on its body [-].
double evaluate(Island& island);
// Returns whether it has converged.
bool minimize(Island& island, int iterations);
// M + rho J^T D J, factored, with the laws' D.
void factor(Island& island);

// --- the search along a step (line_search.cpp) ---
// How far to go along island.step [-], in (0, 1].
double length_of_step(Island& island);

// --- outer (proximal.cpp) ---
// From island.v and the laws' warm impulses to the velocities and impulses that obey all laws.
void solve(Island& island);

// --- matrix and momentum (island_matrix.cpp) ---
void assemble(Island& island);
Twist momentum_of(const IslandBody& body, const Twist& velocity);
// momentum += J^T of a wrench in the contact's frame; of impulses along a joint's rows.
void add_wrench(const Island& island, const IslandContact& contact, const Twist& wrench,
                double sign, std::vector<Twist>& momentum);
void add_impulses(const Island& island, const IslandJoint& joint, const double* impulse,
                  double sign, std::vector<Twist>& momentum);

}  // namespace plumb::inline PLUMB_ABI::detail::newton
