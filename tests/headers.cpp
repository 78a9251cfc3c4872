// CMake precompiles the headers that most tests include, with this source.
