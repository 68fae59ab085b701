// One line that says what is being done, drawn only for people: when stderr is a terminal.
#pragma once

#include <string>

namespace plumb::cli {

class StatusLine {
 public:
  explicit StatusLine(bool wanted);
  ~StatusLine();  // wipes the line
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);

 private:
  bool visible_;
};

}  // namespace plumb::cli
