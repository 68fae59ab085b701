// Counts what this program asks of the heap.
#pragma once

namespace plumb::test {

void begin_counting();
long end_counting();  // calls of operator new since, by any thread

}  // namespace plumb::test
