// Nothing but the headers that most tests read, which CMake compiles for all of them.
