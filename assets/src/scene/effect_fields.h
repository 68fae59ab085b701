// The fields of effects with their keys, each shown once to what reads or writes a scene file.
#pragma once

#include "plumb/effects.h"
#include "scene/effect_keys.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// `f` has: number, vector, position, flag, matrix (key, field), choice (key, words, field) and
// orientation (field).
template <class Fields>
struct EffectFields {
  Fields& f;
  void operator()(PointGravity& e) const {
    f.position("center", e.center);
    f.number("mu", e.mu);
    f.number("softening", e.softening);
  }
  void operator()(ForceField&) const {}
  void operator()(Thrust& e) const {
    f.vector("force", e.force);
    f.vector("point", e.point);
    f.flag("in_world_axes", e.in_world_axes);
  }
  void operator()(Explosion& e) const {
    f.position("center", e.center);
    f.number("impulse", e.impulse);
    f.number("reference", e.reference);
    f.number("falloff", e.falloff);
    f.number("speed", e.speed);
    f.number("thickness", e.thickness);
    f.number("range", e.range);
    f.number("area", e.area);
    f.number("updraft", e.updraft);
    f.number("chimney_radius", e.chimney_radius);
    f.number("chimney_height", e.chimney_height);
    f.number("updraft_duration", e.updraft_duration);
  }
  void operator()(Drag& e) const {
    f.number("linear", e.linear);
    f.number("quadratic", e.quadratic);
    f.number("angular_linear", e.angular_linear);
    f.number("angular_quadratic", e.angular_quadratic);
    f.vector("medium", e.medium);
  }
  void operator()(Magnus& e) const {
    f.number("coefficient", e.coefficient);
    f.vector("medium", e.medium);
  }
  void operator()(Attractor& e) const {
    f.position("center", e.center);
    f.number("strength", e.strength);
    f.choice("law", kAttractorLaws, e.law);
    f.number("range", e.range);
    f.number("softening", e.softening);
  }
  void operator()(Wind& e) const {
    f.vector("velocity", e.velocity);
    f.number("density", e.density);
    f.number("pressure", e.pressure);
    f.number("friction", e.friction);
  }
  void operator()(AeroSurface& e) const {
    f.matrix("tensor", e.tensor);
    f.controls(e);
    f.vector("point", e.point);
    f.orientation(e.orientation);
    f.vector("wind", e.wind);
  }
  void operator()(Buoyancy& e) const {
    f.number("density", e.density);
    f.vector("normal", e.normal);
    f.number("level", e.level);
    f.vector("current", e.current);
    f.number("linear_drag", e.linear_drag);
    f.number("quadratic_drag", e.quadratic_drag);
    f.number("angular_drag", e.angular_drag);
  }
  void operator()(Spring& e) const {
    f.vector("point", e.point);
    f.position("other_point", e.other_point);
    f.rest_length(e.rest_length);
    f.number("stiffness", e.stiffness);
    f.number("damping", e.damping);
    f.choice("acts", kSpringActs, e.acts);
  }
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
