#include "engine/solve/jamming_point.hpp"
