// The recording of a run: grows under a temporary name and appears under its own when it is whole.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "plumb/assets/scene.h"
#include "plumb/world.h"

namespace plumb::cli {

class RecordingFile {
 public:
  RecordingFile();
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  // Each returns an error text, empty if all is well. open() is to be called before the first step.
  // labels: names beside bodies and joints in 3D.
  std::string open(const std::string& path, const assets::Scene& scene,
                   const assets::SceneInstance& instance, PhysicsWorld& world, bool labels);
  // Of what was recorded so far: a full disk, for example.
  [[nodiscard]] std::string problem() const;
  std::string finish(PhysicsWorld& world);

  [[nodiscard]] bool is_open() const;
  // Of the finished file.
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] double seconds() const;                // [s] taken from the stepping thread
  [[nodiscard]] double seconds_per_body_step() const;  // [s]
  [[nodiscard]] std::uint64_t body_steps() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumb::cli
