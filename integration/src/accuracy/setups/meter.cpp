#include "accuracy/setups/meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::accuracy {
namespace {

using Eigen::Vector3d;

double square(double a) { return a * a; }

class Attitude : public Meter {
 public:
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    std::vector<double> out;
    append_attitude(out, end[0].orientation);
    return out;
  }
};

class Rest : public Meter {
 public:
  void after_step(double time, const BodyReadings& bodies) override {
    constexpr double kRest = 1e-3;  // [m/s]
    if (bodies[0].velocity.norm() > kRest) last_ = time;
  }
  [[nodiscard]] std::vector<double> readings(const BodyReadings&) const override { return {last_}; }

 private:
  double last_ = 0;
};

class ForwardSpeed : public Meter {
 public:
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    return {end[0].velocity.x()};
  }
};

class Path : public Meter {
 public:
  explicit Path(const Vector3d& along) : along_(along) {}
  void begin(const BodyReadings& bodies) override { start_ = bodies[0].position; }
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    return {(end[0].position - start_).dot(along_)};
  }

 private:
  Vector3d along_, start_ = Vector3d::Zero();
};

class Slides : public Meter {
 public:
  void begin(const BodyReadings& bodies) override { start_ = bodies; }
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    std::vector<double> out;
    for (std::size_t i = 0; i < end.size(); ++i) {
      const Vector3d way =
          (end[i].position - start_[i].position) / std::sqrt(static_cast<double>(end.size()));
      out.insert(out.end(), {way.x(), way.z()});
    }
    return out;
  }

 private:
  BodyReadings start_;
};

class Precession : public Meter {
 public:
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    return {-std::atan2(end[0].position.z(), end[0].position.x())};
  }
};

// Upward passages through the bottom, between two steps by the cubic through both ends.
class Period : public Meter {
 public:
  void begin(const BodyReadings& bodies) override { last_ = angle(bodies[0]); }
  void after_step(double t, const BodyReadings& bodies) override {
    const double now = angle(bodies[0]), h = t - time_;
    const double rate = bodies[0].spin.z();
    if (last_ < 0 && now >= 0) {
      double low = 0, high = 1;
      for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (low + high), s2 = s * s, s3 = s2 * s;
        const double value = (2 * s3 - 3 * s2 + 1) * last_ + (s3 - 2 * s2 + s) * h * rate_ +
                             (3 * s2 - 2 * s3) * now + (s3 - s2) * h * rate;
        (value < 0 ? low : high) = s;
      }
      const double when = time_ + low * h;
      if (passages_++ == 0) first_ = when;
      latest_ = when;
    }
    last_ = now;
    rate_ = rate;
    time_ = t;
  }
  [[nodiscard]] std::vector<double> readings(const BodyReadings&) const override {
    return {passages_ > 1 ? (latest_ - first_) / (passages_ - 1) : 0.0};
  }

 private:
  static double angle(const BodyReading& bob) {
    return std::atan2(bob.position.x(), -bob.position.y());
  }
  double last_ = 0, rate_ = 0, time_ = 0, first_ = 0, latest_ = 0;
  int passages_ = 0;
};

class WorstEnergy : public Meter {
 public:
  WorstEnergy(double gravity, double floor) : gravity_(gravity), floor_(floor) {}
  void begin(const BodyReadings& bodies) override { start_ = energy(bodies[0]); }
  void after_step(double, const BodyReadings& bodies) override {
    worst_ = std::max(worst_, std::abs(energy(bodies[0]) / start_ - 1));
  }
  [[nodiscard]] std::vector<double> readings(const BodyReadings&) const override {
    return {worst_};
  }

 private:
  [[nodiscard]] double energy(const BodyReading& body) const {  // [J/kg]
    return 0.5 * body.velocity.squaredNorm() + gravity_ * (body.position.y() - floor_);
  }
  double gravity_, floor_, start_ = 0, worst_ = 0;
};

class Places : public Meter {
 public:
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    std::vector<double> out;
    for (const BodyReading& body : end)
      out.insert(out.end(), body.position.data(), body.position.data() + 3);
    return out;
  }
};

