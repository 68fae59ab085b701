// What a format reader complains about while it reads. Readers leave out what they cannot make
// sense of and say so in their log only; here it is heard.
#pragma once

#include <string>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Collects warnings and errors of the calling thread while it lives, through the one logger that
// assimp has for all threads, which is set once and heard by nobody in between. An application that
// has set a logger of its own for assimp keeps it: that one hears it all then, and nothing is heard
// here.
class ReaderLog {
 public:
  ReaderLog();
  ~ReaderLog();
  ReaderLog(const ReaderLog&) = delete;
  ReaderLog& operator=(const ReaderLog&) = delete;

  // The first complaint that means that a face names vertices which are not there; empty: none.
  [[nodiscard]] std::string damage() const;

 private:
  std::vector<std::string> complaints_;
  std::vector<std::string>* outer_;  // of the log that this one stands in, if any
};

}  // namespace plumb::inline PLUMB_ABI::assets::detail
