#include "engine/packing/energy.hpp"
