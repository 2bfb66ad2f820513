#include "rt/tick_clock.h"
