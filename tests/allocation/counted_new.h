// Counts what this program asks of the heap.
#pragma once

namespace plumb::test {

void begin_counting();
long end_counting();        // calls of operator new since, by any thread
long long counted_bytes();  // [byte] asked for between the two

long long live_bytes();  // [byte] asked for and not given back yet, since the program began

}  // namespace plumb::test
