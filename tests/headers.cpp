// Only the headers that most tests include; CMake precompiles them for all.
