// Ours, with its default settings, and with the accurate contact solver.
#include "bench/anchors/engines/engine.h"
#include "bench/anchors/engines/plumb_world.h"

namespace plumb::anchors {
namespace {

class Plumb : public Engine {
 public:
  Plumb(const Scene& scene, const EngineOptions& options, ContactSolver solver)
      : jobs_(options.threads > 1 ? make_thread_pool(options.threads) : nullptr), world_([&] {
          WorldSettings settings = settings_of(scene);
          settings.contact_solver = solver;
          settings.profiling = options.profiling;
          if (options.substeps > 0) settings.substeps = options.substeps;
          return settings;
        }()) {
    world_.set_job_system(jobs_.get());
    bodies_ = build_in(world_, scene);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!scene.bodies[i].force.isZero())
        pulled_.emplace_back(bodies_[i], build::vec(scene.bodies[i].force));
  }
  void step(double dt) override {
    for (const auto& [body, force] : pulled_) build::must(world_.apply_force(body, force));
    const StepReport& report = world_.step(dt);
    if (!report.status.ok()) throw std::runtime_error(report.status.message);
  }
  void read(std::vector<BodyState>& out) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const plumb::BodyState state = world_.state(bodies_[i]);
      out[i] = {state.pose.position.cast<double>(), state.pose.orientation.cast<double>(),
                state.linear_velocity.cast<double>(), state.angular_velocity.cast<double>()};
    }
  }
  [[nodiscard]] std::vector<std::pair<std::string, double>> stages() const override {
    std::vector<std::pair<std::string, double>> out;
    for (std::size_t k = 0; k < kStageCount; ++k)
      out.emplace_back(name_of(static_cast<Stage>(k)), world_.last_report().stage_seconds[k]);
    return out;
  }
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override {
    const StepReport& r = world_.last_report();
    return {{"awake", r.awake_bodies},
            {"candidates", r.candidate_pairs},
            {"touching", r.touching_pairs},
            {"points", r.contact_points},
            {"colours", r.colors}};
  }

 private:
  std::unique_ptr<JobSystem> jobs_;
  PhysicsWorld world_;
  std::vector<BodyId> bodies_;
  std::vector<std::pair<BodyId, Vec3>> pulled_;  // [N]
};

template <ContactSolver solver>
std::unique_ptr<Engine> make(const Scene& scene, const EngineOptions& options) {
  return std::make_unique<Plumb>(scene, options, solver);
}

}  // namespace

std::vector<EngineKind> plumb_kinds() {
  constexpr int kThreads = 256;
  const std::string precision = std::string(kPrecisionName) + ", ";
  return {{"ours", precision + "solver by the scene, 4 substeps", true, kThreads,
           make<ContactSolver::Auto>},
          {"ours-soft", precision + "soft steps, 4 substeps", true, kThreads,
           make<ContactSolver::SoftStep>},
          {"ours-newton", precision + "accurate solver, 4 substeps", true, kThreads,
           make<ContactSolver::Newton>}};
}

}  // namespace plumb::anchors
