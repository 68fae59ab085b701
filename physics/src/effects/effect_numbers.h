// The numbers of an effect, each shown once: what writes them down, reads them back and checks them
// walks through the same list.
#pragma once

#include "plumb/effects.h"
#include "world/inputs.h"

namespace plumb::inline PLUMB_ABI::detail {

// `t` is called with every number of a kind, in the order of its fields. Choices by t.choice(value,
// count), world positions by t.position(), quaternions by t.unit().
template <class To>
struct EffectVisitor {
  To& t;
  void operator()(PointGravity& e) const {
    t.position(e.center);
    t(e.mu);
    t(e.softening);
  }
  void operator()(ForceField& e) const {
    t(e.field);
    for (Real& p : e.parameters) t(p);
    t(e.keeps_awake);
  }
  void operator()(Thrust& e) const {
    t(e.force);
    t(e.point);
    t(e.in_world_axes);
  }
  void operator()(Explosion& e) const {
    t.position(e.center);
    for (Real* v : {&e.impulse, &e.reference, &e.falloff, &e.speed, &e.thickness, &e.range, &e.area,
                    &e.updraft, &e.chimney_radius, &e.chimney_height, &e.updraft_duration})
      t(*v);
  }
  void operator()(Drag& e) const {
    for (Real* v : {&e.linear, &e.quadratic, &e.angular_linear, &e.angular_quadratic}) t(*v);
    t(e.medium);
  }
  void operator()(Magnus& e) const {
    t(e.coefficient);
    t(e.medium);
  }
  void operator()(Attractor& e) const {
    t.position(e.center);
    t(e.strength);
    t.choice(e.law, 3);
    t(e.range);
    t(e.softening);
  }
  void operator()(Wind& e) const {
    t(e.velocity);
    for (Real* v : {&e.density, &e.pressure, &e.friction}) t(*v);
  }
  void operator()(AeroSurface& e) const {
    for (Mat3* m : {&e.tensor, &e.minimum, &e.maximum})
      for (int i = 0; i < 9; ++i) t(m->data()[i]);
    t(e.is_controlled);
    t(e.control);
    t(e.point);
    t.unit(e.orientation);
    t(e.wind);
  }
  void operator()(Buoyancy& e) const {
    t(e.density);
    t(e.normal);
    t(e.level);
    t(e.current);
    for (Real* v : {&e.linear_drag, &e.quadratic_drag, &e.angular_drag}) t(*v);
    t.mesh(e.hull);
  }
  void operator()(Spring& e) const {
    t(e.other);
    t(e.point);
    t.position(e.other_point);
    for (Real* v : {&e.rest_length, &e.stiffness, &e.damping}) t(*v);
    t.choice(e.acts, 3);
  }
};

void append(std::vector<double>& out, const Effect& effect);
// ok becomes false where a number is no valid choice.
Effect read_effect(NumberReader& in, bool& ok);

}  // namespace plumb::inline PLUMB_ABI::detail