class Displacement : public Meter {
 public:
  void begin(const BodyReadings& bodies) override { start_ = bodies; }
  [[nodiscard]] std::vector<double> readings(const BodyReadings& end) const override {
    double sum = 0;
    for (std::size_t i = 0; i < end.size(); ++i)
      sum += (end[i].position - start_[i].position).squaredNorm();
    return {std::sqrt(sum / static_cast<double>(end.size()))};
  }

 private:
  BodyReadings start_;
};

// Root of the mean over the steps of what `square_of` gives.
class Rms : public Meter {
 public:
  void after_step(double time, const BodyReadings& bodies) override {
    sum_ += square_of(time, bodies);
    ++steps_;
  }
  [[nodiscard]] std::vector<double> readings(const BodyReadings&) const override {
    return {std::sqrt(sum_ / std::max(1, steps_))};
  }

 private:
  [[nodiscard]] virtual double square_of(double time, const BodyReadings& bodies) const = 0;
  double sum_ = 0;
  int steps_ = 0;
};

class Energy : public Rms {
 public:
  Energy(double gravity, double mass, double moment)
      : gravity_(gravity), mass_(mass), moment_(moment) {}
  void begin(const BodyReadings& bodies) override { start_ = energy(bodies); }

 private:
  [[nodiscard]] double energy(const BodyReadings& bodies) const {
    double sum = 0;
    for (const BodyReading& b : bodies)
      sum += 0.5 * (mass_ * b.velocity.squaredNorm() + moment_ * b.spin.squaredNorm()) +
             mass_ * gravity_ * b.position.y();
    return sum;
  }
  [[nodiscard]] double square_of(double, const BodyReadings& bodies) const override {
    return square(energy(bodies) / start_ - 1);
  }
  double gravity_, mass_, moment_, start_ = 0;
};

class Overlap : public Rms {
 public:
  explicit Overlap(double radius) : radius_(radius) {}

 private:
  [[nodiscard]] double square_of(double, const BodyReadings& bodies) const override {
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Vector3d& p = bodies[i].position;
      sum += square(std::max(0.0, radius_ - p.y()));
      for (std::size_t j = i + 1; j < bodies.size(); ++j)
        sum += square(std::max(0.0, 2 * radius_ - (p - bodies[j].position).norm()));
    }
    return sum;
  }
  double radius_;
};

class Acceleration : public Rms {
 public:
  explicit Acceleration(std::vector<Vector3d> right) : right_(std::move(right)) {}

 private:
  [[nodiscard]] double square_of(double time, const BodyReadings& bodies) const override {
    double sum = 0;
    for (std::size_t i = 0; i < right_.size(); ++i)
      sum += (bodies[i].velocity - time * right_[i]).squaredNorm();
    return sum;
  }
  std::vector<Vector3d> right_;
};

}  // namespace

MeterPtr attitude_meter() { return std::make_unique<Attitude>(); }
MeterPtr rest_meter() { return std::make_unique<Rest>(); }
MeterPtr forward_speed_meter() { return std::make_unique<ForwardSpeed>(); }
MeterPtr path_meter(const Vector3d& along) { return std::make_unique<Path>(along); }
MeterPtr precession_meter() { return std::make_unique<Precession>(); }
MeterPtr period_meter() { return std::make_unique<Period>(); }
MeterPtr worst_energy_meter(double gravity, double floor) {
  return std::make_unique<WorstEnergy>(gravity, floor);
}
MeterPtr places_meter() { return std::make_unique<Places>(); }
MeterPtr slides_meter() { return std::make_unique<Slides>(); }
MeterPtr energy_meter(double gravity, double mass, double moment) {
  return std::make_unique<Energy>(gravity, mass, moment);
}
MeterPtr displacement_meter() { return std::make_unique<Displacement>(); }
MeterPtr acceleration_meter(std::vector<Vector3d> right) {
  return std::make_unique<Acceleration>(std::move(right));
}
MeterPtr overlap_meter(double radius) { return std::make_unique<Overlap>(radius); }

void append_attitude(std::vector<double>& out, const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.normalized().toRotationMatrix() / std::numbers::sqrt2;
  out.insert(out.end(), R.data(), R.data() + 9);
}

}  // namespace plumb::accuracy
