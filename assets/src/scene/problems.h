// The list of what is wrong with a scene file: everything at once, so that a user need not run the
// loader once per mistake.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  // "file:line: what; remedy". Line 0: it concerns the file as a whole.
  void add(int line, const std::string& what, const std::string& remedy);
  // "file:line:column: what; remedy", where the column is known; 0: it is not.
  void add(int line, int column, const std::string& what, const std::string& remedy);
  [[nodiscard]] bool empty() const { return lines_.empty(); }
  [[nodiscard]] std::size_t count() const { return lines_.size(); }
  [[nodiscard]] const std::string& file() const { return file_; }
  // One problem a line, in the order of the file.
  [[nodiscard]] std::string text() const;

 private:
  struct Entry {
    int line;
    std::string text;
  };
  std::string file_;
  std::vector<Entry> lines_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
