// Runs a case, once for its readings and apart from that for its time.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/cells/case.h"

namespace plumb::inline PLUMB_ABI::cells {

WorldSettings Making::settings() const {
  WorldSettings s;
  s.substeps = knobs.substeps;
  s.rotation = static_cast<RotationMethod>(knobs.rotation);
  s.contact_solver = static_cast<ContactSolver>(knobs.solver);
  s.velocity_iterations = knobs.iterations;
  s.friction_cone = static_cast<FrictionCone>(knobs.friction);
  s.joint_order = knobs.joint_order;
  s.warm_starting = knobs.warm_start;
  s.sleeping = false;
  return s;
}

namespace {

const CaseMaker* find(std::string_view name) {
  static const std::vector<CaseMaker> all = [] {
    std::vector<CaseMaker> list;
    for (const auto& part : {plain_cases(), forced_cases(), shot_cases(), stacked_cases()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  for (const CaseMaker& maker : all)
    if (name == maker.name) return &maker;
  return nullptr;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// Steps through a case; false where a body had to be taken out.
template <class Look>
bool simulate(Case& c, double dt, const Look& look) {
  const long steps = std::lround(c.seconds / dt);
  bool sound = true;
  for (long i = 0; i < steps; ++i) {
    c.before_step();
    sound = c.world.step(dt).quarantined == 0 && sound;
    c.after_step();
    look(i + 1);
  }
  return sound;
}

accuracy::Readings run(std::string_view name, const accuracy::Knobs& knobs) {
  const std::unique_ptr<Case> c = find(name)->make({knobs, 1, 0, 1});
  accuracy::Readings out;
  out.finite = simulate(*c, knobs.dt, [](long) {});
  out.values = c->readings();
  out.finite = out.finite && all_finite(out.values);
  return out;
}

accuracy::Trace trace(std::string_view name, const accuracy::Knobs& knobs, double every,
                      double disturb, std::uint32_t seed) {
  const std::unique_ptr<Case> c = find(name)->make({knobs, 1, disturb, seed});
  const long stride = std::max(1L, std::lround(every / knobs.dt));
  accuracy::Trace out;
  out.places.push_back(c->readings());
  out.finite = simulate(*c, knobs.dt, [&](long done) {
    if (done % stride == 0) out.places.push_back(c->readings());
  });
  out.statistics = c->statistics();
  out.finite = out.finite && all_finite(out.places.back()) && all_finite(out.statistics);
  return out;
}

// [s] that this thread has computed: what else the machine does is not counted.
double thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of_run(const CaseMaker& maker, const accuracy::Knobs& knobs, double window) {
  const std::unique_ptr<Case> c = maker.make({knobs, maker.copies, 0, 1});
  const long steps = std::lround(c->seconds / knobs.dt);
  const double begin = thread_time();
  long done = 0;
  double spent = 0;
  while (done < steps && spent < window) {
    const long end = std::min(steps, done + std::max(1L, steps / 64));
    for (; done < end; ++done) {
      c->before_step();
      c->world.step(knobs.dt);
    }
    spent = thread_time() - begin;
  }
  return spent / (static_cast<double>(done) * knobs.dt * c->bodies);
}

double time(std::string_view name, const accuracy::Knobs& knobs, double window) {
  constexpr int kRuns = 3;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRuns; ++i)
    least = std::min(least, seconds_of_run(*find(name), knobs, window));
  return least;
}

constexpr accuracy::CellCode kCode{run, trace, time};

}  // namespace

const accuracy::CellCode& code() { return kCode; }

}  // namespace plumb::inline PLUMB_ABI::cells

namespace plumb::accuracy {

#if defined(PLUMB_PRECISION_F64)
const CellCode& cells_f64() { return cells::code(); }
#elif defined(PLUMB_PRECISION_F32D)
const CellCode& cells_f32d() { return cells::code(); }
#else
const CellCode& cells_f32() { return cells::code(); }
#endif

}  // namespace plumb::accuracy
